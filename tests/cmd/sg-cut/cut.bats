load ../common

setup() { cd "$BATS_TEST_TMPDIR"; cp "$TESTDATA"/* .; }

# The words that name it: tag, ids.
edges() { awk '/^EDGE/ {print $2 "-" $3}' "$@" | paste -sd ' '; }
vertices() { awk '/^VERTEX/ {print $2}' "$@" | paste -sd ' '; }

@test "the first poses, with what the replay adds by then" {
  sg-cut --poses 2 walk.g2o >out.g2o
  [ "$(vertices out.g2o)" = "0 1 100" ]
  [ "$(edges out.g2o)" = "0-1 0-100 1-100" ]
  sg-cut --poses 3 --min-obs 3 walk.g2o >out.g2o
  [ "$(vertices out.g2o)" = "0 1 2 100" ]
  [ "$(edges out.g2o)" = "0-1 0-100 1-2 1-100 2-100" ]
  sg-cut --poses 99 --no-trace-comment walk.g2o | cmp - walk.g2o
}

@test "a range of poses takes along what it sees" {
  sg-cut --range 3:4 walk.g2o >out.g2o
  [ "$(vertices out.g2o)" = "3 4 101" ]
  [ "$(edges out.g2o)" = "3-4 3-101 4-101" ]
  run -1 grep FIX out.g2o
  [ "$(sg-cut --range 4:99 walk.g2o | vertices)" = "4 101" ]
}

@test "a component, the largest one" {
  printf 'EDGE_SE2 1 2 0 0 0 1 0 0 1 0 1\nEDGE_SE2 5 6 0 0 0 1 0 0 1 0 1\nEDGE_SE2 6 7 0 0 0 1 0 0 1 0 1\n' >two.g2o
  [ "$(sg-cut --component 2 two.g2o | edges)" = "1-2" ]
  [ "$(sg-cut --largest two.g2o | edges)" = "5-6 6-7" ]
}

@test "ids" {
  sg-cut --ids 0:2,101 walk.g2o >out.g2o
  [ "$(vertices out.g2o)" = "0 1 2 101" ]
  [ "$(edges out.g2o)" = "0-1 1-2 2-101" ]
}

@test "tags, or all but tags" {
  sg-cut --tags VERTEX_SE2 walk.g2o >out.g2o
  [ "$(vertices out.g2o)" = "0 1 2 3 4" ]
  [ "$(edges out.g2o)" = "0-1 1-2 2-3 3-4 4-0" ]
  [ "$(sg-cut --tags EDGE_SE2_XY walk.g2o | edges)" = "0-100 1-100 2-100 2-101 3-101 4-101" ]
  sg-cut --without EDGE_SE2_XY walk.g2o >out.g2o
  [ "$(vertices out.g2o)" = "0 1 2 3 4" ]  # no edge joins the landmarks any more
  cmp <(sed 1,2d out.g2o) <(sg-cut --without VERTEX_XY walk.g2o | sed 1,2d)
  [ "$(sg-cut --without EDGE_SE2 walk.g2o | vertices)" = "0 1 2 3 4 100 101" ]
  sg-cut --without EDGE_SE3:QUAT --no-trace-comment walk.g2o | cmp - walk.g2o
  fails 2 "sg-cut: --without EDGE_SE2XY: no vertex or edge has this tag; did you mean EDGE_SE2_XY? There are VERTEX_SE2, VERTEX_XY, EDGE_SE2, EDGE_SE2_XY (see sg-cut --help)" \
    sg-cut --without EDGE_SE2XY walk.g2o
  fails 1 "sg-cut: walk.g2o: the part holds no vertex and no edge" sg-cut --tags EDGE_SE3:QUAT walk.g2o
}

@test "what stays keeps its bytes; the comment stands below those at the head" {
  printf '# one\r\n# two\n VERTEX_SE2 1  1.0 0 -0\r\nROBOTLASER1 0 1\nVERTEX_SE2 2 0 0 0\nROBOTLASER1 0 2\n# x\nFIX 2 1\r\n' >in.g2o
  printf 'EDGE_SE2  1 2 0 0 0 1 0 0 1 0 1\nEDGE_PRIOR_SE2 1 +1 0 0 1 0 0 1 0 1' >>in.g2o
  sg-cut --ids 1 in.g2o >out.g2o
  printf '# one\r\n# two\n# sg-cut --ids 1 in.g2o\n VERTEX_SE2 1  1.0 0 -0\r\nROBOTLASER1 0 1\n# x\nFIX 1\r\nEDGE_PRIOR_SE2 1 +1 0 0 1 0 0 1 0 1' |
    cmp - out.g2o
}

@test "a cut that removes nothing: the same bytes" {
  printf '# one\r\n\r\n VERTEX_SE2 1  1.0 0 -0\r\nROBOTLASER1 0 1\nVERTEX_SE2 2 0 0 0\nFIX 2 1\n\n' >in.g2o
  printf '\tEDGE_SE2  1 2 0 0 0 1 0 0 1 0 1 \r\n\n' >>in.g2o
  sg-cut --largest --no-trace-comment in.g2o | cmp - in.g2o
  sg-cut --largest in.g2o | cmp - <(sed '1a # sg-cut --largest in.g2o' in.g2o)
  printf 'EDGE_SE2 1 2 0 0 0 1 0 0 1 0 1' >in.g2o
  sg-cut --largest --no-trace-comment in.g2o | cmp - in.g2o
}

@test "its history reads in order" {
  sg-cut --poses 4 walk.g2o | sg-cut --range 1:3 >out.g2o
  [ "$(grep '^# sg-' out.g2o)" = "# sg-cut --poses 4 walk.g2o
# sg-cut --range 1:3" ]
}

@test "wrong calls" {
  one="sg-cut: which part? Give one of --poses, --range, --component, --largest, --ids, --tags, --without (see sg-cut --help)"
  fails 2 "$one" sg-cut walk.g2o
  fails 2 "sg-cut: which part? --poses keeps the first steps, --largest the largest connected part: give one of them (see sg-cut --help)" \
    sg-cut --largest --poses 3 walk.g2o
  fails 2 "sg-cut: --range x is no range FIRST:LAST (see sg-cut --help)" sg-cut --range x walk.g2o
  fails 2 "sg-cut: --range begins at pose 5, but there are 5 (see sg-cut --help)" sg-cut --range 5:6 walk.g2o
  fails 2 "sg-cut: --component: the graph has no vertex 7 (see sg-cut --help)" sg-cut --component 7 walk.g2o
  fails 2 "sg-cut: --ids 7: the graph has no such vertex (see sg-cut --help)" sg-cut --ids 7 walk.g2o
  run -2 sg-cut --poses 0 walk.g2o
}
