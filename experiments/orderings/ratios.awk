# A row a graph for the picture: EC by colamd's, ordering time by amd's, elimination time by colamd's; NaN where unknown.
BEGIN { FS = OFS = "\t"; n = split("colamd amd metis scotch wmf best", shown, " ") }
FNR == 1 { ++file; next }
file == 2 { eliminate[$1, $2] = $6; next }
!($1 in seen) { seen[$1]; graph[++graphs] = $1 }
{ ec[$1, $4] = $5; order[$1, $4] = $9 }
function ratio(a, b) { return a == "-" || b == "-" || b + 0 == 0 ? "NaN" : a / b }
END {
  printf "graph"
  for (i = 1; i <= n; ++i) printf "\tec_%s\torder_%s\teliminate_%s", shown[i], shown[i], shown[i]
  print ""
  for (g = 1; g <= graphs; ++g) {
    name = graph[g]
    printf "%s", name
    for (i = 1; i <= n; ++i) {
      m = shown[i]
      printf "\t%s\t%s\t%s", ratio(ec[name, m], ec[name, "colamd"]), ratio(order[name, m], order[name, "amd"]),
             ratio(eliminate[name, m], eliminate[name, "colamd"])
    }
    print ""
  }
}
