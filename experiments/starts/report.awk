# starts.tsv as Markdown: where the default loses; then, by graph, how much higher than the lowest of all every start ends,
# with its iterations and seconds.
BEGIN { FS = "\t" }
FNR == 1 { next }
!($1 in seen) { seen[$1]; graph[++graphs] = $1 }
!($2 in known) { known[$2]; start[++starts] = $2 }
{
  iterations[$1, $2] = $3; seconds[$1, $2] = $4; chi2[$1, $2] = $5; converged[$1, $2] = $6
  if ($5 != "-" && (!($1 in least) || $5 + 0 < least[$1])) least[$1] = $5 + 0
}
function reaches(g, s) { return chi2[g, s] != "-" && converged[g, s] == "yes" && chi2[g, s] <= (1 + 1e-6) * least[g] + 1e-12 }
function fewest(g, i, n) {
  n = ""
  for (i = 1; i <= starts; ++i) if (reaches(g, start[i]) && (n == "" || iterations[g, start[i]] < n)) n = iterations[g, start[i]] + 0
  return n
}
function loss(g, s, most) {
  if (chi2[g, s] == "-") { printf "- %s, %s: no result.\n", g, s; return 1 }
  if (!reaches(g, s)) {
    printf "- %s, %s: ends at %.7g%s, %.7g is possible.\n", g, s, chi2[g, s], converged[g, s] == "yes" ? "" : " (not converged)", least[g]
    return 1
  }
  most = fewest(g)
  if (iterations[g, s] > most + 3) {
    printf "- %s, %s: %d iterations, %d are possible.\n", g, s, iterations[g, s], most
    return 1
  }
  return 0
}
END {
  print "# Starts\n\n## Where the default loses\n"
  for (k = 1; k <= graphs; ++k) losses += loss(graph[k], "default") + loss(graph[k], "nothing")
  if (!losses) print "Nowhere."
  print "\n## By graph\n\nThe lowest chi-square, and by start: what it ends at, by the lowest; iterations; seconds of CPU.\n"
  line = "| graph | chi-square"; rule = "|---|---:"
  for (i = 1; i <= starts; ++i) { line = line " | " start[i]; rule = rule "|---:" }
  print line " |\n" rule "|"
  for (k = 1; k <= graphs; ++k) {
    g = graph[k]
    printf "| %s | %.8g", g, least[g]
    for (i = 1; i <= starts; ++i) {
      s = start[i]
      if (chi2[g, s] == "-") { printf " | -"; continue }
      ratio = least[g] > 0 ? chi2[g, s] / least[g] : 1
      printf " | %s; %s; %.2f", reaches(g, s) ? "1" : sprintf("%.4g", ratio), iterations[g, s], seconds[g, s]
    }
    print " |"
  }
}
