# Where things are drawn, read from the SVG's own numbers.
load ../common

setup() { cd "$BATS_TEST_TMPDIR"; }

# numbers FILE: the coordinates of the paths on the page (glyphs and their definitions aside), a pair a line.
numbers() {
  sed -n '/id="surface1"/,$p' "$1" | grep -o ' d="[^"]*"' | grep -oE -- '-?[0-9.]+ -?[0-9.]+'
}

# bar FILE: the length of the scale bar.
bar() {
  grep -o 'stroke-width:1.5;.* d="[^"]*"' "$1" | grep -oE ' d=".*"' | grep -oE '[0-9.]+' | awk '{n[NR] = $1} END {print n[3] - n[1]}'
}

@test "nothing is drawn outside of the page" {
  sg-gen manhattan -n 60 -o m.g2o
  sg-plot map -o map.svg m.g2o
  sg-plot map --cost -o cost.svg m.g2o
  sg-plot pattern -o pattern.svg m.g2o
  sg-plot tree -o tree.svg m.g2o
  for picture in map cost pattern tree; do
    [ "$(numbers $picture.svg | wc -l)" -gt 10 ]
    numbers $picture.svg | awk '$1 < 0 || $1 > 600 || $2 < 0 || $2 > 600 {print; bad = 1} END {exit bad}'
  done
}

@test "the scale bar is the longest of 1, 2, 5 times a power of ten in a fifth of the width" {
  for size in 1 1.3 1.7 2.2 2.9 3.7 4.8 6.2 8 9.5; do
    printf 'VERTEX_SE2 0 0 0 0\nVERTEX_SE2 1 %s 0 0\n' "$size" > line.g2o
    sg-plot map -o line.svg line.g2o
    # 552 points are `size`; the bar in metres is 1, 2 or 5 times a power of ten, and 2.5 times it would not fit.
    awk -v bar="$(bar line.svg)" -v size="$size" 'BEGIN {
      metres = bar * size / 552; digit = metres / 10 ^ int(log(metres * 1.0001) / log(10) + 100) * 1e100
      ok = (digit - 1) ^ 2 < 1e-4 || (digit - 2) ^ 2 < 1e-4 || (digit - 5) ^ 2 < 1e-4
      exit !(ok && bar <= 120 && bar * 2.5 > 120)}'
  done
}

@test "a Bayes tree that is a chain goes down at the left, the children of a star stand side by side" {
  left_of() { grep 'fill:rgb' "$1" | grep -oE ' d="M [0-9.]+ [0-9.]+ L [0-9.]+ [0-9.]+ L' | awk '{print $2, $3}' | awk '$2 < 580' | grep -v '^0 0$'; }
  printf 'EDGE_SE2 %s 1 0 0 1 0 0 1 0 1\n' "0 1" "1 2" "2 3" > chain.g2o
  sg-plot tree -m id -o chain.svg chain.g2o
  [ "$(left_of chain.svg | awk '{print $1}' | sort -u)" = 24 ]
  [ "$(left_of chain.svg | awk '{print $2}' | sort -u | wc -l)" -eq 3 ]
  for k in 1 2 3 4 5 6 7 8; do printf 'EDGE_SE2 9 %s 1 0 0 1 0 0 1 0 1\n' $k; done | sg-plot tree -m id -o star.svg
  [ "$(left_of star.svg | awk '{print $2}' | sort -u | wc -l)" -eq 2 ]
  [ "$(left_of star.svg | awk '{print $1}' | sort -u | wc -l)" -eq 7 ]  # the eighth stands with 9
}
