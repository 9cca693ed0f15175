load ../common

setup() { cd "$BATS_TEST_TMPDIR"; cp "$TESTDATA/walk.g2o" .; }

# How many shapes of a colour an SVG picture has.
shapes() { grep -c "$2" "$1" || true; }
path='rgb(12%,30%,55%)' loop='rgb(85%,45%,10%)' landmark='rgb(15%,50%,25%)'

@test "a map shows path, loop closures and landmarks, and its scale" {
  sg-plot map walk.g2o >map.svg
  [ "$(shapes map.svg "$path")" -eq 3 ]  # odometry, poses, and the legend
  [ "$(shapes map.svg "$loop")" -eq 2 ]
  [ "$(shapes map.svg "$landmark")" -eq 2 ]
  # five poses a metre apart from margin to margin
  grep -o 'M [0-9.]* 3[0-9.]* L [0-9.]* 3[0-9.]*' map.svg | sed -n 1p | grep -qx 'M 576 [0-9.]* L 24 [0-9.]*'
}

@test "a map of edges alone is composed along odometry" {
  sg-plot map walk.g2o >map.svg
  grep -v -e VERTEX -e FIX walk.g2o | sg-plot map >edges.svg
  [ "$(shapes edges.svg "$path")" -eq 3 ]
  [ "$(shapes edges.svg "$landmark")" -eq 2 ]
}

@test "costs are coloured by their share, the largest darkest" {
  # 2 goes first and costs 3 * 9^2, then 1 costs 3 * 6^2, 3 costs 3 * 3^2
  printf '2\n1\n3\n' >order
  printf 'EDGE_SE2 1 2 1 0 0 1 0 0 1 0 1\nEDGE_SE2 2 3 1 0 0 1 0 0 1 0 1\n' >in.g2o
  sg-order --apply order in.g2o | sg-plot map --cost >cost.svg
  dots() { grep 'stroke-linecap:round' cost.svg; }
  [ "$(dots | wc -l)" -eq 3 ]
  dots | tail -n 1 | grep -q 'stroke:rgb(50%,0%,15%).*d="M 300 300 Z'  # dark red and on top: the costliest
  [ "$(dots | grep -c 'stroke:rgb(50%,0%,15%)')" -eq 1 ]
  [ "$(shapes cost.svg "$path")" -eq 0 ]
  # Without 1-2, eliminating 2 costs 3 * 6^2 and 1 its 3 * 3^2, of 3 * (9^2 + 6^2 + 3^2); without 2-3 the same
  grep 'stroke-width:1.2;.*stroke:rgb(50%,0%,15%)' cost.svg | grep -q 'd="M 24 300 L 300 300 M 300 300 L 576 300 '
  sg-order --apply order in.g2o | sg-plot map >map.svg
  [ "$(shapes map.svg "$path")" -eq 3 ]  # odometry, poses, and the legend
  fails 2 "sg-plot: --cost has no effect on a tree, only on a map (see sg-plot --help)" sg-plot tree --cost in.g2o
  printf 'VERTEX_SE2 1 5 5 0\nFIX 1\n' | sg-plot map --cost >/dev/null
}

@test "ellipses of one standard deviation" {
  # 276 points a metre; the ellipse of 1 is a circle of half a metre, that of 2 is 1.22 metres long, across the way:
  # 0.05 of that, or 5 times a hundredth, is within 24 points
  printf 'VERTEX_SE2 %s 0 0\n' "0 0" "1 1" "2 2" >chain.g2o
  printf 'EDGE_SE2 %s 1 0 0 4 0 0 4 0 1\n' "0 1" "1 2" >>chain.g2o
  sed 's/ 4 0 0 4 0 1$/ 40000 0 0 40000 0 10000/' chain.g2o >sure.g2o
  for graph in chain sure; do
    sg-plot map --sigma $graph.g2o | grep -o "fill:$path;fill-opacity:0.1.* d=\"M [^C]*" | grep -o 'M .*' >around
    [ "$(paste -sd';' around)" = "M 300 293.101562 ;M 576 283.097656 " ]
  done
  sg-plot map --sigma --plane xz walk.g2o >/dev/null
  fails 2 "sg-plot: --sigma has no effect on a tree, only on a map (see sg-plot --help)" sg-plot tree --sigma chain.g2o
  run -3 sg-plot map --sigma <(grep -v 'E.*1 2' chain.g2o)
  [[ $output == "sg-plot: the system is singular: the measurements leave vertex 2 undetermined"* ]]
}

