# sg-isam2: poses that leave, by lag, distance and budget; online error.
load ../common

setup() { cd "$BATS_TEST_TMPDIR"; }

# corridor N: odometry along a line with landmarks on both sides, each seen from four poses in a row.
corridor() {
  for ((k = 0; k < $1; ++k)); do
    if ((k > 0)); then echo "EDGE_SE2 $((k - 1)) $k 1 0.01 0.01 100 0 0 100 0 400"; fi
    if ((k % 3 == 0)); then
      for ((i = k; i < k + 4 && i < $1; ++i)); do echo "EDGE_SE2_XY $i $((10000 + k)) $((2 - i + k)) 1 50 0 50"; done
    fi
  done
}

@test "a lag beyond the graph's length is plain iSAM2, byte for byte" {
  local columns=step,variables,factors,ec_bt,reeliminated,relinearized,cliques,chi2,ec_step
  sg-gen manhattan -n 150 -o world.g2o
  sg-gen sine --sensor xyz -n 30 -o wide.g2o  # cliques of more rows than are left as they are (relaxed)
  for file in world.g2o wide.g2o "$TESTDATA/types-se3.g2o"; do
    sg-isam2 -f $columns -o plain.g2o "$file" > plain.tsv
    sg-isam2 -q --lag 150 --smooth -f $columns -o lag.g2o "$file" > lag.tsv
    cmp plain.tsv lag.tsv
    sg-isam2 -q --budget 1e15 -f $columns "$file" | cmp plain.tsv -
    grep -v '^# sg-isam2' plain.g2o > plain.txt
    grep -v '^# sg-isam2' lag.g2o | cmp plain.txt -
  done
}

@test "a pose that only what has left would determine ends the replay, and the message says what to do" {
  for k in 0 1 2 3; do echo "EDGE_SE2 $k $((k + 1)) 1 0 0 1 0 0 1 0 1"; done > in.g2o
  echo "EDGE_SE2 0 5 1 0 0 1 0 0 1 0 1" >> in.g2o
  sg-isam2 -q in.g2o > rows
  fails 3 "sg-isam2: step 5: the system is singular: what the window still holds leaves vertex 5 undetermined; a longer lag or a larger budget keeps more of what determines it" \
    sg-isam2 -q --lag 3 in.g2o
  sg-isam2 -q --lag 5 in.g2o > rows
}

@test "--lag N: N poses are there, and their landmarks; edges and cliques stay few" {
  corridor 200 > corridor.g2o
  sg-isam2 -q --lag 10 -f window,variables,factors,cliques,dropped --no-header corridor.g2o > rows.tsv
  [ "$(cut -f 1 rows.tsv | sort -n | uniq -c | awk '$1 > 1 {print $2, $1}')" = "10 191" ]
  [ "$(cut -f 2 rows.tsv | sort -n | tail -n 1)" -le 15 ]
  [ "$(cut -f 3 rows.tsv | sort -n | tail -n 1)" -le 26 ]
  [ "$(cut -f 4 rows.tsv | sort -n | tail -n 1)" -le 15 ]
  [ "$(cut -f 5 rows.tsv | sort -u)" = 0 ]
}

@test "on a corridor the window is where the whole graph's estimate is, and so is the smoothed past" {
  corridor 60 > corridor.g2o
  local exact="--relinearize-skip 0 --wildfire-threshold 0"
  sg-isam2 $exact -o whole.g2o corridor.g2o > whole.tsv
  sg-isam2 -q $exact --lag 8 --smooth -o lag.g2o corridor.g2o > lag.tsv
  grep ^VERTEX whole.g2o > whole.txt
  grep ^VERTEX lag.g2o | paste -d ' ' whole.txt - > both.txt
  [ "$(wc -l < both.txt)" -eq 80 ]
  awk '{h = NF / 2; for (i = 3; i <= h; ++i) {d = $i - $(i + h); if (d > 1e-9 || d < -1e-9) exit 1}}' both.txt
}

