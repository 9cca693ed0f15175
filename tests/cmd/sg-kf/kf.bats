load ../common

setup() { cd "$BATS_TEST_TMPDIR"; cp "$TESTDATA/walk.g2o" .; }

@test "rate 1 is the input, byte for byte" {
  sg-kf -r 1 --no-trace-comment walk.g2o | cmp - walk.g2o
  printf 'EDGE_SE2 0 1 1.0 0 0 1 0 0 1 0 1\r\n\r\n  EDGE_SE2 1 2 1 0 0 1 0 0 1 0 1' >crlf.g2o
  sg-kf -r 1 --no-trace-comment crlf.g2o | cmp - crlf.g2o
}

@test "the call is left behind as a comment" {
  sg-kf -r 2 walk.g2o | sed -n 2p | grep -qx '# sg-kf -r 2 walk.g2o'
}

@test "a composed line keeps the line end of the one it replaces" {
  printf 'EDGE_SE2 0 1 1 0 0 1 0 0 1 0 1\r\nEDGE_SE2 1 2 1 0 0 1 0 0 1 0 1\r\n' >crlf.g2o
  [ "$(sg-kf -r 2 --no-trace-comment crlf.g2o | tr -d '\n' | tail -c 1)" = $'\r' ]
}

@test "every second pose stays, odometry is composed, observations of the others go" {
  sg-kf -r 2 walk.g2o >out.g2o
  [ "$(awk '/^VERTEX_SE2/ {print $2}' out.g2o | paste -sd' ')" = "0 2 4" ]
  [ "$(awk '/^EDGE_SE2 / {print $2, $3, $4}' out.g2o | paste -sd,)" = "0 2 2,2 4 2,4 0 -4" ]
  [ "$(awk '/_XY/ && /EDGE/ {print $2, $3}' out.g2o | paste -sd,)" = "0 100,2 100,2 101,4 101" ]
}

@test "a keyframe every so many degrees turned" {
  for k in 0 1 2 3 4 5 6 7 8; do echo "EDGE_SE2 $k $((k + 1)) 1 0 0.7854 1 0 0 1 0 1"; done >turn.g2o
  [ "$(sg-kf --angle 90 turn.g2o | awk '/^EDGE/ {print $2, $3}' | paste -sd,)" = "0 2,2 4,4 6,6 8" ]
  [ "$(sg-kf --angle 100 turn.g2o | awk '/^EDGE/ {print $2, $3}' | paste -sd,)" = "0 3,3 6,6 9" ]
}

@test "camera odometry of edges alone is composed, where there is one edge a step" {
  for k in 0 1; do echo "EDGE_SE3:EXPMAP $k $((k + 1)) 1 0 0 0 0 0 1 $(printf '%s ' 1 0 0 0 0 0 1 0 0 0 0 1 0 0 0 1 0 0 1 0 1)"; done >in.g2o
  [ "$(sg-kf -r 2 in.g2o | awk '/^EDGE/ {print $2, $3, $4}')" = "0 2 2" ]
}

@test "landmarks with too few observations leave" {
  sg-kf -r 4 --min-obs 2 walk.g2o >out.g2o
  run -1 grep _XY out.g2o
  [ "$(awk '/^EDGE_SE2 / {print $2, $3}' out.g2o | paste -sd,)" = "0 4,4 0" ]  # and no odometry with them
}

@test "priors of dropped poses go, and a message says so" {
  { cat walk.g2o; echo 'EDGE_PRIOR_SE2 1 1 0 0 1 0 0 1 0 1'; } >prior.g2o
  [ "$(sg-kf -r 2 prior.g2o 2>&1 >out.g2o)" = "sg-kf: left out 1 unary edges (priors) of dropped poses" ]
  run -1 grep PRIOR out.g2o
  run -0 --separate-stderr sg-kf -q -r 2 prior.g2o
  [ -z "$stderr" ]
  sg-kf -r 2 walk.g2o | grep -qx 'FIX 0'
}

@test "loop closures move to keyframes, or go" {
  { cat walk.g2o; echo 'EDGE_SE2 0 3 3 0 0 1 0 0 1 0 1'; } >loop.g2o
  [ "$(sg-kf -r 4 loop.g2o | awk '/^EDGE_SE2 / {print $2, $3, $4}' | paste -sd,)" = "0 4 4,4 0 -4,0 4 4" ]
  [ "$(sg-kf -r 4 --loops drop loop.g2o | awk '/^EDGE_SE2 / {print $2, $3, $4}' | paste -sd,)" = "0 4 4,4 0 -4" ]
}