@test "the pattern of R tells fill from the system" {
  # 2 goes first and joins 1 and 3
  printf '2\n1\n3\n' >order
  printf 'EDGE_SE2 1 2 1 0 0 1 0 0 1 0 1\nEDGE_SE2 2 3 1 0 0 1 0 0 1 0 1\n' >in.g2o
  sg-order --apply order in.g2o | sg-plot pattern >fill.svg
  [ "$(shapes fill.svg "$loop")" -eq 2 ]  # and the legend
  sg-plot pattern -m id in.g2o >none.svg
  [ "$(shapes none.svg "$loop")" -eq 1 ]
  [ "$(shapes none.svg "$path")" -eq 2 ]
}

# cells FILE: x, y, width and height of the cells of a tree, those of its legend aside.
cells() { sed -nE 's/^<path .*fill:rgb.* d="M ([0-9.]+) ([0-9.]+) L ([0-9.]+) [0-9.]+ L [0-9.]+ ([0-9.]+) L.*/\1 \2 \3 \4/p' "$1" |
  awk '$2 < 580 {print $1, $2, $3 - $1, $4 - $2}'; }

@test "the Bayes tree has a cell for every clique, as wide as what hangs on it costs" {
  printf 'EDGE_SE2 1 2 1 0 0 1 0 0 1 0 1\nEDGE_SE2 2 3 1 0 0 1 0 0 1 0 1\n' >in.g2o
  sg-plot tree -m id in.g2o >tree.svg  # {2 3}: 6 * 6^2, and below it {1}: 3 * 6^2
  [ "$(cells tree.svg | wc -l)" -eq 2 ]
  cells tree.svg | awk 'NR == 1 {wide = $3} NR == 2 {exit !($1 == 24 && $3 > 0.32 * wide && $3 < 0.34 * wide)}'
  cells tree.svg | awk 'NR == 1 {low = $2 + $4} NR == 2 {exit !($2 > low)}'
  # Of a large one none lies on another, and none beyond its row.
  sg-gen manhattan -n 3000 | sg-plot tree -m wmf >large.svg
  [ "$(cells large.svg | wc -l)" -gt 300 ]
  cells large.svg | sort -g -k 2,2 -k 1,1 | awk '$2 == row && $1 < end - 0.2 {bad = 1} {row = $2; end = $1 + $3} END {exit bad}'
}

@test "a map in space is seen where it is widest, or from where one says" {
  # A square that stands upright in the plane of x = 0, wider than high.
  printf 'VERTEX_SE3:QUAT %s 0 0 0 1\n' "0 0 0 0" "1 0 10 0" "2 0 10 4" "3 0 0 4" >wall.g2o
  printf 'EDGE_SE3:QUAT %s 1 0 0 0 0 0 1 1 0 0 0 0 0 1 0 0 0 0 1 0 0 0 1 0 0 1 0 1\n' "0 1" "1 2" "2 3" >>wall.g2o
  sg-plot map wall.g2o >best.svg
  cmp best.svg <(sg-plot map --plane yz wall.g2o)
  sg-plot map --view 90,0 wall.g2o | cmp - best.svg
  sg-plot map --plane xy walk.g2o | cmp - <(sg-plot map walk.g2o)
  sg-plot map --view 0,90 walk.g2o | cmp - <(sg-plot map walk.g2o)
  sg-plot map --view 30,40 --sigma wall.g2o >/dev/null
  run -2 sg-plot map --view 30 wall.g2o
  run -2 sg-plot map --view 30,40 --plane xy wall.g2o
  run -2 sg-plot tree --view 30,40 wall.g2o
}

