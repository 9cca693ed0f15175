load ../common

setup() { cd "$BATS_TEST_TMPDIR"; }

worlds() { printf '%s\n' sine worst manhattan city sphere torus grid3d; }
tags() { grep -v '^#' "$1" | cut -d' ' -f1 | sort | uniq -c | awk '{print $2 " " $1}'; }

@test "every world has a help page of its own" {
  for world in $(worlds); do
    sg-gen --help | grep -q "^  $world "
    sg-gen $world --help | grep -q "^Usage: sg-gen $world"
    [ "$(sg-gen $world --help | awk 'length > 80' | wc -l)" -eq 0 ]
  done
}

@test "the same seed gives the same bytes, another seed others" {
  for world in $(worlds); do
    cmp <(sg-gen $world -n 60) <(sg-gen $world -n 60)
    cmp <(sg-gen $world -n 60 --seed 1 --no-trace-comment) <(sg-gen $world -n 60 --no-trace-comment)
    run -1 cmp -s <(sg-gen $world -n 60 --no-trace-comment) <(sg-gen $world -n 60 --seed 2 --no-trace-comment)
  done
}

@test "the bytes are the same as ever" {
  # What a seed means is part of the interface: experiments are repeated by their call alone.
  sums=$(for world in $(worlds); do sg-gen $world -n 40 --no-trace-comment | md5sum | cut -c1-12; done | paste -sd' ')
  [ "$sums" = "6160c44c1d67 bf1a4bf7c117 7955e5026ed8 1843e76bbacb de653f6ae88f 89166384d160 1afe22e2336d" ] || { echo "$sums" >&2; false; }
}

@test "poses are as many as asked for, and ids have no gaps" {
  for world in $(worlds); do
    for n in 1 2 3 17 100; do
      sg-gen $world -n $n -o g.g2o
      [ "$(grep -cE '^VERTEX_SE' g.g2o)" -eq $n ]
      [ "$(awk '/^VERTEX/ && $2 != k++' g.g2o | wc -l)" -eq 0 ]
    done
  done
}

@test "sensors write g2o's types" {
  sg-gen sine -n 50 -o a; [ "$(tags a | cut -d' ' -f1 | paste -sd' ')" = \
    "EDGE_PROJECT_XYZ2UV:EXPMAP EDGE_SE3:EXPMAP PARAMS_CAMERAPARAMETERS VERTEX_SE3:EXPMAP VERTEX_TRACKXYZ" ]
  sg-gen sine -n 50 --sensor xyz -o a; [ "$(tags a | cut -d' ' -f1 | paste -sd' ')" = \
    "EDGE_SE3:QUAT EDGE_SE3_TRACKXYZ PARAMS_SE3OFFSET VERTEX_SE3:QUAT VERTEX_TRACKXYZ" ]
  sg-gen sine -n 50 --sensor disparity -o a; [ "$(tags a | cut -d' ' -f1 | paste -sd' ')" = \
    "EDGE_PROJECT_DISPARITY EDGE_SE3:QUAT PARAMS_CAMERACALIB VERTEX_SE3:QUAT VERTEX_TRACKXYZ" ]
  sg-gen sine -n 50 --dim 2 -o a; [ "$(tags a | cut -d' ' -f1 | paste -sd' ')" = \
    "EDGE_SE2 EDGE_SE2_XY VERTEX_SE2 VERTEX_XY" ]
  sg-gen sine -n 50 --dim 2 --sensor bearing -o a; [ "$(tags a | cut -d' ' -f1 | paste -sd' ')" = \
    "EDGE_BEARING_SE2_XY EDGE_SE2 VERTEX_SE2 VERTEX_XY" ]
}

@test "one world, of the manual's size where nobody gives one" {
  [ "$(sg-gen manhattan | grep -c ^VERTEX)" -eq 3500 ]
  fails 2 "sg-gen: 'worst' is one word too many: no file is read (see sg-gen --help)" sg-gen sine worst
  fails 2 "sg-gen: --step 2e12: must be from 0 to 1e+12 (see sg-gen --help)" sg-gen sine --step 2e12
}

@test "worst has every observation" {
  sg-gen worst -n 6 -l 9 -o a
  [ "$(tags a)" = "$(printf '%s\n' 'EDGE_PROJECT_XYZ2UV:EXPMAP 54' 'EDGE_SE3:EXPMAP 5' 'PARAMS_CAMERAPARAMETERS 1' \
    'VERTEX_SE3:EXPMAP 6' 'VERTEX_TRACKXYZ 9')" ]
}