@test "keyframes by distance and angle" {
  [ "$(sg-kf --dist 2 walk.g2o | awk '/^VERTEX_SE2/ {print $2}' | paste -sd' ')" = "0 2 4" ]
  [ "$(sg-kf --angle 10 walk.g2o | awk '/^VERTEX_SE2/ {print $2}' | paste -sd' ')" = "0" ]
  [ "$(sg-kf --dist 3 --angle 10 walk.g2o | awk '/^VERTEX_SE2/ {print $2}' | paste -sd' ')" = "0 3" ]
}

@test "what cannot be composed is an error" {
  printf 'VERTEX_CAM %s 0 0 0 0 0 0 1 1 1 0 0 0\n' 0 1 2 >cam.g2o
  for k in 0 1; do echo "EDGE_CAM $k $((k + 1)) 0 0 0 0 0 0 1 $(seq -s' ' 21 | sed 's/[0-9]*/1/g')"; done >>cam.g2o
  fails 1 "sg-kf: cam.g2o:4: cannot compose odometry of type EDGE_CAM across dropped poses" sg-kf -r 2 cam.g2o
  sg-kf -r 1 --no-trace-comment cam.g2o | cmp - cam.g2o
}

@test "wrong calls" {
  fails 2 "sg-kf: -r 0: must be 1 or more (see sg-kf --help)" sg-kf -r 0 walk.g2o
  fails 2 "sg-kf: -r -1: must be 1 or more (see sg-kf --help)" sg-kf -r -1 walk.g2o
  fails 2 "sg-kf: how many keyframes? Give -r, --covisible or --revisit, or --dist and --angle or one of them (see sg-kf --help)" sg-kf walk.g2o
  fails 2 "sg-kf: how many keyframes? -r keeps every R-th pose, --dist one every D metres: give one of them (see sg-kf --help)" \
    sg-kf -r 2 --dist 3 walk.g2o
  fails 2 "sg-kf: how many keyframes? --angle one every A degrees, --covisible those that see the most: give one of them (see sg-kf --help)" \
    sg-kf --angle 3 --covisible 0.9,3 walk.g2o
  fails 2 "sg-kf: --loops drop: --revisit follows loop closures (see sg-kf --help)" sg-kf -r 2 --revisit 1,1 --loops drop walk.g2o
  for wrong in 0.9 0,3 1.1,3 0.9,0 0.9,1.5 x,3 nan,3 0.9,3,3; do
    fails 2 "sg-kf: --covisible wants PART,N, a part in (0, 1] and a count of 1 or more, not '$wrong' (see sg-kf --help)" \
      sg-kf --covisible "$wrong" walk.g2o
  done
  for wrong in 1 1, -1,3 1,-3 inf,3 1,2,3; do
    fails 2 "sg-kf: --revisit wants DIST,ANGLE, metres and degrees of 0 or more, not '$wrong' (see sg-kf --help)" \
      sg-kf "--revisit=$wrong" walk.g2o
  done
}

# Twice round a square of a metre: 4 is 0 again but for a tenth, and 5 is 1; each step turns by 90 degrees.
square() {
  for k in 0 1 2 3 4; do echo "EDGE_SE2 $k $((k + 1)) 1 0 1.5707963267948966 4 0 0 4 0 4"; done
  echo 'EDGE_SE2 0 4 0.1 0 0 4 0 0 4 0 4'
  echo 'EDGE_SE2 5 1 0.3 0 0 4 0 0 4 0 4'
  echo 'EDGE_SE2 2 5 0 1 -1.5707963267948966 4 0 0 4 0 4'
}
joins() { awk '/^EDGE/ {printf "%s-%s %.6g %.6g,", $2, $3, $4, $5}' "$@"; }

