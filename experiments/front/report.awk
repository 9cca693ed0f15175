# means.tsv as Markdown: where a policy stands that no ecgreedy reaches (none of them has as little EC under wmf and as little error),
# then what ecgreedy saves beside each policy, then all by graph.
BEGIN { FS = "\t" }
NR == 1 { next }
$2 == "full" { whole[$1] = $4 }
{ row[++n] = $0; graph[n] = $1; way[n] = $2; edges[n] = $4; ec[n] = $6; value["sigma", n] = $7; value["ATE", n] = $8 }
function number(x, digits) { return x == "" || x == "-" ? "-" : sprintf("%." digits "g", x) }
function ours(i) { return way[i] ~ /ecgreedy/ }
# Of a policy that left nothing out there is nothing to say.
function is_whole(i) { return edges[i] == whole[graph[i]] }
function scored(i, what) { return ec[i] != "-" && value[what, i] != "-" && value[what, i] != "" }
# Of ecgreedy's ways the one that has least EC and no more error than i, within a hundredth.
function beside(i, what,   j, best) {
  for (j = 1; j <= n; ++j)
    if (ours(j) && graph[j] == graph[i] && scored(j, what) && value[what, j] + 0 <= 1.01 * value[what, i] && (!best || ec[j] + 0 < ec[best] + 0)) best = j
  return best
}
function compare(what, losses,   i, j, lines) {
  for (i = 1; i <= n; ++i) {
    if (ours(i) || is_whole(i) || !scored(i, what)) continue
    j = beside(i, what)
    if (!j && losses) { printf "- %s: %s (EC %s, %s %s): ecgreedy does not get there.\n", graph[i], way[i], number(ec[i], 3), what, number(value[what, i], 3); ++lines }
    if (j && losses && ec[j] > 1.001 * ec[i]) { printf "- %s: %s (EC %s, %s %s): %s takes %.2f times the EC.\n", graph[i], way[i], number(ec[i], 3), what, number(value[what, i], 3), way[j], ec[j] / ec[i]; ++lines }
    if (j && !losses && ec[j] <= ec[i] / 1.001) { printf "- %s: %s (%s %s) costs %.1f times the EC of %s.\n", graph[i], way[i], what, number(value[what, i], 3), ec[i] / ec[j], way[j]; ++lines }
  }
  if (!lines) print "- Nowhere."
}
END {
  print "# What to leave out\n\nEC is under wmf; a way's numbers are means over its seeds. ATE is over all poses, against the whole graph's optimum.\n"
  print "## Where ecgreedy loses, by ATE\n"; compare("ATE", 1)
  print "\n## Where ecgreedy loses, by sigma\n"; compare("sigma", 1)
  print "\n## What it saves, by ATE\n"; compare("ATE", 0)
  print "\n## What it saves, by sigma\n"; compare("sigma", 0)
  print "\n## By graph"
  for (i = 1; i <= n; ++i) {
    split(row[i], f, FS)
    if (f[1] != before) {
      printf "\n### %s\n\n![](%s.svg)\n\n| way | seeds | edges | EC colamd | EC wmf | sigma | ATE | ± | error | elimination s | iSAM2 s | policy s |\n", f[1], f[1]
      print "|---|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|"
      before = f[1]
    }
    printf "| %s | %s | %s | %s | %s | %s | %s | %s | %s | %s | %s | %s |\n", f[2], f[3], number(f[4], 5), number(f[5], 3), number(f[6], 3), number(f[7], 4),
           number(f[8], 3), number(f[9], 2), number(f[10], 3), number(f[11], 3), number(f[12], 3), number(f[13], 3)
  }
}
