# marginalize.tsv as Markdown: which way is dominated (another of the same graph and rate has less EC under wmf and loses no more
# information), then all ways by graph.
BEGIN { FS = "\t" }
NR == 1 { next }
{ row[++n] = $0; graph[n] = $1; rate[n] = $2; way[n] = $3; ec[n] = $7; kld[n] = $8 }
function number(x, digits) { return x == "" || x == "-" ? "-" : sprintf("%." digits "g", x) }
function beats(a, b) {
  return graph[a] == graph[b] && rate[a] == rate[b] && kld[a] != "" && kld[a] != "-" && kld[b] != "" && kld[b] != "-" &&
         ec[a] + 0 < 0.99 * ec[b] && kld[a] + 0 <= 1.01 * kld[b]
}
END {
  print "# Poses taken out\n\n## Where we lose\n"
  for (i = 1; i <= n; ++i) {
    if (ec[i] == "-") { printf "- %s, rate %s, %s: no result.\n", graph[i], rate[i], way[i]; ++losses; continue }
    for (j = 1; j <= n; ++j) {
      if (!beats(j, i)) continue
      printf "- %s, rate %s: %s costs %.2f times the EC of %s, which loses no more.\n", graph[i], rate[i], way[i], ec[i] / ec[j], way[j]
      ++losses
      break
    }
  }
  if (!losses) print "Nowhere: of no graph and rate has one way both less EC and less loss than another."
  print "\n## By graph\n"
  for (i = 1; i <= n; ++i) {
    split(row[i], f, FS)
    if (f[1] != before) {
      printf "\n### %s\n\n| rate | way | vertices | edges | EC colamd | EC wmf | divergence | overconfidence | ATE | seconds |\n", f[1]
      print "|---:|---|---:|---:|---:|---:|---:|---:|---:|---:|"
      before = f[1]
    }
    printf "| %s | %s | %s | %s | %s | %s | %s | %s | %s | %s |\n", f[2], f[3], f[4], f[5], number(f[6], 3), number(f[7], 3),
           number(f[8], 3), number(f[9], 3), number(f[10], 3), number(f[11], 3)
  }
}
