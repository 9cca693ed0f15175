# sg-solve --prior: measurements of where a vertex is, from the command line.
load ../common

setup() {
  cd "$BATS_TEST_TMPDIR"
  cp "$TESTDATA/walk.g2o" .
}

# as_edge LINE OPTION...: a call with --prior writes the bytes of a call with that line in the file, without the line.
as_edge() {
  { cat walk.g2o; echo "$1"; } > edge.g2o
  sg-solve --no-trace-comment edge.g2o | grep -vxF "$1" > expected
  shift
  sg-solve --no-trace-comment "$@" walk.g2o | diff expected -
}

@test "a prior is the edge that it stands for, and the file gets none" {
  as_edge "EDGE_PRIOR_SE2 4 4.1 0.2 0.1 4 0 0 4 0 4" --prior 4:4.1,0.2,0.1:0.5
  as_edge "EDGE_PRIOR_SE2 4 4.1 0.2 0.1 4 0 0 16 0 100" --prior 4:4.1,0.2,0.1:0.5,0.25,0.1
  as_edge "EDGE_PRIOR_SE2_XY 4 4.1 0.2 4 0 16" --prior 4:4.1,0.2:0.5,0.25
  as_edge "EDGE_PRIOR_XY 101 3 1.5 4 0 4" --prior 101:3,1.5:0.5
  as_edge "EDGE_PRIOR_SE2 4 4 0 0 4 0 0 4 0 4" --prior 4::0.5
}

@test "a prior moves what it is of" {
  moved() { sg-solve --no-trace-comment "$@" walk.g2o | awk '$1 == "VERTEX_SE2" && $2 == 4 {print $3}'; }
  near "$(moved --prior 4:5,0,0:1e-6)" 5 1e-6
  near "$(moved)" 4 1e-9
}

@test "several priors, of one vertex or of several" {
  sg-solve --no-trace-comment --prior 4:5,0:0.1 --prior 4:3,0:0.1 --prior 2::0.1 walk.g2o > out
  diff <(grep -v ^VERTEX walk.g2o) <(grep -v ^VERTEX out)
  near "$(awk '$1 == "VERTEX_SE2" && $2 == 4 {print $3}' out)" 4 1e-9
}

@test "in space: radians, though the error is a quaternion's, and an offset of its own" {
  sg-gen sphere -n 30 -o sphere.g2o
  line='EDGE_SE3_PRIOR 7 77 1 2 3 0.1 0 0 0.99498743710662 25 0 0 0 0 0 25 0 0 0 0 25 0 0 0 400 0 0 400 0 400'
  { cat sphere.g2o; echo "PARAMS_SE3OFFSET 77 0 0 0 0 0 0 1"; echo "$line"; } > edge.g2o
  sg-solve --no-trace-comment edge.g2o | grep -v -e PARAMS -e PRIOR > expected
  sg-solve --no-trace-comment --prior 7:1,2,3,0.1,0,0,0.99498743710662:0.2,0.2,0.2,0.1,0.1,0.1 sphere.g2o | diff expected -
  sg-solve --no-trace-comment --prior 7:1,2,3:0.2 sphere.g2o -o out
  diff <(grep -v ^VERTEX sphere.g2o) <(grep -v ^VERTEX out)
  # Parameters of the file's own stay, wherever they stand.
  sg-solve --no-trace-comment --prior 7:1,2,3:0.2 edge.g2o -o out
  diff <(grep -v ^VERTEX edge.g2o) <(grep -v ^VERTEX out)
}

@test "without VERTEX lines, and from a file of another format" {
  grep -v ^VERTEX walk.g2o > edges.g2o
  sg-solve --no-trace-comment --prior 4:5,0,0:1e-6 edges.g2o > out
  near "$(awk '$1 == "VERTEX_SE2" && $2 == 4 {print $3}' out)" 5 1e-6
  [ "$(grep -c PRIOR out)" -eq 0 ]
  fails 2 "sg-solve: --prior 4::1: the file has no VERTEX line to take the numbers from (see sg-solve --help)" \
    sg-solve --prior 4::1 edges.g2o
}

@test "what is no prior is told" {
  fails 2 "sg-solve: --prior 4: it is ID:NUMBERS:SIGMAS that is wanted (see sg-solve --help)" sg-solve --prior 4 walk.g2o
  fails 2 "sg-solve: --prior: the graph has no vertex 77 (see sg-solve --help)" sg-solve --prior 77::1 walk.g2o
  fails 2 "sg-solve: --prior 4:1,x:1: 'x' is no list of numbers (see sg-solve --help)" sg-solve --prior 4:1,x:1 walk.g2o
  fails 2 "sg-solve: --prior 4:1,:1: '1,' is no list of numbers (see sg-solve --help)" sg-solve --prior 4:1,:1 walk.g2o
  fails 2 "sg-solve: --prior 4:1,2,3,4:1: there is no prior of 4 numbers of a VERTEX_SE2 (see sg-solve --help)" \
    sg-solve --prior 4:1,2,3,4:1 walk.g2o
  fails 2 "sg-solve: --prior 4::1,1: it wants one standard deviation, or 3 (see sg-solve --help)" \
    sg-solve --prior 4::1,1 walk.g2o
  fails 2 "sg-solve: --prior 4::0: a standard deviation is above 0 (see sg-solve --help)" sg-solve --prior 4::0 walk.g2o
  fails 2 "sg-solve: --prior 4::: it wants one standard deviation, or 3 (see sg-solve --help)" sg-solve --prior 4:: walk.g2o
}

@test "a prior counts in the chi-square, as an edge does" {
  near "$(sg-solve --chi2 --prior 4:5,0:0.1 walk.g2o)" 100 1e-9
}
