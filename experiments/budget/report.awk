# budget.tsv as Markdown: where we lose, then every world and budget; errors as means over the seeds, ratios as geometric means.
BEGIN { FS = "\t"; ways = split("window measurements lag kf dec", way, " ") }
NR == 1 { next }
$5 == "plain" { plain[$1] += $9; plain_final[$1] += $10; ++seeds[$1]; next }
{
  key = $1 FS $3
  if (!(key in seen)) { seen[key]; keys[++n] = key }
  if ($9 == "-") { ++failed[key, $5]; next }
  ++count[key, $5]; violations[key, $5] += $8; online[key, $5] += $9; final[key, $5] += $10; of_online[key, $2, $5] = $9
  of_final[key, $2, $5] = $10
  if ($14 / $4 > steps[key, $5]) steps[key, $5] = $14 / $4
  if (!($2 in met)) { met[$2]; seed[++s] = $2 }
}
function ratio(key, a, b, of,   i, sum, k) {  # geometric mean over the seeds that have both
  for (i = 1; i <= s; ++i) {
    if (!((key, seed[i], a) in of) || !((key, seed[i], b) in of)) continue
    sum += log(of[key, seed[i], a] / of[key, seed[i], b]); ++k
  }
  return k ? exp(sum / k) : 0
}
function least(key, a, list, of,   i, k, part, best, r) {  # ratio of a to the best of the list, by seed
  for (i = 1; i <= s; ++i) {
    best = 0
    for (k = split(list, part, " "); k > 0; --k)
      if ((key, seed[i], part[k]) in of && (!best || of[key, seed[i], part[k]] < best)) best = of[key, seed[i], part[k]]
    if (!best || !((key, seed[i], a) in of)) continue
    r += log(of[key, seed[i], a] / best); ++kk[key, a]
  }
  return kk[key, a] ? exp(r / kk[key, a]) : 0
}
function cell(x) { return x ? sprintf("%.3g", x) : "-" }
END {
  print "# A budget of elimination complexity\n\nBudgets are shares of the largest `ec_bt` of plain iSAM2. lag, kf and dec: the best with hindsight that never breaks"
  print "the budget.\n\n## Where we lose\n"
  for (i = 1; i <= n; ++i) {
    split(keys[i], part, FS); name = part[1] " at " part[2]
    for (k = 1; k <= 2; ++k) {
      if (violations[keys[i], way[k]]) { print "- " name ": `" way[k] "` breaks the budget at " violations[keys[i], way[k]] " steps in all."; ++losses }
      if (failed[keys[i], way[k]]) { print "- " name ": `" way[k] "` ends early for " failed[keys[i], way[k]] " seeds."; ++losses }
    }
    r = ratio(keys[i], "window", "lag", of_online); if (r > 1) { printf "- %s: the online error of `window` is %.2f times that of the best lag.\n", name, r; ++losses }
    delete kk; r = least(keys[i], "measurements", "lag kf dec", of_final)
    if (r > 1 / 1.5) { printf "- %s: the final error of `measurements` is %.2f times the best of lag, kf and dec.\n", name, r; ++losses }
    if (r) { all += log(r); ++cases }
    delete kk; r = least(keys[i], "window", "lag kf dec", of_final); if (r) { all_window += log(r); ++window_cases }
    r = ratio(keys[i], "window", "lag", of_online); if (r) { all_lag += log(r); ++lag_cases }
  }
  if (!losses) print "Nowhere here."
  printf "\n## In the geometric mean\n\n- online error of `window`, to the best fixed lag: %.2f\n- final error of `window`, to the best of lag, kf and dec: %.2f\n", exp(all_lag / lag_cases), exp(all_window / window_cases)
  printf "- final error of `measurements`, to the best of lag, kf and dec: %.2f\n", exp(all / cases)
  split("online final", table, " ")
  for (t = 1; t <= 2; ++t) {
    print "\n## " (t == 1 ? "Online error" : "Final error") ", metres\n\n| world | budget | plain | window | measurements | lag | kf | dec |\n|---|---:|---:|---:|---:|---:|---:|---:|"
    for (i = 1; i <= n; ++i) {
      split(keys[i], part, FS)
      line = sprintf("| %s | %s | %s |", part[1], part[2], cell((t == 1 ? plain[part[1]] : plain_final[part[1]]) / seeds[part[1]]))
      for (k = 1; k <= ways; ++k) {
        c = count[keys[i], way[k]]
        line = line " " (c ? cell((t == 1 ? online[keys[i], way[k]] : final[keys[i], way[k]]) / c) : "-") " |"
      }
      print line
    }
  }
  print "\n## Largest ec_step, as a multiple of the budget\n\n| world | budget | window | measurements |\n|---|---:|---:|---:|"
  for (i = 1; i <= n; ++i) {
    split(keys[i], part, FS)
    printf "| %s | %s | %s | %s |\n", part[1], part[2], cell(steps[keys[i], "window"]), cell(steps[keys[i], "measurements"])
  }
}