@test "without --smooth the past stays where it was when it left" {
  corridor 60 > corridor.g2o
  sg-isam2 -q --lag 8 -o left.g2o corridor.g2o > rows.tsv
  sg-isam2 -q --lag 8 --smooth -o smooth.g2o corridor.g2o > again.tsv
  run -1 cmp <(grep "^VERTEX_SE2 20 " left.g2o) <(grep "^VERTEX_SE2 20 " smooth.g2o)
  cmp <(grep "^VERTEX_SE2 59 " left.g2o) <(grep "^VERTEX_SE2 59 " smooth.g2o)
}

@test "--lag-distance D: by the path" {
  corridor 40 > corridor.g2o
  [ "$(sg-isam2 -q --lag-distance 5.5 -f window --no-header corridor.g2o | tail -n 1)" -eq 6 ]
  [ "$(sg-isam2 -q --lag-distance 0 -f window --no-header corridor.g2o | tail -n 1)" -eq 1 ]
}

@test "a closure to what has left is dropped, and told in the column and the summary" {
  { corridor 30; echo "EDGE_SE2 0 25 25 0 0 100 0 0 100 0 100"; } > loop.g2o
  run -0 --separate-stderr sg-isam2 --lag 5 -f dropped --no-header loop.g2o
  [ "${lines[24]}" = 0 ]
  [ "${lines[25]}" = 1 ]
  grep -x "sg-isam2: 1 edges named what had left, and were dropped" <<< "$stderr"
  grep -E "^sg-isam2: ec_step: p50 [0-9]+ p95 [0-9]+ p99 [0-9]+ max [0-9]+$" <<< "$stderr"
}

@test "--budget: no step ends above it; one that is too small is told" {
  sg-gen manhattan -n 300 -o world.g2o
  run -0 --separate-stderr sg-isam2 --budget 50000 -f ec_bt,window,violations --no-header world.g2o
  [ "$(cut -f 1 <<< "$output" | sort -n | tail -n 1)" -le 50000 ]
  [ "$(cut -f 1 <<< "$output" | sort -n | tail -n 1)" -gt 40000 ]
  [ "$(tail -n 1 <<< "$output" | cut -f 3)" = 0 ]
  grep -x "sg-isam2: no step ended above the budget" <<< "$stderr"
  grep -E "^sg-isam2: choosing: [0-9.e-]+ of the time of the steps$" <<< "$stderr"
  run -0 --separate-stderr sg-isam2 --budget 20 -f violations --no-header "$TESTDATA/walk.g2o"
  [ "${lines[4]}" -gt 0 ]
  grep "steps ended above the budget" <<< "$stderr"
}

@test "--spend measurements: all poses stay, the budget is kept, and better ones come for worse" {
  sg-gen manhattan -n 400 -o world.g2o
  sg-isam2 -q --budget 60000 --spend measurements -f ec_bt,window,offered,admitted,returned,violations --no-header world.g2o > rows.tsv
  [ "$(cut -f 1 rows.tsv | sort -n | tail -n 1)" -le 60000 ]
  [ "$(cut -f 1 rows.tsv | sort -n | tail -n 1)" -gt 50000 ]
  read -r _ window offered admitted returned violations < <(tail -n 1 rows.tsv)
  [ "$window" = 400 ]
  [ "$offered" -gt "$admitted" ]
  [ "$admitted" -gt "$returned" ]
  [ "$returned" -gt 0 ]
  [ "$violations" = 0 ]
}

@test "--spend measurements: where odometry alone is above the budget, the oldest leave" {
  sg-gen manhattan -n 400 -o world.g2o
  sg-isam2 -q --budget 10000 --spend measurements -f ec_bt,window,violations --no-header world.g2o > rows.tsv
  [ "$(cut -f 1 rows.tsv | sort -n | tail -n 1)" -le 10000 ]
  [ "$(tail -n 1 rows.tsv | cut -f 2)" -lt 400 ]
  [ "$(tail -n 1 rows.tsv | cut -f 3)" = 0 ]
}

