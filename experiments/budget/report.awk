# budget.tsv as Markdown: where we lose, then every world and share; errors as means over the seeds, ratios as geometric means.
# With hindsight: of the lags that never break the budget the longest; of the rates that do not, the one that ends at the least error.
BEGIN { FS = "\t"; spends = split("window measurements keyframes mixed", spend, " "); split("lag kf dec", fixed, " ") }
NR == 1 || $5 == "-" { if (NR > 1) ++failed[$1, $3]; next }
{
  split($3, part, /[@+]/)
  if (!($1 in known)) { known[$1]; world[++worlds] = $1 }
  if (!(($1, $2) in cell)) { cell[$1, $2]; seeds[$1] = seeds[$1] " " $2 }
  key = $1 SUBSEP $2 SUBSEP $3
  most[key] = $5
  if ($8 == "-") { over[key] }
  else { broken[key] = $6; online[key] = $7; final[key] = $8; seconds[key] = $9; step[key] = $10; p95[key] = $11; p99[key] = $12; chosen[key] = $15 }
  if (part[1] == "plain") whole[$1, $2] = $5
  else if (part[1] == "renew") renewed[part[2]]
  if (part[1] == "lag" || part[1] == "kf" || part[1] == "dec") { if (!((part[1], part[2]) in had)) { had[part[1], part[2]]; choices[part[1]] = choices[part[1]] " " part[2] } }
  else if (part[1] != "plain" && part[1] != "renew" && !(part[2] in share)) { share[part[2]]; shares[++n_shares] = part[2] }
  if (part[1] != "plain") budget[$1, $2, part[2]] = $4
}
# The cell of a fixed way with hindsight; "" where none keeps the budget.
function best(w, s, way, x,   k, i, c, key, found, limit) {
  limit = x * whole[w, s]
  for (i = split(choices[way], c, " "); i > 0; --i) {
    key = w SUBSEP s SUBSEP way "@" c[i]
    if (!(key in most) || key in over || most[key] + 0 > limit) continue
    if (found == "" || (way == "lag" ? c[i] + 0 > longest : final[key] + 0 < final[found] + 0)) { found = key; longest = c[i] + 0 }
  }
  return found
}
function cell_of(w, s, way, x) { if (way == "plain") return w SUBSEP s SUBSEP "plain"; return way == "lag" || way == "kf" || way == "dec" ? best(w, s, way, x) : (w SUBSEP s SUBSEP way "@" x) }
# Geometric mean over the seeds of a way's `of` by the best of others (a list).
function ratio(w, x, way, others, of,   list, s, i, j, o, k, key, other, least, sum, n) {
  for (i = split(seeds[w], list, " "); i > 0; --i) {
    s = list[i]; key = cell_of(w, s, way, x)
    if (!(key in of) || of[key] + 0 <= 0) continue
    least = 0
    for (j = split(others, o, " "); j > 0; --j) {
      other = cell_of(w, s, o[j], x)
      if (other != "" && other in of && (!least || of[other] + 0 < least)) least = of[other] + 0
    }
    if (!least) continue
    sum += log(of[key] / least); ++n
  }
  return n ? exp(sum / n) : 0
}
function mean(w, x, way, of,   list, i, key, sum, n) {
  for (i = split(seeds[w], list, " "); i > 0; --i) { key = way == "plain" ? w SUBSEP list[i] SUBSEP "plain" : cell_of(w, list[i], way, x); if (key != "" && key in of) { sum += of[key]; ++n } }
  return n ? sprintf("%.3g", sum / n) : "-"
}
function largest(w, x, way, of,   list, i, key, top) {
  for (i = split(seeds[w], list, " "); i > 0; --i) { key = cell_of(w, list[i], way, x); if (key in of && of[key] / budget[w, list[i], x] > top) top = of[key] / budget[w, list[i], x] }
  return top ? sprintf("%.2g", top) : "-"
}
function total(w, x, way, of,   list, i, key, sum) {
  for (i = split(seeds[w], list, " "); i > 0; --i) { key = cell_of(w, list[i], way, x); if (key in of) sum += of[key] }
  return sum + 0
}
function lose(text) { print "- " text; ++losses }
function told(of, text,   i, j, line, k) {
  print "\n## " text "\n\n| world | budget | plain | window | measurements | keyframes | mixed | lag | kf | dec |\n|---|---:|---:|---:|---:|---:|---:|---:|---:|---:|"
  for (i = 1; i <= worlds; ++i) for (j = 1; j <= n_shares; ++j) {
    line = "| " world[i] " | " shares[j] " | " mean(world[i], shares[j], "plain", of) " |"
    for (k = 1; k <= spends; ++k) line = line " " mean(world[i], shares[j], spend[k], of) " |"
    for (k = 1; k <= 3; ++k) line = line " " mean(world[i], shares[j], fixed[k], of) " |"
    print line
  }
}
# Of the geometric mean of a ratio over all cells that have it: 1 / it, as text; and over how many.
function gain_of(way, others, of,   i, j, r, sum, n) {
  for (i = 1; i <= worlds; ++i) for (j = 1; j <= n_shares; ++j) if (r = ratio(world[i], shares[j], way, others, of)) { sum -= log(r); ++n }
  return n ? sprintf("%.2f times (%d cells)", exp(sum / n), n) : "- (0 cells)"
}
function verdicts(   i, j, k, r, b, runs, bad, cells, worse, changing, key, top, sum, n) {
  print "\n## Must reach\n"
  for (k = 1; k <= spends; ++k) {
    b = runs = bad = 0
    for (key in broken) { split(key, part, SUBSEP); if (index(part[3], spend[k] "@") == 1) { ++runs; b += broken[key]; bad += broken[key] > 0 } }
    printf "- No violation, `%s`: %s; %d steps in %d of %d runs.\n", spend[k], b ? "**does not hold**" : "holds", b, bad, runs
  }
  for (i = 1; i <= worlds; ++i) for (j = 1; j <= n_shares; ++j) if (r = ratio(world[i], shares[j], "window", "lag", online)) {
    ++cells; worse += r > 1.005
    by_chance += r > 1.005 && ratio(world[i], shares[j], "plain", "lag", online) > 1.005
    if (world[i] == "changing") { changing += log(r); ++n }
  }
  printf "- `window` no worse online than the longest lag that keeps the budget, chosen with hindsight: %s; worse in %d of %d cells", worse ? "**does not hold**" : "holds", worse, cells
  if (by_chance) printf " (in %d of them plain iSAM2, which forgets nothing, is worse than that lag, too)", by_chance
  printf "%s.\n", n ? sprintf("; %.2f times its error where the world changes", exp(changing / n)) : ""
  print "- 1.5 times less final error than the best of lag, kf and dec with hindsight, in the geometric mean: `measurements` " gain_of("measurements", "lag kf dec", final) ", `mixed` " gain_of("mixed", "lag kf dec", final) ", `window` " gain_of("window", "lag kf dec", final) ", `keyframes` " gain_of("keyframes", "lag kf dec", final) ". Plain iSAM2, which has no budget to keep, would have " gain_of("plain", "lag kf dec", final) ": there is no more to be had than about that."
  for (k = 1; k <= spends; ++k) {
    top = sum = n = bad = 0
    for (key in chosen) { split(key, part, SUBSEP); if (index(part[3], spend[k] "@") == 1 && chosen[key] != "-" && chosen[key] != "") { sum += chosen[key]; ++n; bad += chosen[key] >= 0.2; if (chosen[key] > top) top = chosen[key] } }
    if (n) printf "- Pricing and choosing below a fifth of the time, `%s`: %s; %.2f on the mean, %.2f at most, a fifth or more in %d of %d runs.\n", spend[k], bad ? "**does not hold**" : "holds", sum / n, top, bad, n
  }
}
END {
  for (i = 2; i <= n_shares; ++i) for (j = i; j > 1 && shares[j] + 0 < shares[j - 1] + 0; --j) { t = shares[j]; shares[j] = shares[j - 1]; shares[j - 1] = t }
  print "# A budget of elimination complexity\n\nBudgets are shares of the largest `ec_bt` of plain iSAM2 on the same graph. lag, kf and dec are chosen with hindsight among"
  print "those that never break the budget: the longest lag, the rate that ends at the least error; their errors are over the poses that"
  print "they keep. Online is the mean error of the newest pose at its step, final the ATE of all poses at the end. Worlds, seeds:"
  for (i = 1; i <= worlds; ++i) print "- " world[i] ":" seeds[world[i]]
  verdicts()
  print "\n## Where we lose\n"
  for (i = 1; i <= worlds; ++i) for (j = 1; j <= n_shares; ++j) {
    name = world[i] " at " shares[j]
    for (k = 1; k <= spends; ++k) {
      if (b = total(world[i], shares[j], spend[k], broken)) lose(name ": `" spend[k] "` breaks the budget at " b " steps in all.")
      if (failed[world[i], spend[k] "@" shares[j]]) lose(name ": `" spend[k] "` gives nothing for " failed[world[i], spend[k] "@" shares[j]] " seeds.")
    }
    if ((r = ratio(world[i], shares[j], "window", "lag", online)) > 1.005) lose(sprintf("%s: the online error of `window` is %.2f times that of the best lag.", name, r))
    if ((r = ratio(world[i], shares[j], "mixed", "lag kf dec", final)) > 1 / 1.5) lose(sprintf("%s: the final error of `mixed` is %.2f times the best of lag, kf and dec.", name, r))
    if ((r = ratio(world[i], shares[j], "mixed", "window", final)) > 1.05) lose(sprintf("%s: the final error of `mixed` is %.2f times that of `window`.", name, r))
  }
  if (!losses) print "Nowhere here."
  print "\n## In the geometric mean, over worlds, budgets and seeds\n\n| | online, to the best lag | final, to the best of lag, kf, dec |\n|---|---:|---:|"
  for (k = 1; k <= spends; ++k) {
    a = b = na = nb = 0
    for (i = 1; i <= worlds; ++i) for (j = 1; j <= n_shares; ++j) {
      if (r = ratio(world[i], shares[j], spend[k], "lag", online)) { a += log(r); ++na }
      if (r = ratio(world[i], shares[j], spend[k], "lag kf dec", final)) { b += log(r); ++nb }
    }
    if (na) printf "| %s | %.2f | %.2f |\n", spend[k], exp(a / na), nb ? exp(b / nb) : 0
  }
  told(online, "Online error, metres")
  told(final, "Final error, metres")
  told(p95, "p95 of ec_step")
  told(p99, "p99 of ec_step")
  print "\n## Largest ec_step, as a multiple of the budget\n\n| world | budget | window | measurements | keyframes | mixed |\n|---|---:|---:|---:|---:|---:|"
  for (i = 1; i <= worlds; ++i) for (j = 1; j <= n_shares; ++j) {
    line = "| " world[i] " | " shares[j] " |"
    for (k = 1; k <= spends; ++k) line = line " " largest(world[i], shares[j], spend[k], step) " |"
    print line
  }
  for (x in renewed) {
    print "\n## Ordering anew where ec_bt is " x " times that, to plain iSAM2\n\n| world | largest ec_bt | seconds |\n|---|---:|---:|"
    for (i = 1; i <= worlds; ++i) {
      n = split(seeds[world[i]], list, " "); a = b = m = 0
      for (j = 1; j <= n; ++j) {
        key = world[i] SUBSEP list[j] SUBSEP "renew@" x; plain = world[i] SUBSEP list[j] SUBSEP "plain"
        if (key in most && plain in most && seconds[plain] > 0) { a += log(most[key] / most[plain]); b += log(seconds[key] / seconds[plain]); ++m }
      }
      if (m) printf "| %s | %.2f | %.2f |\n", world[i], exp(a / m), exp(b / m)
    }
  }
  print "\nGTSAM's fixed-lag smoothers: not measured."
}