@test "a pattern and a tree say what they show, in two lines and a legend" {
  sg-plot pattern walk.g2o >pattern.svg
  sg-plot tree walk.g2o >tree.svg
  title="walk.g2o: 5 poses, 2 landmarks, 11 edges, EC 697 (colamd)"
  [ "$(letters pattern.svg)" -gt "$((${#title} + 60))" ]
  [ "$(letters tree.svg)" -gt "$((${#title} + 60))" ]
}

@test "the pattern is framed, and the legend of costs has 40 colours, two points each" {
  printf 'EDGE_SE2 1 2 1 0 0 1 0 0 1 0 1\nEDGE_SE2 2 3 1 0 0 1 0 0 1 0 1\n' >in.g2o
  sg-plot pattern -m id in.g2o >pattern.svg
  grep -q 'd="M 24 24 L 576 24 L 576 576 L 24 576 Z' pattern.svg
  sg-plot map --cost in.g2o | awk '/ 588 L .* 596 / {split($0, d, "d=\""); split(d[2], x); w = x[5] - x[2]; n += w > 1.9 && w < 2.1} END {exit n != 40}'
}

@test "svg, png and pdf, by the name of the file, the same each time" {
  for what in map pattern tree; do
    for kind in svg png pdf; do
      sg-plot $what walk.g2o -o a.$kind
      sg-plot $what walk.g2o -o b.$kind
      cmp a.$kind b.$kind
    done
    head -c 5 a.svg | grep -q '<?xml'
    head -c 4 a.png | grep -q PNG
    head -c 4 a.pdf | grep -q '%PDF'
  done
  sg-plot map walk.g2o --width 200 --height 100 -o small.svg
  grep -q 'viewBox="0 0 200 100"' small.svg
}

@test "a graph of one vertex, and one whose vertices are all fixed" {
  printf 'VERTEX_SE2 1 5 5 0\n' >one.g2o
  printf 'VERTEX_SE2 1 5 5 0\nFIX 1\n' >fixed.g2o
  for what in map pattern tree; do
    sg-plot $what one.g2o >/dev/null
    sg-plot $what fixed.g2o >/dev/null
  done
}

@test "what it cannot draw" {
  printf 'VERTEX_X 1 5 5 0\n' >in.g2o
  fails 1 "sg-plot: in.g2o:1: VERTEX_X has no place on a map" sg-plot map --vertex VERTEX_X:3:pose in.g2o
  fails 2 "sg-plot: a picture's name ends in .svg, .png or .pdf; not so 'a.jpg' (see sg-plot --help)" \
    sg-plot map walk.g2o -o a.jpg
  fails 2 "sg-plot: WHAT: hat: there are map, pattern, tree, curves (see sg-plot --help)" sg-plot hat walk.g2o
  fails 2 "sg-plot: WHAT is required (see sg-plot --help)" sg-plot
}

# letters FILE: how many glyphs it shows.
letters() { grep -c '<use xlink:href="#glyph' "$1" || true; }