@test "poses that closures tie to earlier ones are merged into them, within a distance and an angle" {
  square >square.g2o
  # 3-0: a step, and back from 4 to 0, which turns by nothing. 4-5: to 4, and a step. 5-1 and 2-5 as they are.
  [ "$(sg-kf --revisit 0.2,1 square.g2o | joins)" = "0-1 1 0,1-2 1 0,2-3 1 0,3-0 1 -0.1,0-5 1.1 0,5-1 0.3 0,2-5 0 1," ]
  # 5 is merged, too: 0-1 once more, by way of 4 and 5; 2-5 becomes 2-1
  [[ "$(sg-kf --revisit 0.5,1 square.g2o | joins)" == "0-1 1 0,1-2 1 0,2-3 1 0,3-0 1 -0.1,0-1 1.1 0.3,2-1 "* ]]
  [ "$(sg-kf --revisit 0.05,1 square.g2o | joins)" = "$(joins square.g2o)" ]
  sg-kf -v --revisit 0.5,1 square.g2o 2>&1 >/dev/null | grep -q "merged 2 keyframes into earlier ones that they revisit"
  { cat square.g2o; echo 'FIX 4'; } | sg-kf --revisit 0.5,1 | joins | grep -q 3-4
}

@test "edges that come to join the same keyframes are fused, at the same cost, by their information" {
  square >square.g2o
  sg-kf --revisit 0.5,1 --fuse square.g2o >fused.g2o
  [ "$(awk '/^EDGE/ {printf "%s-%s,", $2, $3}' fused.g2o)" = "2-3,3-0,0-1,2-1," ]
  for graph in fused plain; do
    [ $graph = fused ] || sg-kf --revisit 0.5,1 square.g2o >plain.g2o
    sg-solve -q $graph.g2o | grep ^VERTEX >$graph.solved
    sg-ec -m id --no-header -f ec $graph.g2o >$graph.ec
  done
  cmp fused.ec plain.ec
  [ "$(wc -l <fused.solved)" -eq 4 ]
  # measurements that disagree by decimetres are the same to first order
  paste -d' ' fused.solved plain.solved | awk '{for (i = 3; i <= 5; ++i) {d = $i - $(i + 5); if (d * d > 0.01) wrong = 1}} END {exit wrong}'
  # what has not moved stays
  { cat walk.g2o; grep 'EDGE_SE2 4 0' walk.g2o; } >twice.g2o
  sg-kf -r 1 --fuse --no-trace-comment twice.g2o | cmp - twice.g2o
  # exactly: two closures that agree are one of twice the information
  sg-kf -r 2 --fuse twice.g2o >once.g2o
  [ "$(grep -c 'EDGE_SE2 4 0' once.g2o)" -eq 2 ]
}

@test "closures that agree are fused into their sum, and chi-square stays" {
  { cat walk.g2o; for k in 3 4; do echo "EDGE_SE2 0 $k $k.2 0.3 0.1 40 0 0 40 0 90"; done; } >loops.g2o
  sg-kf -r 4 loops.g2o >plain.g2o
  sg-kf -r 4 --fuse loops.g2o >fused.g2o
  [ "$(grep -c '^EDGE_SE2 ' plain.g2o)" -eq 4 ]
  [ "$(grep -c '^EDGE_SE2 ' fused.g2o)" -eq 1 ]
  near "$(sg-score --no-header -f dopt fused.g2o)" "$(sg-score --no-header -f dopt plain.g2o)" 1e-2
  printf '%s\n' "VERTEX_SE2 0 0 0 0" "VERTEX_SE2 1 1 0 0" "VERTEX_SE2 2 2.5 0 0.1" "VERTEX_SE2 3 3 0 0" >two.g2o
  printf 'EDGE_SE2 %s 0 0 100 0 0 100 0 100\n' "0 1 1" "1 2 1" "2 3 1" "0 3 3" >>two.g2o
  printf 'EDGE_SE2 0 2 2 0 0 9 0 0 %s 0 7\n' 9 4 >>two.g2o  # both between keyframes; the third moves there
  sg-kf -r 2 two.g2o >plain.g2o
  sg-kf -r 2 --fuse two.g2o >fused.g2o
  [ "$(grep -c '^EDGE' plain.g2o)" -eq 4 ]
  [ "$(grep -c '^EDGE' fused.g2o)" -eq 1 ]
  near "$(sg-solve --chi2 fused.g2o)" "$(sg-solve --chi2 plain.g2o)"
}

