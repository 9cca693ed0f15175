# sg-order --polish, and best as a user waits for it.
load ../common

setup() {
  cd "$BATS_TEST_TMPDIR"
  sg-gen city -n 300 > city.g2o
}

ec() { sg-ec -m file --no-header -f ec "$@"; }

@test "--polish lowers EC, never raises it, and says so" {
  for method in amd metis wmf rcm random; do
    before=$(sg-order -m $method city.g2o | ec)
    after=$(sg-order -v -m $method --polish city.g2o 2> log | ec)
    [ "$after" -le "$before" ]
    grep -qE "^sg-order: polish .* EC $after$" log
  done
  [ "$(sg-order -m rcm --polish city.g2o | ec)" -lt "$(sg-order -m rcm city.g2o | ec)" ]
  # The same again gives the same.
  cmp <(sg-order -m amd --polish --print city.g2o) <(sg-order -m amd --polish --print city.g2o)
}

@test "--polish of an order from a file keeps --last" {
  sg-order -m id --print city.g2o > order
  sg-order --apply order --last 7,9 --polish --print city.g2o > polished
  [ "$(tail -n 2 polished | sort -n | paste -sd ' ')" = "7 9" ]
  cmp <(sort order) <(sort polished)
  [ "$(sg-order --apply polished city.g2o | ec)" -lt "$(sg-order --apply order --last 7,9 city.g2o | ec)" ]
}

@test "best polishes, and says so" {
  sg-order -v -m best --budget 0t city.g2o 2> log > out.g2o
  grep -qE '^sg-order: polish: EC [0-9]+ after 0 tries' log
}

@test "best -v says each improvement in sg-ec and sg-solve, too" {
  sg-ec -v -m best --budget 16t -f ec --no-header city.g2o 2> log > score
  grep -E '^sg-ec: .*: EC [0-9]+ after [0-9]+ tries' log | tail -n 1 | grep -q "EC $(cat score) after"
  sg-solve -v -i 1 -m best --budget 0t city.g2o 2> log > /dev/null
  grep -qE '^sg-solve: .*: EC [0-9]+ after 0 tries' log
}
