load ../common

setup() { cd "$BATS_TEST_TMPDIR"; cp "$TESTDATA"/* .; }

# is KEY VALUE [FILE]
is() {
  local said
  said=$(sg-info -f "$1" --no-header "${3:-walk.g2o}")
  [ "$said" = "$1	$2" ] || { echo "$said, not $2" >&2; return 1; }
}

@test "counts of a small graph" {
  is format g2o; is vertices 7; is poses 5; is landmarks 2; is fixed 1
  is edges 11; is odometry 4; is loop_closures 1; is observations 6; is other_edges 0
  is segments 1; is components 1; is isolated 0
  is dim 16      # four poses and two landmarks are free
  is rows 27     # 5 * 3 + 6 * 2
  is obs_per_landmark 3; is obs_per_pose 1.2
  is id_min 0; is id_max 101; is estimates yes; is order ''
  is max_edges_per_vertex 4
  is VERTEX_SE2 5; is EDGE_SE2_XY 6; is '#' 1; is FIX 1
}

@test "the tags and the format of the file itself" {
  is format isam park.isam; is ODOMETRY 4 park.isam; is estimates no park.isam
  is format toro square.toro; is EDGE3 4 square.toro
}

@test "compressed files are opened" {
  gzip -k walk.g2o
  is edges 11 walk.g2o.gz
  if command -v zstd >/dev/null; then zstd -q walk.g2o; is edges 11 walk.g2o.zst; fi
}

@test "segments and parts" {
  printf 'EDGE_SE2 1 2 0 0 0 1 0 0 1 0 1\nEDGE_SE2 3 4 0 0 0 1 0 0 1 0 1\n' >two.g2o
  is segments 2 two.g2o; is components 2 two.g2o
  printf 'VERTEX_SE2 1 0 0 0\nVERTEX_SE2 2 0 0 0\nEDGE_SE2 1 1 0 0 0 1 0 0 1 0 1\n' >lone.g2o
  is isolated 1 lone.g2o; is other_edges 1 lone.g2o
}

@test "an ordered file says so" {
  sg-order -m amd walk.g2o >ordered.g2o
  is order amd ordered.g2o
}

@test "JSON is one object with the same facts" {
  sg-info --json walk.g2o >out.json
  [ "$(wc -l <out.json)" = 1 ]
  grep -q '"edges": 11, ' out.json
  grep -q '"order": null, ' out.json
  [ "$(sg-info --json -f edges,poses walk.g2o)" = '{"edges": 11, "poses": 5}' ]
}

@test "a key that is not there" {
  printf 'EDGE_SE2 1 2 0 0 0 1 0 0 1 0 1\n' >one.g2o
  keys=$(sg-info --no-header one.g2o | cut -f 1 | paste -sd , | sed 's/,/, /g')
  fails 2 "sg-info: no column 'colour'; there are $keys (see sg-info --help)" sg-info -f colour one.g2o
}

@test "public graphs have as many vertices and edges as published" {
  need_data
  is vertices 7120 "$SGTOOLS_DATA/victoriaPark.isam.txt"; is edges 10608 "$SGTOOLS_DATA/victoriaPark.isam.txt"
  is vertices 10000 "$SGTOOLS_DATA/city10000.g2o"; is edges 20687 "$SGTOOLS_DATA/city10000.g2o"
}

@test "a byte-order mark is passed over, and UTF-16 is named" {
  { printf '\xEF\xBB\xBF'; cat "$TESTDATA/walk.g2o"; } >marked.g2o
  diff <(sg-info --no-header marked.g2o | tail -n +2) <(sg-info --no-header walk.g2o | tail -n +2)
  iconv -f UTF-8 -t UTF-16 "$TESTDATA/walk.g2o" >wide.g2o
  fails 1 "sg-info: wide.g2o:1: UTF-16 text: convert it (iconv -f UTF-16 -t UTF-8)" sg-info wide.g2o
}
