load ../common

setup() { cd "$BATS_TEST_TMPDIR"; cp "$TESTDATA/walk.g2o" .; }

page() { python3 "$BATS_TEST_DIRNAME/page.py" "$@"; }

# town: a small graph with landmarks, closures and something to prune.
town() { sg-gen city -n 60 --seed 3 -o town.g2o; }

@test "every table is what its call prints" {
  town
  sg-report --budget 1e9 --policies kf -r 2 town.g2o -o town.html
  page sheets town.html
  sg-order -m amd walk.g2o -o ordered.g2o  # an order of the file's own comes first
  sg-report --budget 1e9 --policies kf -r 2 ordered.g2o -o ordered.html
  page sheets ordered.html
  grep -q '"rows":\[\["file",' ordered.html
}

@test "EC, sigma and ATE of every policy are what its calls print" {
  town
  sg-report --budget 1e9 -r 2 town.g2o -o town.html
  page variants town.html
  for policy in full kf dec aligned rand covisible ecgreedy 'kf|ecgreedy' tgreedy; do
    grep -qF "[\"$policy\"," town.html
  done
}

@test "rays want landmarks of three observations, and other words of a call are kept" {
  sg-gen sine -n 40 -o rays.g2o
  sed 's/^EDGE_SE2 /MINE /' walk.g2o >mine.g2o
  sg-report --budget 1e9 --policies dec,kf -r 2,3 rays.g2o -o rays.html
  grep -qF '"sg-dec -r 3 --min-obs 3 rays.g2o | sg-order -m colamd"' rays.html
  page variants rays.html
  sg-report --budget 1e9 --policies dec,kf,rand -r 2,3 --alias MINE=EDGE_SE2 mine.g2o -o mine.html
  grep -qF '"sg-dec -r 2 --alias MINE=EDGE_SE2 mine.g2o | sg-order -m colamd --alias MINE=EDGE_SE2"' mine.html
  page variants mine.html
}

@test "what is recommended costs what is told, whatever is wanted" {
  town
  for want in faster=1.5 faster=3 ate=0.5 sigma-part=1.2; do
    sg-report --budget 1e9 -r 2,4 --want $want town.g2o -o town.html
    page advice town.html
    # Whether one is twice as fast is measured: a busy machine may say no.
    [ "${want%=*}" = faster ] || grep -q "\"wish\":\"$want\",.*\"granted\":true" town.html
  done
  sg-report --budget 1e9 --policies rand -r 2 --want ate=1e-30 walk.g2o -o walk.html
  sg-report --budget 1e9 --policies rand -r 2 --want faster=1e6 walk.g2o | grep -q '"sentence":"Nothing that was tried has faster=1e6; the nearest: .*"granted":false'
}

@test "errors are those against a reference" {
  town
  sg-solve town.g2o -o truth.g2o
  sg-report --budget 1e9 --policies kf -r 2 --reference truth.g2o town.g2o -o town.html
  page variants town.html
  grep -qF 'sg-score --reference truth.g2o ' town.html
}

@test "several graphs are chapters, and a file's name may be anything" {
  cp walk.g2o "<!--&'<script>.g2o"
  sg-report --budget 1e9 --policies rand -r 2 walk.g2o "<!--&'<script>.g2o" -o two.html
  [ "$(grep -o '<div class="drawn"' two.html | wc -l)" -eq 2 ]
  [ "$(grep -o '</script>' two.html | wc -l)" -eq 3 ]
  page advice two.html
  sg-report --budget 1e9 --policies rand -r 2 <walk.g2o | grep -qF '"sg-info GRAPH"'
}

@test "what cannot be measured is told on the page" {
  # Tags without a model are ordered, scored and pruned.
  sed 's/^EDGE_SE2 /EDGE_X /' walk.g2o >x.g2o
  sg-report --edge EDGE_X:2 --policies dec,kf,ecgreedy -r 2 x.g2o -o x.html
  [ "$(grep -o 'not timed and not solved: x.g2o:10: EDGE_X has no measurement model here' x.html | wc -l)" -eq 1 ]
  grep -qF 'kf 2: cannot compose odometry of type EDGE_X across dropped poses' x.html
  grep -qF '["dec","2","colamd","7","9",' x.html
  sed 's/^VERTEX_SE2 /VERTEX_X /' walk.g2o >y.g2o
  sg-report --vertex VERTEX_X:3:pose --policies dec -r 2 y.g2o | grep -qF 'no map: y.g2o:2: VERTEX_X has no place on a map'
  # A budget that is used up at once leaves the whole graph's EC, and says what it had no time for.
  sg-report --budget 1e-9 walk.g2o -o none.html
  grep -qF 'no time (--budget) for kf 2, kf 4,' none.html
  grep -q '"variants":.*"rows":\[\["full","","colamd","7","11","697","1","","","",""\]' none.html
}

@test "a page in a browser: its numbers, no errors, nothing from the network, keyboard alone, a narrow screen, dark" {
  browser=$(command -v chromium || command -v chromium-browser || command -v google-chrome) || skip "no browser: chromium is not installed"
  town
  sg-report --budget 1e9 -r 2 town.g2o -o town.html
  python3 "$BATS_TEST_DIRNAME/browser.py" "$browser" town.html
}

@test "interrupted once, it writes the page with what there is" {
  town
  python3 - "$BATS_TEST_DIRNAME/../sg-all" <<'PYTHON'
import signal, sys
sys.path.insert(0, sys.argv[1])
from held import Held
held = Held(["sg-report", "-v", "town.g2o", "-o", "town.html"], "stderr")
held.interrupt()
status, said, _ = held.release()
assert status == -signal.SIGINT, (status, said)
PYTHON
  [ "$(tail -n 1 town.html)" = "</html>" ]
  grep -qF 'no time (--budget) for kf 2' town.html
  page advice town.html
  [ "$(ls)" = "$(printf '%s\n' faster.g2o town.g2o town.html walk.g2o)" ]
}

@test "slips" {
  fails 2 "sg-report: --want is faster=TIMES, ate=ERROR or sigma-part=TIMES, with a number above 0, not 'quick' (see sg-report --help)" \
    sg-report --want quick walk.g2o
  run -2 sg-report --want faster=0 walk.g2o
  run -2 sg-report --want faster=nan walk.g2o
  fails 2 "sg-report: a page's name ends in .html; not so 'page.pdf' (see sg-report --help)" sg-report -o page.pdf walk.g2o
  run -2 sg-report --policies kef walk.g2o
  [[ $output == *"kef: did you mean kf?"* ]]
  run -2 sg-report -r 1 walk.g2o
  run -2 sg-report -m colmad walk.g2o
  [ "$(ls)" = walk.g2o ]
}
