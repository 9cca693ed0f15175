# times.tsv: how well seconds are foretold, as Markdown. Where we are off most comes first.
BEGIN { FS = "\t" }
FNR == 1 || $5 == "-" || $6 == "-" { next }
{
  off = log($5 / $6); ++count
  sum += log($6); squares += log($6) ^ 2; residual += off * off
  away = off < 0 ? -off : off
  miss[count] = away; line[count] = sprintf("| %s | %s | %.4g | %.4g | %.2f |", $1, $2, $6, $5, $5 / $6)
  if (away > worst[$1]) { worst[$1] = away; which[$1] = $2; ratio[$1] = $5 / $6 }
  if (!($1 in seen)) { seen[$1]; graph[++graphs] = $1 }
  within += away < log(1.25)
}
END {
  print "\n## Seconds foretold\n"
  if (count == 0) { print "No order was both foretold and timed: `sg-solve --calibrate` comes first."; exit }
  print "What `sg-ec -f seconds` says after `sg-solve --calibrate`, and what one elimination took on one thread.\n"
  print "The five worst:\n"
  print "| graph | ordering | took, s | foretold, s | ratio |\n|---|---|---:|---:|---:|"
  for (k = 1; k <= 5 && k <= count; ++k) {
    top = 0
    for (i = 1; i <= count; ++i) if (!(i in shown) && (top == 0 || miss[i] > miss[top])) top = i
    shown[top]; print line[top]
  }
  printf "\nOver %d orders of %d graphs, R^2 of log seconds %.4f; %d %% within a quarter; the worst is off by %.2f times.\n",
         count, graphs, 1 - residual / (squares - sum * sum / count), 100 * within / count, exp(most())
  print "\n| graph | worst ordering | foretold by took |\n|---|---|---:|"
  for (g = 1; g <= graphs; ++g) printf "| %s | %s | %.2f |\n", graph[g], which[graph[g]], ratio[graph[g]]
}
function most(  k, m) { for (k in miss) if (miss[k] > m) m = miss[k]; return m }