@test "a map says what it is, where it begins and ends, and up to 50 ids" {
  sg-gen manhattan -n 60 -o m.g2o
  sg-cut --poses 50 --no-trace-comment m.g2o >n.g2o
  sg-cut --poses 51 --no-trace-comment m.g2o >o.g2o
  sg-plot map n.g2o -o n.svg
  sg-plot map o.g2o -o o.svg
  [ "$(($(letters n.svg) - $(letters o.svg)))" -gt 80 ]  # 0 to 49: 90 digits
  [ "$(grep -c 'stroke-width:1.2' o.svg)" = 2 ]  # a ring and a square
  grep 'stroke-width:1.2' o.svg | tail -n 1 | grep -q ' d="M [0-9.]* [0-9.]* L [^C]*Z'
  # A longer name, a longer title, and not beyond the page.
  cp o.g2o "$(printf 'long%.0s' $(seq 40)).g2o"
  sg-plot map long*.g2o -o long.svg
  [ "$(letters long.svg)" -gt "$(($(letters o.svg) + 150))" ]
  [ "$(grep -o '<use xlink:href="#glyph[^"]*" x="[0-9.]*' long.svg | sed 's/.*x="//' | sort -g | tail -n 1 | cut -d . -f 1)" -lt 600 ]
  for what in pattern tree; do
    sg-plot $what o.g2o -o $what.svg
    [ "$(letters $what.svg)" -gt 30 ]
  done
}

@test "a map of some edges only" {
  sg-plot map --only odometry walk.g2o >some.svg
  [ "$(shapes some.svg "$loop")" -eq 0 ]
  [ "$(shapes some.svg "$path")" -eq 3 ]
  sg-plot map --only loops,observations walk.g2o >some.svg
  [ "$(shapes some.svg "$loop")" -eq 2 ]
  [ "$(shapes some.svg "$path")" -eq 1 ]  # poses
  sg-plot map --only odometry,loops,observations walk.g2o | cmp - <(sg-plot map walk.g2o)
  fails 2 "sg-plot: --only rods: there are odometry, loops, observations (see sg-plot --help)" sg-plot map --only rods walk.g2o
  fails 2 "sg-plot: --only has no effect with --cost, which colours all edges (see sg-plot --help)" sg-plot map --cost --only loops walk.g2o
}

@test "a large graph is thinned: its picture stays small, and reaches as far" {
  sg-gen manhattan -n 60000 -o m.g2o
  sg-plot map m.g2o -o m.svg
  [ "$(stat -c %s m.svg)" -lt 5000000 ]
  [ "$(grep -oE ' L ' m.svg | wc -l)" -lt 110000 ]
  [ "$(grep -oE ' L ' m.svg | wc -l)" -gt 20000 ]
  # It is not kept while it is read, unless it is packed: to the same end.
  gzip -c m.g2o | sg-plot map | cmp - <(sg-plot map <m.g2o)
}

# lines COLOUR FILE: the lines of a colour, "M x y L x y" each.
lines() { grep "stroke:$1" "$2" | grep -oE 'M [0-9.]+ [0-9.]+ L [0-9.]+ [0-9.]+'; }
overlaid='rgb(49%,18%,56%)' error='rgb(91%,16%,54%)'

@test "a trajectory over a map, moved onto it, with an error a pose" {
  printf 'VERTEX_SE2 %s 0\n' "0 0 0" "1 1 0" "2 1 1" >map.g2o
  printf 'EDGE_SE2 %s 1 0 0 1 0 0 1 0 1\n' "0 1" "1 2" >>map.g2o
  # The same turned by a right angle and shifted; in another order, with a pose more.
  printf 'VERTEX_SE2 %s 1.5707963267948966\n' "9 5 9" "2 4 6" "1 5 6" "0 5 5" >turned.g2o
  sg-plot map --overlay turned.g2o map.g2o >turned.svg
  lines "$error" turned.svg | awk '{dx = $2 - $5; dy = $3 - $6} dx * dx + dy * dy > 1e-4 {bad = 1} END {exit bad || NR != 3}'
  [ "$(lines "$overlaid" turned.svg | wc -l)" = 3 ]  # 0 1 2 9
  # One pose is off by 1, and the motion spreads it: the whiskers' root mean square is sg-score's ATE.
  printf 'VERTEX_SE2 %s 0\n' "0 0 0" "1 1 0" "2 2 1" >off.g2o
  sg-plot map --overlay off.g2o map.g2o >off.svg
  ate=$(sg-score -f ate_rmse --no-header --reference off.g2o map.g2o)
  bar=$(grep -o 'stroke-width:1.5;.* d="[^"]*"' off.svg | grep -oE ' d=".*"' | grep -oE '[0-9.]+' | awk '{n[NR] = $1} END {print n[3] - n[1]}')
  drawn=$(lines "$error" off.svg | awk '{sum += ($2 - $5) ^ 2 + ($3 - $6) ^ 2} END {print sqrt(sum / NR)}')
  near "$(awk -v drawn="$drawn" -v bar="$bar" 'BEGIN {print drawn / bar * 0.2}')" "$ate" 1e-4  # the bar has 20 cm
  # Of another format; poses are numbered as they come.
  printf '%s 0 0 0 0 0 1\n' "0 0" "1 1" "2 2" >ref.tum
  sg-plot map --overlay ref.tum map.g2o >/dev/null
  printf 'VERTEX_SE2 7 0 0 0\n' >other.g2o
  fails 1 "sg-plot: other.g2o: no pose in common with map.g2o (poses are matched by id)" sg-plot map --overlay other.g2o map.g2o
  fails 2 "sg-plot: --overlay has no effect with --cost, which colours all edges (see sg-plot --help)" sg-plot map --cost --overlay off.g2o map.g2o
  fails 2 "sg-plot: --overlay has no effect on a tree, only on a map (see sg-plot --help)" sg-plot tree --overlay off.g2o map.g2o
}

@test "the far side of a map in space is paler" {
  colours() { grep -o 'stroke-width:0.8;.*stroke:rgb([^)]*)' "$1" | sed 's/.*stroke:/stroke:/' | sort -u | wc -l; }
  printf 'VERTEX_SE3:QUAT %s 0 0 0 1\n' "0 0 0 0" "1 4 0 0" "2 4 0 4" "3 0 0 4" "4 0 -4 4" "5 4 -4 4" >box.g2o
  printf 'EDGE_SE3:QUAT %s 1 0 0 0 0 0 1 1 0 0 0 0 0 1 0 0 0 0 1 0 0 0 1 0 0 1 0 1\n' "0 1" "1 2" "2 3" "3 4" "4 5" >>box.g2o
  sg-plot map --view 0,0 box.g2o >front.svg  # from the south: 4 and 5 are near
  [ "$(colours front.svg)" = 3 ]  # between the far ones, from one to a near one, between those
  # The last one drawn is the nearest, in full colour; the first the farthest, paler.
  grep 'stroke-width:0.8;' front.svg | tail -n 1 | grep -q "stroke:$path"
  grep 'stroke-width:0.8;' front.svg | sed -n 1p | grep -q 'stroke:rgb(78%,'
  sg-plot map walk.g2o >flat.svg
  [ "$(colours flat.svg)" = 1 ]
}

@test "a hint where estimates look unsolved" {
  sg-gen manhattan -n 400 -o odometry.g2o
  mkdir solved
  sg-solve -q odometry.g2o -o solved/odometry.g2o
  for kind in "" --cost --sigma; do
    before=$(sg-plot map $kind odometry.g2o | letters -)
    after=$(sg-plot map $kind solved/odometry.g2o | letters -)
    [ "$((before - after))" -gt 60 ]
  done
  # False closures that are fewer than half do not make a solved graph look unsolved.
  sg-gen manhattan -n 400 --outliers 0.2 | sg-solve -q --gnc -o solved/odometry.g2o
  [ "$((before - $(sg-plot map solved/odometry.g2o | letters -)))" -gt 40 ]
}

@test "numbers along the edges of a map, at round lengths" {
  printf 'VERTEX_SE2 0 0 0 0\nVERTEX_SE2 1 10 5 0\n' >line.g2o
  sg-plot map line.g2o >line.svg
  # 10 m are 552 points; below, from 24 on, a number every 2 m; at the left, around the middle at 300
  for at in 24 134.4 244.8 355.2 465.6 576; do
    grep -oE 'M [0-9.]+ 576 L [0-9.]+ 579' line.svg | awk -v at="$at" '($2 - at) ^ 2 < 1e-3 {found = 1} END {exit !found}'
  done
  grep -oE 'M 24 [0-9.]+ L 21 [0-9.]+' line.svg | awk '($3 - 438) ^ 2 < 1e-3 {found = 1} END {exit !found}'  # y of 0
}