@test "the truth has the same vertices, edges and information, and other measurements" {
  sg-gen sine -n 40 --sensor xyz --truth truth.g2o -o noisy.g2o
  [ "$(tags truth.g2o)" = "$(tags noisy.g2o)" ]
  strip() { awk '/^EDGE_SE3_TRACKXYZ/ {print $1, $2, $3, $4, $8, $9, $10, $11, $12, $13} /^VERTEX/ {print $1, $2}' "$1"; }
  cmp <(strip truth.g2o) <(strip noisy.g2o)
  run -1 cmp -s truth.g2o noisy.g2o
  sg-gen sine -n 40 --sensor xyz --truth - -o noisy.g2o --no-trace-comment | cmp - <(grep -v '^#' truth.g2o)
}

@test "a file says how it was made" {
  [ "$(sg-gen sine -n 3 --seed 7 | head -n 1)" = "# sg-gen sine -n 3 --seed 7" ]
  [ "$(sg-gen sine -n 3 --no-trace-comment | grep -c '^#')" -eq 0 ]
}

@test "what the other commands read" {
  for world in $(worlds); do sg-gen $world -n 50 | sg-ec --no-header -f vertices | grep -qE '^[0-9]+$'; done
}

@test "wrong calls" {
  fails 2 "sg-gen: which WORLD? There are sine, worst, manhattan, city, sphere, torus, grid3d (see sg-gen --help)" sg-gen
  fails 2 "sg-gen: no world 'nowhere'; there are sine, worst, manhattan, city, sphere, torus, grid3d (see sg-gen --help)" sg-gen nowhere
  fails 2 "sg-gen: -n 0: must be from 1 to 1000000000 (see sg-gen --help)" sg-gen sine -n 0
  fails 2 "sg-gen: -n -1: must be from 1 to 1000000000 (see sg-gen --help)" sg-gen manhattan -n -1
  fails 2 "sg-gen: --step nan is not a number (see sg-gen --help)" sg-gen sine --step nan
  fails 2 "sg-gen: --noise-trans 0: must be above 0 (see sg-gen --help)" sg-gen torus --noise-trans 0
  fails 2 "sg-gen: --amplitude -1: must be from 0 to 1e+12 (see sg-gen --help)" sg-gen sine --amplitude -1
  fails 2 "sg-gen: --sensor bearing belongs to --dim 2 (see sg-gen --help)" sg-gen sine --sensor bearing
  fails 2 "sg-gen: --sensor mono belongs to --dim 3 (see sg-gen --help)" sg-gen worst --dim 2 --sensor mono
  fails 2 "sg-gen: a camera's --fov is below 180 degrees (see sg-gen --help)" sg-gen sine --fov 180
  run -2 sg-gen sine --loops 0.5
  run -2 sg-gen sphere --loops 1.5
}

@test "a full disk, a missing folder, a reader that leaves" {
  fails 3 "sg-gen: <stdout>: cannot write: No space left on device" bash -c 'sg-gen sine >/dev/full'
  fails 3 "sg-gen: /dev/full: cannot write: No space left on device" sg-gen sine -o /dev/full
  run -3 sg-gen sine -o missing/a.g2o
  echo before >a.g2o
  run -3 sg-gen sine -o a.g2o --truth missing/b.g2o
  [ "$(cat a.g2o)" = before ]
  [ "$(ls)" = a.g2o ]
  said=$( { sg-gen manhattan -n 50000 | head -n 1 >/dev/null; echo "${PIPESTATUS[0]}"; } 2>&1)
  [ "$said" = 0 ]
}

@test "--outliers: the truth tells which edges are false" {
  for world in $(worlds); do
    sg-gen $world -n 80 --outliers 0.25 --truth truth -o noisy
    [ "$(wc -l <truth)" -eq "$(wc -l <noisy)" ]
    [ "$(grep -c '^# false ' truth)" -gt 3 ]
    cmp <(sed -n 's/^# false //p' truth) <(paste -d'|' truth noisy | sed -n 's/^# false [^|]*|//p')
    # What is left is the graph without them.
    cmp <(paste -d'|' truth noisy | grep -v '^# false ' | cut -d'|' -f2 | grep -v '^#') <(sg-gen $world -n 80 --no-trace-comment)
    cmp <(sg-gen $world -n 80 --outliers 0 --no-trace-comment) <(sg-gen $world -n 80 --no-trace-comment)
  done
}

@test "false edges of a seed are the same as ever" {
  sums=$(for world in $(worlds); do sg-gen $world -n 40 --outliers 0.2 --no-trace-comment | md5sum | cut -c1-12; done | paste -sd' ')
  [ "$sums" = "b500af946387 bf2e33d7c2b3 c1af009c3e72 d41d8cd98f00 cf1809a56407 f37e6725f4c2 4f135f36ef65" ] || { echo "$sums" >&2; false; }
}

@test "a world too small for outliers" {
  fails 3 "sg-gen: the world is too small for outliers of 10 standard deviations" sg-gen worst -n 4 -l 1 --outliers 0.2
  fails 2 "sg-gen: --outliers 1: must be from 0 to 0.99 (see sg-gen --help)" sg-gen sphere --outliers 1
}
