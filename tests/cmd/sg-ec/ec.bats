load ../common

setup() { cd "$TESTDATA"; }

columns=order,vertices,edges,dim,ec,rose,flops,nnz,fill,max_clique,height,cliques,ec_bt,factor_bytes,peak_bytes,seconds

@test "the columns, in their order" {
  [ "$(sg-ec figure1.g2o | head -n 1 | tr '\t' ,)" = "$columns" ]
  [ "$(sg-ec figure1.g2o figure1.g2o | head -n 1 | tr '\t' ,)" = "file,$columns" ]
  [ "$(sg-ec --trace figure1.g2o | head -n 1 | tr '\t' ,)" = "step,$columns" ]
}

@test "the paper's Figure 1, counted by hand" {
  run -0 sg-ec -m file --no-header -f vertices,edges,dim,ec,nnz,fill,max_clique,height,cliques,ec_bt figure1.g2o
  # ec: 3 (3 * 9^2) + 3 * 6^2 + 3 * 3^2; nnz: 3 (6 + 18) + (6 + 9) + 6; fill: two 3x3 blocks
  [ "$output" = "$(printf '5\t5\t15\t864\t93\t18\t9\t5\t3\t1215')" ]
}

@test "several files: a row each, with its name" {
  run -0 sg-ec -f file,ec --no-header figure1.g2o walk.g2o
  [ "$output" = "$(printf 'figure1.g2o\t864\nwalk.g2o\t697')" ]
}

@test "without -m: the file's order if sg-order left one, colamd otherwise" {
  [ "$(sg-ec --no-header -f order walk.g2o)" = colamd ]
  [ "$(sg-order -m random walk.g2o | sg-ec --no-header -f order)" = file:random ]
  for m in colamd amd random landmarks-first; do
    [ "$(sg-order -m $m walk.g2o | sg-ec --no-header -f ec,nnz,ec_bt)" = "$(sg-ec -m $m --no-header -f ec,nnz,ec_bt walk.g2o)" ]
  done
}

@test "several orderings: a row each" {
  run -0 sg-ec -m file,colamd -f order --no-header walk.g2o
  [ "$output" = "$(printf 'file\ncolamd')" ]
}

@test "fixed vertices have no part in it" {
  free=$(grep -v FIX walk.g2o | sg-ec -m file --no-header -f vertices,edges,dim,ec)
  fixed=$(sg-ec -m file --no-header -f vertices,edges,dim,ec walk.g2o)
  [ "$free" = "$(printf '7\t11\t19\t1720')" ]
  [ "$fixed" = "$(printf '7\t11\t16\t979')" ]
  printf 'VERTEX_SE2 1 0 0 0\nFIX 1\n' | sg-ec --no-header -f vertices,dim,ec,height | grep -qx "$(printf '1\t0\t0\t0')"
}

@test "--trace ends with the graph itself, and its EC never falls under file order" {
  [ "$(sg-ec --trace --no-header walk.g2o | tail -n 1)" = "$(printf '4\t'; sg-ec --no-header walk.g2o)" ]
  sg-ec --trace -m file --no-header -f ec walk.g2o | sort -nc
}

@test "--trace: a row at every K-th step and the last; landmarks wait for their M-th observation" {
  [ "$(sg-ec --trace --every 3 --no-header -f step walk.g2o | xargs)" = "0 3 4" ]
  # Landmark 100 is seen from poses 0, 1, 2; 101 from 2, 3, 4.
  [ "$(sg-ec --trace --no-header -f vertices,edges walk.g2o | xargs)" = "2 1 3 3 5 6 6 8 7 11" ]
  [ "$(sg-ec --trace --min-obs 3 --no-header -f vertices,edges walk.g2o | xargs)" = "1 0 2 1 4 5 5 6 7 11" ]
  [ "$(sg-ec --trace --min-obs 4 --no-header -f vertices,edges walk.g2o | tail -n 1)" = "$(printf '5\t5')" ]
}

@test "--trace equals scoring each prefix of the replay" {
  for k in 0 1 2 3 4; do
    # Poses 0..k and what they see, as a file of its own.
    awk -v k=$k '/^VERTEX_SE2/ && $2 > k {next} /^EDGE/ && ($2 > k || (/^EDGE_SE2 / && $3 > k)) {next} {print}' walk.g2o |
      awk -v k=$k '!(/101/ && k < 2)' | sg-ec --no-header >"$BATS_TEST_TMPDIR/prefix"
    [ "$(sg-ec --trace --no-header walk.g2o | grep "^$k" | cut -f 2-)" = "$(cat "$BATS_TEST_TMPDIR/prefix")" ]
  done
}

