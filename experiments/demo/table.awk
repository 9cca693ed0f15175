# Rows graph, policy, r, vertices, edges, ec; the row `full` of a graph comes first, and has a prediction or an empty field
# behind them.
BEGIN {
  printf "%-22s %-6s %2s %9s %9s %16s %8s %10s\n", "graph", "policy", "r", "vertices", "edges", "ec", "of full", "predicted"
}
{
  if ($2 == "full") { full = $6; near = $7 != "" }
  predicted = ""
  if ($2 == "kf" && near) predicted = sprintf("%.4f", 1 / $3 ^ 3)
  if ($2 == "dec" && near) predicted = sprintf("%.4f", 9 / $3 ^ 2 < 1 ? 9 / $3 ^ 2 : 1)
  printf "%-22s %-6s %2d %9d %9d %16s %8.4f %10s\n", $1, $2, $3, $4, $5, $6, $6 / full, predicted
}
