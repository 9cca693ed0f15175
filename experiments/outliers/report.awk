# outliers.tsv as Markdown: where we lose, then precision, recall and ATE of --gnc by world and share, then kernels.
BEGIN { FS = "\t"; least = 0.99; most = 1.2 }
NR == 1 { next }
{ ratio = $9 == "-" || $10 + 0 == 0 ? "-" : $9 / $10 }
$4 == "gnc" {
  key = $1 FS $2
  if (!(key in count)) { keys[++n] = key; precision[key] = recall[key] = 2; seconds[key] = worst[key] = 0 }
  ++count[key]; edges[key] = $5; wrong[key] = $6
  if ($7 == "-" || ratio == "-") { ++failed[key]; next }
  if ($7 < precision[key]) precision[key] = $7
  if ($8 < recall[key]) recall[key] = $8
  if (ratio > worst[key]) worst[key] = ratio
  if ($11 > seconds[key]) seconds[key] = $11
  next
}
{ if (!($4 in seen)) { seen[$4]; ways[++k] = $4 } if (!($1 in met)) { met[$1]; worlds[++w] = $1 } share = $2; of[$1, $4] = ratio }
END {
  print "# Outliers\n\nFalse closures and observations of `sg-gen --outliers`, found by `sg-solve --gnc`.\n\n## Where we lose\n"
  for (i = 1; i <= n; ++i) {
    split(keys[i], part, FS)
    name = part[1] ", " part[2] * 100 " % false"
    if (failed[keys[i]]) { print "- " name ": " failed[keys[i]] " of " count[keys[i]] " seeds give nothing."; ++losses }
    if (precision[keys[i]] < least) { printf "- %s: precision is %.4f.\n", name, precision[keys[i]]; ++losses }
    if (recall[keys[i]] < least) { printf "- %s: recall is %.4f.\n", name, recall[keys[i]]; ++losses }
    if (worst[keys[i]] > most) { printf "- %s: ATE is %.3f times that without them.\n", name, worst[keys[i]]; ++losses }
    if (seconds[keys[i]] > 60) { printf "- %s: it takes %.0f s.\n", name, seconds[keys[i]]; ++losses }
  }
  if (!losses) print "Nowhere here."
  print "\n## Graduated non-convexity\n\nThe worst of the seeds. ATE: as a ratio to that of the same graph without its false edges.\n"
  print "| world | false | edges | false edges | precision | recall | ATE | seconds |\n|---|---:|---:|---:|---:|---:|---:|---:|"
  for (i = 1; i <= n; ++i) {
    split(keys[i], part, FS)
    printf "| %s | %d %% | %d | %d | %.4f | %.4f | %.3f | %.1f |\n", part[1], part[2] * 100, edges[keys[i]], wrong[keys[i]],
           precision[keys[i]], recall[keys[i]], worst[keys[i]], seconds[keys[i]]
  }
  printf "\n## Kernels\n\nATE as a ratio, %d %% false, at most 30 iterations.\n\n| world |", share * 100
  for (j = 1; j <= k; ++j) printf " %s |", ways[j]
  printf "\n|---|"
  for (j = 1; j <= k; ++j) printf "---:|"
  print ""
  for (i = 1; i <= w; ++i) {
    printf "| %s |", worlds[i]
    for (j = 1; j <= k; ++j) printf " %s |", of[worlds[i], ways[j]] == "-" ? "-" : sprintf("%.3g", of[worlds[i], ways[j]])
    print ""
  }
}