@test "--per-vertex: costs sum to EC, shares to one, positions count up" {
  sg-ec --per-vertex --no-header -f cost,share,position,d_f,d_s walk.g2o |
    awk -v ec="$(sg-ec --no-header -f ec walk.g2o)" '
      {sum += $1; share += $2; if ($3 != NR - 1 || $1 != $4 * ($4 + $5)^2) wrong = 1}
      END {exit wrong || !(sum == ec && share > 0.999999 && share < 1.000001 && NR == 6)}'
  sg-ec --per-vertex --no-header -f id,role walk.g2o | grep -qx "$(printf '100\tlandmark')"
}

@test "--per-edge: a price is what a new scoring saves, and nothing where an edge is free" {
  cd "$BATS_TEST_TMPDIR"; cp "$TESTDATA/walk.g2o" .
  edges=$(grep -n ^EDGE walk.g2o | cut -d: -f1)
  ec=$(sg-ec -m id --no-header -f ec walk.g2o)
  for line in $edges; do echo $((ec - $(sed "${line}d" walk.g2o | sg-ec -m id --no-header -f ec))); done >expected
  sg-ec --per-edge -m id --no-header -f price walk.g2o >prices
  [ "$(cat prices)" = "$(cat expected)" ]
  [ "$(grep -c '^0$' prices)" = "$(sg-ec --per-edge -m id --no-header -f free walk.g2o | grep -c yes)" ]
  grep -qx 0 prices
  [ "$(sg-ec --per-edge -m id --json -f ids,role walk.g2o | head -2 | tail -1)" = '{"ids": [0, 100], "role": "observation"}' ]
  awk -v ec="$ec" 'NR == FNR {price[FNR] = $1; next} {d = $1 - price[FNR] / ec; if (d * d > 1e-20) wrong = 1} END {exit wrong}' prices \
    <(sg-ec --per-edge -m id --no-header -f share walk.g2o)
}

@test "-o, --json, --no-header" {
  sg-ec -f ec --no-header -o "$BATS_TEST_TMPDIR/out" figure1.g2o
  [ "$(cat "$BATS_TEST_TMPDIR/out")" = 864 ]
  [ "$(sg-ec --json -f order,ec figure1.g2o)" = '{"order": "colamd", "ec": 864}' ]
}

@test "wrong calls" {
  fails 2 "sg-ec: no column 'cost'; there are file, step, ${columns//,/, } (see sg-ec --help)" sg-ec -f cost figure1.g2o
  run -2 sg-ec -m nonsense figure1.g2o
  run -2 sg-ec --every 2 figure1.g2o
  run -2 sg-ec --trace --every 0 figure1.g2o
  run -2 sg-ec --trace --min-obs 0 figure1.g2o
  run -2 sg-ec --trace --per-vertex figure1.g2o
  run -2 sg-ec --per-edge --per-vertex figure1.g2o
}

@test "a wrong file among several: status 1 and no table in the output file" {
  echo before >"$BATS_TEST_TMPDIR/out"
  run -1 sg-ec -o "$BATS_TEST_TMPDIR/out" figure1.g2o missing.g2o
  [ "$(cat "$BATS_TEST_TMPDIR/out")" = before ]
}

@test "public graphs: EC under colamd, digit for digit" {
  need_data
  while read -r graph vertices edges ec ec_bt nnz clique; do
    [ "$(sg-ec -m colamd --no-header -f vertices,edges,ec,ec_bt,nnz,max_clique "$SGTOOLS_DATA/$graph" | xargs)" = \
      "$vertices $edges $ec $ec_bt $nnz $clique" ]
  done <<'END'
CSAIL.g2o 1045 1172 294408 303102 26781 21
tinyGrid3D.g2o 9 11 13608 16416 693 18
smallGrid3D.g2o 125 297 4664520 8498736 47841 180
intel.g2o 1728 2512 1281177 1436346 67635 45
kitti_00.g2o 4541 4677 1177443 1179765 112152 15
manhattan.g2o 3500 5453 7207461 9664704 189309 126
sphere400.isam.txt 400 779 17237880 25256448 154308 216
manhattanOlson3500.isam.txt 3500 5598 7738470 10233378 193134 138
victoriaPark.isam.txt 7120 10608 3348952 4098254 212914 103
sphere2500.g2o 2500 4949 372401928 534040344 1494264 588
torus3D.g2o 5000 9048 1231336944 2229583104 3072048 1098
city10000.g2o 10000 20687 112942080 158950620 1115160 366
END
}
