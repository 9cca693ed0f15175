load ../common

setup() { cd "$BATS_TEST_TMPDIR"; cp "$TESTDATA"/* .; }

# finds TEXT...: of the graph on standard input, sg-check prints these lines.
finds() {
  local wanted said code=0 status=0
  wanted=$(printf '%s\n' "$@")
  said=$(sg-check) || code=$?
  if [[ $wanted == *": error: "* ]]; then status=1; fi
  if [ "$said" = "$wanted" ] && [ "$code" = "$status" ]; then return; fi
  printf 'status %s:\n%s\ninstead of:\n%s\n' "$code" "$said" "$wanted" >&2
  return 1
}

pose='VERTEX_SE3:QUAT'
edge='EDGE_SE3:QUAT'
unit='1 0 0 0 0 0 1 0 0 0 0 1 0 0 0 1 0 0 1 0 1'

@test "a sound graph: nothing" {
  sg-check walk.g2o park.isam square.toro >out
  [ ! -s out ]
}

@test "public graphs are sound" {
  need_data
  sg-check "$SGTOOLS_DATA"/*.g2o "$SGTOOLS_DATA"/*.txt >out
  [ ! -s out ]
}

@test "all that is wrong with a bad one, by line" {
  run -1 sg-check broken.g2o
  printf '%s\n' "${lines[@]}" >out
  cut -d: -f2 out | sort -nc
  [ "$(wc -l <out)" = 14 ]
  run -1 sg-check -q broken.g2o
  [ "$output" = "$(grep ': error: ' out)" ]
}

@test "dangling edges and FIX lines" {
  printf 'VERTEX_SE2 1 0 0 0\nEDGE_PRIOR_SE2 2 0 0 0 1 0 0 1 0 1\nFIX 1 3\n' |
    finds '<stdin>:2: error: EDGE_PRIOR_SE2 joins vertex 2, which the file does not define' \
      '<stdin>:3: error: FIX names vertex 3, which the file does not define'
}

@test "duplicate ids" {
  printf 'VERTEX_SE2 1 0 0 0\n\nVERTEX_SE2 1 0 0 0\n' | finds '<stdin>:3: error: vertex 1 is defined a second time'
}

@test "self loops" {
  printf 'VERTEX_SE2 1 0 0 0\nEDGE_SE2 1 1 0 0 0 1 0 0 1 0 1\n' | finds '<stdin>:2: error: EDGE_SE2 joins vertex 1 to itself'
}

@test "NaN and infinite numbers" {
  printf 'VERTEX_SE2 1 nan 0 0\nVERTEX_SE2 2 0 0 0\nEDGE_SE2 1 2 0 0 -inf 1 0 0 1 0 1\n' |
    finds '<stdin>:1: error: a number is infinite or not a number' '<stdin>:3: error: a number is infinite or not a number'
}

@test "information that is not positive semidefinite; a singular one is" {
  printf 'EDGE_SE2 1 2 0 0 0 1 0 0 1 0 0\nEDGE_SE2 1 2 0 0 0 1 2 0 1 0 1\nEDGE_SE2 1 2 0 0 0 0 0 0 0 0 -1\n' |
    finds '<stdin>:2: error: the information matrix of EDGE_SE2 is not positive semidefinite' \
      '<stdin>:3: error: the information matrix of EDGE_SE2 is not positive semidefinite'
}

@test "lines are counted from the first, be it blank" {
  printf '\nVERTEX_SE2 1 0 0 0\nEDGE_SE2 1 1 0 0 0 1 0 0 1 0 1\n' >in.g2o
  run -1 sg-check in.g2o
  [[ "$output" == *"in.g2o:3: "*"joins vertex 1 to itself"* ]]
}

@test "TORO's own order of the information is known" {
  printf 'VERTEX_SE2 9 0 0 0\nVERTEX2 1 0 0 0\nVERTEX2 2 0 0 0\nEDGE2 1 2 0 0 0 1 0.9 1 1 0 0\n' |
    finds '<stdin>:1: warning: vertex 9 is not connected to the rest'
}

@test "quaternions" {
  printf "$pose 1 0 0 0 0 0 0 1.0001\n$pose 2 0 0 0 0 0 0 1.01\n$edge 1 2 0 0 0 0 0 0 0 $unit\n" |
    finds "<stdin>:2: warning: the quaternion's length is 1.010000" '<stdin>:3: error: a quaternion has length zero'
}

@test "disconnected parts are a warning, once each" {
  printf 'EDGE_SE2 5 6 0 0 0 1 0 0 1 0 1\nEDGE_SE2 1 2 0 0 0 1 0 0 1 0 1\nEDGE_SE2 2 3 0 0 0 1 0 0 1 0 1\n' |
    finds '<stdin>:1: warning: vertex 5 and 1 more are not connected to the rest'
  printf 'VERTEX_SE2 1 0 0 0\nVERTEX_SE2 2 0 0 0\n' | finds '<stdin>:2: warning: vertex 2 is not connected to the rest'
}

@test "landmarks that their observations cannot determine" {
  head='EDGE_SE2 1 2 1 0 0 1 0 0 1 0 1\nEDGE_BEARING_SE2_XY 1 9 0.5 1\n'
  wanted='<stdin>:2: error: vertex 9 (VERTEX_XY) is not determined by its observations'
  printf "$head" | finds "$wanted"
  printf "${head}EDGE_BEARING_SE2_XY 1 9 0.5 1\n" | finds "$wanted"  # from the same place
  printf "${head}EDGE_BEARING_SE2_XY 2 9 0.5 1\n" | sg-check
  printf "${head}EDGE_PRIOR_XY 9 0 0 1 0 1\n" | sg-check
}

@test "an empty file, and one that cannot be read" {
  finds '<stdin>: error: there is no vertex and no edge in it' </dev/null
  fails 1 "sg-check: missing.g2o: No such file or directory" sg-check missing.g2o
}

@test "many defects" {
  { echo 'VERTEX_SE2 0 0 0 0'; seq 200000 | sed 's/.*/EDGE_PRIOR_SE2 & 0 0 0 1 0 0 1 0 1/'; } >in.g2o
  run -1 sg-check -o out in.g2o
  [ "$(wc -l <out)" = 200000 ]
  tail -n 1 out | grep -q '^in.g2o:200001: error: '
}