@test "--spend keyframes: poses are composed, closures to them move, and the budget is kept" {
  sg-gen manhattan -n 400 --truth truth.g2o -o world.g2o
  sg-isam2 -q --budget 40000 --spend keyframes -f ec_bt,window,composed,moved,dropped,violations --no-header -o end.g2o world.g2o > rows.tsv
  [ "$(cut -f 1 rows.tsv | sort -n | tail -n 1)" -le 40000 ]
  read -r _ window composed moved dropped violations < <(tail -n 1 rows.tsv)
  [ "$((window + composed))" -eq 400 ]  # none leaves by age
  [ "$composed" -gt 100 ]
  [ "$moved" -gt "$composed" ]
  [ "$violations" = 0 ]
  # Every pose is written, where its keyframe says.
  sg-isam2 -q --budget 40000 -o window.g2o world.g2o > window.tsv
  [ "$(sg-score -q --reference truth.g2o -f matched --no-header end.g2o)" = "$(sg-score -q --reference truth.g2o -f matched --no-header window.g2o)" ]
}

@test "--spend keyframes: cameras' poses are composed, too" {
  sg-gen sine -n 100 --density 0.03 -o world.g2o
  sg-isam2 -q --min-obs 3 --budget 2e5 --spend keyframes -f ec_bt,composed,violations --no-header world.g2o > rows.tsv
  [ "$(cut -f 1 rows.tsv | sort -n | tail -n 1)" -le 200000 ]
  [ "$(tail -n 1 rows.tsv | cut -f 2)" -gt 20 ]
  [ "$(tail -n 1 rows.tsv | cut -f 3)" = 0 ]
}

@test "--spend mixed: where no way leads back it is a window; where one does, poses are composed" {
  corridor 200 > corridor.g2o
  sg-isam2 -q --budget 3000 -f ec_bt,window --no-header corridor.g2o > window.tsv
  sg-isam2 -q --budget 3000 --spend mixed -f ec_bt,window --no-header corridor.g2o > mixed.tsv
  cmp window.tsv mixed.tsv
  sg-gen manhattan -n 400 -o world.g2o
  sg-isam2 -q --budget 40000 --spend mixed -f ec_bt,composed,violations --no-header world.g2o > rows.tsv
  [ "$(cut -f 1 rows.tsv | sort -n | tail -n 1)" -le 40000 ]
  [ "$(tail -n 1 rows.tsv | cut -f 2)" -gt 50 ]
  [ "$(tail -n 1 rows.tsv | cut -f 3)" = 0 ]
}

@test "a budget without end admits every measurement, and ends where plain iSAM2 does" {
  sg-gen manhattan -n 150 -o world.g2o
  sg-isam2 -q --budget 1e15 --spend measurements --chi2 -f chi2,offered,admitted,returned --no-header world.g2o | tail -n 1 > all.tsv
  read -r chi2 offered admitted returned < all.tsv
  [ "$offered" = "$admitted" ]
  [ "$returned" = 0 ]
  near "$chi2" "$(sg-isam2 -f chi2 --no-header world.g2o | tail -n 1)" 0.01
}

@test "--renew: the tree is ordered anew when it is worn, and says the same" {
  sg-gen manhattan -n 400 -o world.g2o
  sg-isam2 --renew 1.2 -f ec_bt,renewed,chi2 --no-header world.g2o | tail -n 1 > renewed.tsv
  [ "$(cut -f 2 renewed.tsv)" -gt 0 ]
  [ "$(sg-isam2 --renew 1e9 -f renewed --no-header world.g2o | tail -n 1)" = 0 ]
  near "$(cut -f 3 renewed.tsv)" "$(sg-isam2 -f chi2 --no-header world.g2o | tail -n 1)" 0.01
  run -2 sg-isam2 --renew 0.5 world.g2o
}

@test "--budget-ms: an EC that follows what steps take" {
  sg-gen manhattan -n 200 -o world.g2o
  sg-isam2 -q --budget-ms 1000 -f window,budget --no-header world.g2o > rows.tsv
  [ "$(wc -l < rows.tsv)" -eq 200 ]
  [ "$(awk '$2 < 1' rows.tsv | wc -l)" -eq 0 ]
}

@test "--truth: the newest pose's error; none where the graph is the truth" {
  sg-gen manhattan -n 60 --truth truth.g2o -o world.g2o
  sg-isam2 -q --truth truth.g2o -f error --no-header world.g2o > noisy.tsv
  [ "$(head -n 1 noisy.tsv)" = 0 ]
  awk '{if ($1 > most) most = $1} END {exit !(0.001 < most && most < 20)}' noisy.tsv
  sg-isam2 -q --truth truth.g2o -f error --no-header truth.g2o > exact.tsv
  awk '{if ($1 > 1e-6) exit 1}' exact.tsv
}