@test "keyframes by covisibility" {
  # everybody sees the same three landmarks: of poses 1 to 4, those go that three others stand for
  { for k in 0 1 2 3; do echo "EDGE_SE2 $k $((k + 1)) 1 0 0 1 0 0 1 0 1"; done
    for k in 0 1 2 3 4; do for l in 10 11 12; do echo "EDGE_SE2_XY $k $l 1 0 1 0 1"; done; done; } >see.g2o
  poses() { sg-kf "$@" see.g2o | awk '/EDGE_SE2_XY/ {print $2}' | uniq | paste -sd' '; }
  [ "$(poses --covisible 0.9,3)" = "0 3 4" ]
  [ "$(poses --covisible 0.9,1)" = "0 4" ]
  [ "$(poses --covisible 1,4)" = "0 2 3 4" ]
  sg-kf --covisible 0.9,5 --no-trace-comment see.g2o 2>/dev/null | cmp - see.g2o
}

@test "the output file appears whole or not at all" {
  fails 3 "sg-kf: /dev/full: cannot write: No space left on device" sg-kf -r 2 -o /dev/full walk.g2o
  echo before >out.g2o
  run -1 sg-kf -r 2 -o out.g2o missing.g2o
  [ "$(cat out.g2o)" = before ]
}

@test "public graphs: counts of poses, and g2o text that reads back" {
  need_data
  for graph in intel CSAIL city10000 sphere2500 smallGrid3D; do
    poses=$(sg-kf -r 1 "$SGTOOLS_DATA/$graph.g2o" | sg-order -m id --print | wc -l)
    kept=$(sg-kf -r 4 "$SGTOOLS_DATA/$graph.g2o" | sg-order -m id --print | wc -l)
    [ "$kept" -ge $((poses / 4)) ]
    [ "$kept" -le $((poses / 4 + poses / 10 + 1)) ]
  done
}

@test "what no solver takes is not composed: the line is named" {
  sed '/EDGE_SE2 0 1/s/ [^ ]*$/ inf/' walk.g2o >inf.g2o
  sed '/EDGE_SE2 0 1/s/ [^ ]*$/ -1/' walk.g2o >indefinite.g2o
  line=$(grep -n 'EDGE_SE2 0 1' walk.g2o | cut -d: -f1)
  fails 1 "sg-kf: inf.g2o:$line: a number is not finite" sg-kf -r 2 -o out.g2o inf.g2o
  fails 1 "sg-kf: indefinite.g2o:$line: the information matrix is not positive semidefinite" \
    sg-kf -r 2 -o out.g2o indefinite.g2o
  [ ! -e out.g2o ]
}

@test "a linear factor is composed by sg-marg alone, and the line that is in the way is named" {
  sg-marg --ids 101 --topology dense walk.g2o -o three.g2o
  line=$(grep -n '^EDGE_LINEAR' three.g2o | cut -d: -f1)
  [[ "$(sed -n "${line}p" three.g2o)" == "EDGE_LINEAR_RELATIVE 2 2 3 4 "* ]]
  fails 1 "sg-kf: three.g2o:$line: cannot compose EDGE_LINEAR_RELATIVE across dropped poses (sg-marg takes poses out of linear factors)" \
    sg-kf -r 2 three.g2o
  sg-marg --ids 3 --topology dense three.g2o -o less.g2o
  near "$(sg-score --no-header -f kld --reference walk.g2o less.g2o)" 0
  grep -v XY walk.g2o | sg-marg --ids 1 --topology dense -o odometry.g2o
  line=$(grep -n '^EDGE_LINEAR' odometry.g2o | cut -d: -f1)
  fails 1 "sg-kf: odometry.g2o:$line: cannot compose odometry of type EDGE_LINEAR_RELATIVE across dropped poses (sg-marg takes poses out of linear factors)" \
    sg-kf -r 2 odometry.g2o
}

@test "linear factors to what prunes: a closure may go, a factor of three stays" {
  sg-gen manhattan -n 60 --seed 3 | sg-solve -q -o full.g2o
  sg-marg -r 2 --topology dense full.g2o -o left.g2o
  many() { awk '/^EDGE_LINEAR/ && $3 > 1 {++n} END {print n + 0}' "$1"; }
  [ "$(many left.g2o)" -gt 0 ]
  for policy in 'sg-dec -r 9' 'sg-rand -r 9' 'sg-tgreedy -r 9' 'sg-ecgreedy -p 0.1'; do
    echo "$policy"
    $policy -q left.g2o -o pruned.g2o
    [ "$(many pruned.g2o)" = "$(many left.g2o)" ]
    sg-check -q pruned.g2o
  done
}
