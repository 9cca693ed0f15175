# front.tsv over its seeds: graph, way, seeds, and of every number its mean; of ate its spread, too (standard deviation).
BEGIN { FS = OFS = "\t"; print "graph", "way", "seeds", "edges", "ec_colamd", "ec_wmf", "sigma", "ate", "ate_spread", "error", "eliminate_s", "isam2_s", "seconds" }
NR == 1 { next }
{
  key = $1 FS $3
  if (!(key in rows)) order[++n] = key
  ++rows[key]
  if ($7 == "-") next
  ++count[key]
  for (k = 4; k <= 13; ++k) {
    if ($k == "-" || $k == "") { missing[key, k] = 1; continue }
    sum[key, k] += $k; square[key, k] += $k * $k
  }
}
function mean(key, k) { return count[key] && !((key, k) in missing) ? sum[key, k] / count[key] : "-" }
function spread(key, k,   m) {
  if (count[key] < 2 || (key, k) in missing) return "-"
  m = mean(key, k)
  return sqrt(max(0, square[key, k] / count[key] - m * m) * count[key] / (count[key] - 1))
}
function max(a, b) { return a > b ? a : b }
END {
  for (i = 1; i <= n; ++i) {
    key = order[i]
    print key, count[key] + 0, mean(key, 5), mean(key, 6), mean(key, 7), mean(key, 8), mean(key, 9), spread(key, 9), mean(key, 10),
      mean(key, 11), mean(key, 12), mean(key, 13)
  }
}
