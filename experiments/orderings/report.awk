# orderings.tsv as Markdown: EC as ratios to colamd's, times to amd's and colamd's, means, and where wmf loses.
BEGIN { FS = "\t"; n = split("colamd amd metis scotch wmf best", shown, " ") }
FNR == 1 { ++file; next }
file == 2 {
  if ($2 == "colamd") { mean_ec = $4; last_ec = $5; again = $6; seconds = $7; next }
  replay = replay sprintf("| %s | %d | %s | %s | %s | %s |\n", $1, $3, ratio($4, mean_ec), ratio($5, last_ec),
                          ratio($6, again), ratio($7, seconds))
  next
}
!($1 in seen) { seen[$1]; graph[++graphs] = $1; vertices[$1] = $2; edges[$1] = $3 }
{ ec[$1, $4] = $5; order[$1, $4] = $9; eliminate[$1, $4] = $10; if (!($4 in known)) { known[$4]; method[++methods] = $4 } }

function ratio(a, b) { return a == "" || b == "" || a == "-" || b == "-" || b + 0 == 0 ? "-" : sprintf("%.3f", a / b) }
function heading(first, i, line, rule) {
  line = "| " first; rule = "|---"
  for (i = 1; i <= n; ++i) { line = line " | " shown[i]; rule = rule "|---:" }
  print line " |\n" rule "|"
}
# The geometric mean of a method's ratios over the graphs where both are known.
function mean(value, m, base, g, sum, count) {
  sum = count = 0
  for (g = 1; g <= graphs; ++g) {
    if (ratio(value[graph[g], m], value[graph[g], base]) == "-") continue
    sum += log(value[graph[g], m] / value[graph[g], base]); ++count
  }
  return count == 0 ? "-" : sprintf("%.3f", exp(sum / count))
}
function section(title, text, value, base, g, i) {
  printf "\n## %s\n\n%s\n\n", title, text
  heading("graph")
  for (g = 1; g <= graphs; ++g) {
    printf "| %s", graph[g]
    for (i = 1; i <= n; ++i) printf " | %s", ratio(value[graph[g], shown[i]], value[graph[g], base])
    print " |"
  }
  printf "| **geometric mean**"
  for (i = 1; i <= n; ++i) printf " | %s", mean(value, shown[i], base)
  print " |"
}
END {
  print "# Orderings"
  section("Elimination complexity", "By that of colamd.", ec, "colamd")
  section("Time to order", "CPU time, by that of amd.", order, "amd")
  section("Time to eliminate", "Wall clock on one thread, median of five, by that of colamd.", eliminate, "colamd")
  print "\n## iSAM2 that orders by wmf\n\nBy that of the same replay by colamd (CCOLAMD), both with the newest variables last.\n"
  print "| graph | steps | mean EC_BT | last EC_BT | variables eliminated anew | time of all updates |"
  print "|---|---:|---:|---:|---:|---:|"
  printf "%s", replay
  print "\n## Where wmf loses\n"
  losses = 0
  for (g = 1; g <= graphs; ++g) {
    for (i = 1; i <= methods; ++i) {
      m = method[i]
      if (m == "best" || ec[graph[g], "wmf"] <= ec[graph[g], m]) continue
      printf "- %s: EC is %.3f of that by %s.\n", graph[g], ec[graph[g], "wmf"] / ec[graph[g], m], m
      ++losses
    }
    a = eliminate[graph[g], "wmf"]; b = eliminate[graph[g], "colamd"]
    if (a != "-" && b != "-" && a > 1.02 * b) {
      printf "- %s: eliminating takes %.3f of the time by colamd, of %.3f of the EC.\n", graph[g], a / b,
             ec[graph[g], "wmf"] / ec[graph[g], "colamd"]
      ++losses
    }
  }
  if (losses == 0) print "Nowhere here."
}