@test "--sigma is sg-cov's" {
  sg-isam2 --relinearize-threshold 0 --wildfire-threshold 0 -f sigma --no-header -o end.g2o "$TESTDATA/walk.g2o" > sigma.tsv
  [ "$(head -n 1 sigma.tsv)" = 0 ]
  last=$(awk '$1 ~ /VERTEX_SE2/ {print $2}' end.g2o | sort -n | tail -n 1)
  near "$(tail -n 1 sigma.tsv)" "$(sg-cov -f id,sigma --no-header end.g2o | awk -v id="$last" '$1 == id {print $2}')" 1e-6
}

@test "landmarks wait for observations that the window holds" {
  { corridor 20
    echo "EDGE_SE2_XY 2 9000 1 1 50 0 50"; echo "EDGE_SE2_XY 12 9000 -9 1 50 0 50"; echo "EDGE_SE2_XY 14 9000 -11 1 50 0 50"
  } > late.g2o
  sg-isam2 -q --lag 5 --min-obs 2 -f dropped,variables --no-header late.g2o > rows.tsv
  [ "$(cut -f 1 rows.tsv | tail -n 1)" = 1 ]
}

@test "usage errors of poses that leave" {
  run -2 sg-isam2 --lag 0 "$TESTDATA/walk.g2o"
  fails 2 "sg-isam2: --budget bounds the complexity, --budget-ms the time: give one of them (see sg-isam2 --help)" \
    sg-isam2 --budget 5 --budget-ms 5 "$TESTDATA/walk.g2o"
  fails 2 "sg-isam2: --spend has no effect without a budget to spend (see sg-isam2 --help)" \
    sg-isam2 --spend window "$TESTDATA/walk.g2o"
  fails 2 "sg-isam2: --smooth has no effect without --lag, --lag-distance or a budget: nothing leaves (see sg-isam2 --help)" \
    sg-isam2 --smooth -o x.g2o "$TESTDATA/walk.g2o"
  fails 2 "sg-isam2: --smooth has no effect without -o, which writes what is smoothed (see sg-isam2 --help)" \
    sg-isam2 --smooth --lag 3 "$TESTDATA/walk.g2o"
  fails 2 "sg-isam2: --batch has no effect where poses leave: the whole is not there to be eliminated (see sg-isam2 --help)" \
    sg-isam2 --batch --lag 3 "$TESTDATA/walk.g2o"
}

rms() {
  awk '{sum += $1 * $1} END {print sqrt(sum / NR)}'
}
# errors OPTION...: of the newest pose of in.g2o, step by step.
errors() {
  sg-isam2 -q --truth truth.g2o -f error --no-header "$@" in.g2o > errors
  [ "$(wc -l < errors)" = 120 ]
}
# world SENSOR: a sine with that sensor, and the error of its odometry alone.
world() {
  sg-gen sine -n 120 $1 --truth truth.g2o -o in.g2o
  errors --lag 3 --min-obs 1000
  alone=$(rms < errors)
}
sensors=("--sensor mono" "--sensor xyz" "--sensor disparity" "--dim 2 --sensor bearing")

@test "a window, of any lag and by any sensor, is no worse than twice its odometry alone" {
  for sensor in "${sensors[@]}"; do
    world "$sensor"
    for lag in 2 3 5 8 12 20; do
      errors --min-obs 3 --lag $lag
      awk -v error="$(rms < errors)" -v alone="$alone" 'BEGIN {print error, alone; exit !(error < 2 * alone)}'
    done
  done
}

@test "a budget that landmarks would exceed if all were at hand still keeps them" {
  for sensor in "${sensors[@]}"; do
    world "$sensor"
    errors --min-obs 3 --budget 1e6 --spend keyframes
    awk -v error="$(rms < errors)" -v alone="$alone" 'BEGIN {print error, alone; exit !(error < 0.8 * alone)}'
  done
}
