load ../common

setup() { cd "$BATS_TEST_TMPDIR"; cp "$TESTDATA"/* .; }

# near A B: the same words, numbers to 1e-12.
near() {
  paste -d '\n' "$1" "$2" | awk -v one="$1" -v two="$2" '
    NR % 2 { split($0, a); n = NF; next }
    { if (NF != n) { print one ", " two ": line " NR / 2 " differs"; exit 1 }
      for (k = 1; k <= NF; ++k) {
        d = a[k] - $k; if (d < 0) d = -d
        if (a[k] != $k && !(a[k] + 0 == a[k] && $k + 0 == $k && d <= 1e-12 * (1 + ($k < 0 ? -$k : $k)))) {
          print one ", " two ": line " NR / 2 ": " a[k] " is not " $k; exit 1 } } }'
}

@test "g2o to TORO and back" {
  grep -v 'FIX\|XY' walk.g2o >poses.g2o
  sg-convert --to toro poses.g2o >poses.toro
  grep -qx 'EDGE2 0 1 1 0 0 400 0 400 2500 0 0' poses.toro
  sg-convert poses.toro | cmp - poses.g2o  # in the plane no number changes
}

@test "TORO in space to g2o and back" {
  sg-convert square.toro >square.g2o
  grep -q '^EDGE_SE3:QUAT 0 1 1 0 0 0 0 0.70710678118654.* 1600 0 0 1600 0 1600$' square.g2o
  sg-convert --to toro square.g2o >back.toro
  near square.toro back.toro
}

@test "iSAM to g2o and back" {
  sg-convert park.isam >park.g2o
  sg-convert --to isam park.g2o >back.isam
  cmp <(grep -v '^#' park.isam) back.isam
  sg-convert back.isam | cmp - <(grep -v '^#' park.g2o)
}

@test "a singular information has a square root, too" {
  echo 'EDGE_SE2 0 1 1 0 0 4 2 0 1 0 0' >in.g2o
  sg-convert --to isam in.g2o | sg-convert --from isam >out.g2o
  near in.g2o out.g2o
}

@test "public graphs keep their numbers through iSAM and TORO" {
  need_data
  for graph in victoriaPark manhattanOlson3500; do
    sg-convert --to isam "$SGTOOLS_DATA/$graph.isam.txt" | cmp - "$SGTOOLS_DATA/$graph.isam.txt"
  done
  sg-convert --to isam "$SGTOOLS_DATA/sphere400.isam.txt" >sphere.isam
  near "$SGTOOLS_DATA/sphere400.isam.txt" sphere.isam
  sg-convert --to toro "$SGTOOLS_DATA/manhattan.g2o" | sg-convert --from toro | grep -v VERTEX | cmp - "$SGTOOLS_DATA/manhattan.g2o"
  sg-convert "$SGTOOLS_DATA/sphere400.isam.txt" >sphere.g2o
  sg-convert --to toro sphere.g2o | sg-convert --from toro | grep -v VERTEX >back.g2o
  near sphere.g2o back.g2o
}

@test "g2o passes through byte for byte" {
  printf '\n VERTEX_SE2 1  1.0 0 -0\r\nROBOTLASER1 0 1\nFIX 1 1\nEDGE_PRIOR_SE2 1 1 0 0 1 0 0 1 0 1' >in.g2o
  sg-convert in.g2o | cmp - in.g2o
}

@test "Matrix Market: the block and the scalar lower triangle" {
  printf 'EDGE_SE2_XY 1 2 0 0 1 0 1\nEDGE_PRIOR_SE2 3 0 0 0 1 0 0 1 0 1\n' >in.g2o
  sg-convert --to mtx in.g2o | grep -v '^%' >block.mtx
  printf '3 3 4\n1 1\n2 1\n2 2\n3 3\n' | cmp - block.mtx
  sg-convert --to mtx --scalar in.g2o | grep -v '^%' >scalar.mtx
  # 3 + 2 + 3 scalars: two dense blocks, of 5 and of 3.
  { echo 8 8 21
    for j in 1 2 3 4 5; do for i in 1 2 3 4 5; do [ $i -lt $j ] || echo $i $j; done; done
    for j in 6 7 8; do for i in 6 7 8; do [ $i -lt $j ] || echo $i $j; done; done; } | cmp - scalar.mtx
}

@test "fixed vertices are no variables of a matrix" {
  [ "$(sg-convert --to mtx walk.g2o | sed -n 3p)" = "6 6 14" ]
}

@test "METIS: weights are dimensions, edges stand twice, multi-edges once" {
  printf 'EDGE_SE2 1 2 0 0 0 1 0 0 1 0 1\nEDGE_SE2 2 1 0 0 0 1 0 0 1 0 1\nEDGE_SE2_XY 2 9 0 0 1 0 1\n' >in.g2o
  printf '3 2 010 1\n3 2\n3 1 3\n2 2\n' | cmp - <(sg-convert --to metis in.g2o | grep -v '^%')
}

@test "Graphviz draws it" {
  printf 'EDGE_SE2_LOTSOFXY 1 2 8 9 0 0 0 0\nEDGE_SE2 1 2 0 0 0 1 0 0 1 0 1\nFIX 1\n' >in.g2o
  sg-convert --to dot in.g2o >out.dot
  grep -qx '  1 \[shape=circle, style=filled\];' out.dot
  grep -qx '  e0 -- 9;' out.dot
  grep -qx '  1 -- 2 \[style=bold\];' out.dot
  if command -v dot >/dev/null; then dot -Tsvg out.dot >/dev/null; fi
}

@test "TUM: the trajectory, composed where the file has no estimates" {
  sg-convert --to tum walk.g2o 2>/dev/null | sed -n 2p | grep -qx '1 1 0 0 0 0 0 1'
  sg-convert -q --to tum park.isam | awk '
    $1 == 1 {good = NF == 8 && $2 == 1 && $3 == 0 && $4 == 0 && ($7 - sqrt(0.5))^2 < 1e-20}
    END {exit !good}'
}

@test "estimates on request, and a file that needs none" {
  sg-convert --estimates park.isam >park.g2o
  [ "$(grep -c ^VERTEX park.g2o)" = 6 ]
  sg-check park.g2o
  sg-convert --estimates walk.g2o | cmp - walk.g2o
}

@test "what a format cannot hold is said, by its first line" {
  fails 1 "sg-convert: walk.g2o:11: toro cannot hold EDGE_SE2_XY (6 lines; --lossy leaves them out)" \
    sg-convert --to toro -o out.toro walk.g2o
  [ ! -e out.toro ]
  sg-convert --lossy -q --to toro -o out.toro walk.g2o
  [ "$(cut -d' ' -f1 out.toro | sort -u | xargs)" = "# EDGE2 VERTEX2" ]
  fails 0 "sg-convert: park.isam: tum cannot hold VERTEX_XY (2 lines, left out)" sg-convert --to tum park.isam
  printf 'EDGE_SE3_TRACKXYZ 0 1 0 1 1 1 1 0 0 1 0 1\nPARAMS_SE3OFFSET 0 0 0 1 0 0 0 1\n' >offset.g2o
  fails 1 "sg-convert: offset.g2o:1: isam cannot hold EDGE_SE3_TRACKXYZ (1 line; --lossy leaves them out)" \
    sg-convert --to isam --from g2o offset.g2o
}

@test "a zero quaternion is no rotation" {
  echo 'EDGE_SE3:QUAT 0 1 1 0 0 0 0 0 0 1 0 0 0 0 0 1 0 0 0 0 1 0 0 0 1 0 0 1 0 1' >zero.g2o
  for format in toro isam; do
    fails 1 "sg-convert: zero.g2o:1: a quaternion has length zero" sg-convert --to $format zero.g2o
  done
}

@test "KITTI: a matrix a pose, and back" {
  sg-convert --to kitti square.toro >square.kitti 2>said
  [ ! -s said ]
  awk '{m = m || NF != 12} END {exit m || NR != 4}' square.kitti
  sg-convert --to tum square.kitti >back.tum
  near back.tum <(sg-convert --to tum square.toro)
  printf 'VERTEX_SE2 3 1 2 0\nVERTEX_SE2 5 1 2 0\n' >odd.g2o
  fails 0 "sg-convert: odd.g2o:1: kitti cannot hold ids other than 0, 1, 2, ... (2 lines, left out)" sg-convert --to kitti odd.g2o
}

@test "times of a table" {
  printf '# of the run\nid time\n4 1e9 x\n0\t0.50\n1 1305031102.175304\n2 2\n3 3\n99 7\n' >times
  [ "$(sg-convert -q --to tum --times times walk.g2o | cut -d ' ' -f 1,2 | xargs)" = "0.50 0 1305031102.175304 1 2 2 3 3 1e9 4" ]
  fails 1 "sg-convert: <stdin>: it has no time of vertex 3" bash -c 'grep -v "^3" times | sg-convert -q --to tum --times - walk.g2o'
  fails 1 "sg-convert: <stdin>:2: a line of times is an id and a time" bash -c 'printf "0 1\n1\n" | sg-convert --to tum --times - walk.g2o'
  fails 1 "sg-convert: <stdin>:2: vertex 0 has a time already" bash -c 'printf "0 1\n0 1\n" | sg-convert --to tum --times - walk.g2o'
  fails 2 "sg-convert: --times has no effect without --to tum (see sg-convert --help)" sg-convert --times times walk.g2o
}

@test "ids counted from 0, poses first: what iSAM wants" {
  printf 'VERTEX_XY 3 0 0\nVERTEX_SE2 70 0 0 0\nVERTEX_SE2  5 0 0 0\nFIX 5\nEDGE_SE2 5 70 1 0 0 1 0 0 1 0 1\nEDGE_SE2_XY 70 3 0 0 1 0 1\n' >in.g2o
  sg-convert --renumber in.g2o >out.g2o
  printf 'VERTEX_XY 2 0 0\nVERTEX_SE2 1 0 0 0\nVERTEX_SE2  0 0 0 0\nFIX 0\nEDGE_SE2 0 1 1 0 0 1 0 0 1 0 1\nEDGE_SE2_XY 1 2 0 0 1 0 1\n' | cmp - out.g2o
  run -1 sg-convert --to isam in.g2o
  sg-convert -q --renumber --to isam in.g2o >out.isam
  sg-convert --renumber walk.g2o | sg-convert --renumber | cmp - <(sg-convert --renumber walk.g2o)
}

@test "information scaled, by tag; constants added" {
  sg-convert --scale-information EDGE_SE2_XY=0.5 --scale-information EDGE_SE2=2 walk.g2o >out.g2o
  sed '/^EDGE_SE2_XY/s/100 0 100$/50 0 50/; /^EDGE_SE2 /s/400 0 0 400 0 2500/800 0 0 800 0 5000/' walk.g2o | cmp - out.g2o
  fails 2 "sg-convert: --scale-information EDGE_SE2: wants TAG=X, as in EDGE_MINE=0.5 (see sg-convert --help)" sg-convert --scale-information EDGE_SE2 walk.g2o
  fails 2 "sg-convert: --scale-information EDGE_SE2=0: the factor has to be above 0 (see sg-convert --help)" sg-convert --scale-information EDGE_SE2=0 walk.g2o
  fails 2 "sg-convert: --scale-information FIX=1: no edge is known by this tag (see sg-convert --help)" sg-convert --scale-information FIX=1 walk.g2o
  fails 2 "sg-convert: --scale-information EDGE_SE2_LOTSOFXY=2: where its lines hold information is not known here (see sg-convert --help)" \
    sg-convert --scale-information EDGE_SE2_LOTSOFXY=2 walk.g2o
  sg-convert --fix 0,3,3 walk.g2o | cmp - <(cat walk.g2o; echo FIX 3)
  fails 2 "sg-convert: --fix: the graph has no vertex 9 (see sg-convert --help)" sg-convert --fix 9 walk.g2o
}

@test "the Hessian: J' W J of a graph that can be told by hand" {
  printf 'VERTEX_XY 1 0 0\nVERTEX_XY 2 1 1\nVERTEX_XY 3 1 1\nFIX 3\nEDGE_POINTXY 1 2 1 1 4 1 9\nEDGE_PRIOR_XY 2 0 0 2 0 2\nEDGE_POINTXY 3 1 1 1 1 0 1\n' >in.g2o
  sg-convert --to mtx --values in.g2o | awk '/^%/ || !head++ {next} {print $1, $2, $3 - 0}' | sort >said
  # Information 4 1 9 of the difference, 2 0 2 of the prior, 1 0 1 to the constant.
  printf '%s\n' '1 1 5' '2 1 1' '2 2 10' '3 1 -4' '3 2 -1' '3 3 6' '4 1 -1' '4 2 -9' '4 3 1' '4 4 11' >wanted
  near said wanted
  sg-convert --to mtx --values in.g2o | sed -n 1p | grep -qx '%%MatrixMarket matrix coordinate real symmetric'
  # Of relative measurements alone nothing is held: a row of the first pose is like any other.
  printf 'VERTEX_XY 1 0 0\nVERTEX_XY 2 1 1\nEDGE_POINTXY 1 2 1 1 4 0 4\n' | sg-convert --to mtx --values | grep -qx '1 1 4'
  fails 2 "sg-convert: --values has no effect without --to mtx (see sg-convert --help)" sg-convert --values walk.g2o
  fails 2 "sg-convert: --scalar has no effect with --values, which are scalars (see sg-convert --help)" \
    sg-convert --to mtx --values --scalar walk.g2o
}

@test "the pattern of the Hessian is that of --scalar" {
  for graph in walk.g2o types-se3.g2o; do
    cmp <(sg-convert --to mtx --scalar $graph | sed 1,3d | sort) <(sg-convert --to mtx --values $graph | sed 1,3d | cut -d ' ' -f 1,2 | sort)
  done
}

@test "wrong calls" {
  fails 2 "sg-convert: no format 'obj'; there are g2o, toro, isam, bal, mtx, metis, dot, tum, kitti (see sg-convert --help)" \
    sg-convert --to obj walk.g2o
  fails 2 "sg-convert: --scalar has no effect without --to mtx (see sg-convert --help)" sg-convert --scalar walk.g2o
}
