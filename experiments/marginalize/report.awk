# marginalize.tsv and growth.tsv as Markdown: which ways topology ec does not reach (none of it has, at the same graph and rate, as
# little EC under wmf and loses no more information), who dominates whom, whether more pairs lose less, whether maps stay, time and
# memory, then all ways by graph.
BEGIN { FS = "\t" }
FNR == 1 { ++file; next }
file == 1 { row[++n] = $0; graph[n] = $1; rate[n] = $2; way[n] = $3; ec[n] = $7; kld[n] = $8; ate[n] = $10; spent[n] = $11; at[$1, $2, $3] = n }
file == 2 { poses[++m] = $1; growing[m] = $2; seconds[m] = $3; peak[m] = $4 }
function number(x, digits) { return x == "" || x == "-" ? "-" : sprintf("%." digits "g", x) }
function ours(i) { return way[i] ~ /^ec@/ }
function recovered(i) { return way[i] ~ /@/ }
function scored(i) { return ec[i] != "-" && kld[i] != "" && kld[i] != "-" }
function same(i, j) { return graph[i] == graph[j] && rate[i] == rate[j] }
# A part in a thousand is no difference, nor is one of rounding.
function no_more(x, y) { return x + 0 <= 1.001 * y + 1e-9 }
# The way of ec that has least EC of those that lose no more than i.
function best_beside(i,   j, best) {
  for (j = 1; j <= n; ++j)
    if (ours(j) && scored(j) && same(i, j) && no_more(kld[j], kld[i]) && (!best || ec[j] + 0 < ec[best] + 0)) best = j
  return best
}
# The way of ec that loses least of those that have no more EC than i.
function nearest_at(i,   j, best) {
  for (j = 1; j <= n; ++j)
    if (ours(j) && scored(j) && same(i, j) && no_more(ec[j], ec[i]) && (!best || kld[j] + 0 < kld[best] + 0)) best = j
  return best
}
function dominated(i,   j) {
  for (j = 1; j <= n; ++j)
    if (!ours(j) && scored(j) && same(i, j) && no_more(ec[j], ec[i]) && no_more(kld[j], kld[i]) && !(no_more(ec[i], ec[j]) && no_more(kld[i], kld[j]))) return j
  return 0
}
function losses(   i, j, dense, least, most, times) {
  for (i = 1; i <= n; ++i) {
    if (!scored(i)) { printf "- %s, rate %s, %s: no result%s.\n", graph[i], rate[i], way[i], spent[i] ~ /^>/ ? " in " substr(spent[i], 2) " s of processor time" : ""; continue }
    if (ours(i)) continue
    ++rivals[graph[i]]; ++all
    j = best_beside(i)
    if (j && no_more(ec[j], ec[i])) { ++beaten[graph[i]]; ++all_beaten; continue }
    if (way[i] == "dense") {
      ++dense
      for (j = 1; j <= n; ++j) if (ours(j) && scored(j) && same(i, j)) { times = ec[i] / ec[j]; if (!least || times < least) least = times; if (times > most) most = times }
      continue
    }
    printf "- %s, rate %s: %s has an EC of %s and loses %s; ", graph[i], rate[i], way[i], number(ec[i], 3), number(kld[i], 3)
    if (j) printf "%s loses no more, at %.2f times the EC", way[j], ec[j] / ec[i]
    else printf "no price of ec that was run loses as little"
    j = nearest_at(i)
    if (j) printf "; %s has no more EC, and loses %.2f times as much.\n", way[j], kld[j] / kld[i]
    else print "; none has as little EC."
  }
  if (dense) printf "- dense, which loses nothing: ec loses something in all %d cases. Dense costs %.2f to %.0f times its EC.\n", dense, least, most
}
function dominance(   i, g, j) {
  printf "Of %d results of other ways ec dominates %d: at one of the prices that were run it has no more EC and loses no more.\n\n", all, all_beaten
  for (i = 1; i <= n; ++i) {
    g = graph[i]
    if (!(g in told)) { told[g] = ++graphs; name[graphs] = g }
    if (!ours(i) || !scored(i)) continue
    ++own[g]
    j = dominated(i)
    if (j) { ++lost_to[g]; ++all_lost; line[++lines] = sprintf("- %s, rate %s: %s (EC %s, %s lost) is dominated by %s (EC %s, %s lost).", g, rate[i], way[i], number(ec[i], 3), number(kld[i], 3), way[j], number(ec[j], 3), number(kld[j], 3)) }
  }
  print "| graph | other ways | that ec dominates | ec | that another way dominates |\n|---|---:|---:|---:|---:|"
  for (i = 1; i <= graphs; ++i) { g = name[i]; printf "| %s | %d | %d | %d | %d |\n", g, rivals[g], beaten[g], own[g], lost_to[g] }
  if (lines) print ""
  for (i = 1; i <= lines; ++i) print line[i]
}
# Of every topology that has more pairs than another: whether it loses no more.
function compare(what, more, less,   i, j, of, kept, other, broken, k) {
  for (i = 1; i <= n; ++i) {
    if (!scored(i)) continue
    other = way[i]
    if (more == "dense") { if (!recovered(i)) continue; other = "dense" }
    else if (sub("^" less "@", more "@", other) == 0) continue
    j = at[graph[i], rate[i], other]
    if (!j || !scored(j)) continue
    ++of
    if (no_more(kld[j], kld[i])) ++kept
    else broken[++k] = sprintf("  - not %s, rate %s, %s: %s, and %s beside it.", graph[i], rate[i], way[i], number(kld[i], 4), number(kld[j], 4))
  }
  printf "- %s: in %d of %d cases.\n", what, kept, of
  for (i = 1; i <= k; ++i) print broken[i]
}
function saved(   i, j, g, w, k, ways, order) {
  print "EC of a way as a multiple of that of the ec that has least and loses no more: geometric mean over the rates.\n"
  for (i = 1; i <= n; ++i) {
    j = scored(i) && !ours(i) ? best_beside(i) : 0
    if (!j) continue
    if (!(way[i] in order)) { order[way[i]] = ++ways; title[ways] = way[i] }
    sum[graph[i], way[i]] += log(ec[i] / ec[j]); ++count[graph[i], way[i]]
  }
  printf "| way |"; for (g = 1; g <= graphs; ++g) printf " %s |", name[g]
  printf "\n|---|"; for (g = 1; g <= graphs; ++g) printf "---:|"
  print ""
  for (w = 1; w <= ways; ++w) {
    printf "| %s |", title[w]
    for (g = 1; g <= graphs; ++g) { k = count[name[g], title[w]]; printf " %s |", k ? sprintf("%.2f", exp(sum[name[g], title[w]] / k)) : "-" }
    print ""
  }
}
function growth(   i, g, sizes, ways, seen, where, w, s, first, last) {
  for (i = 1; i <= m; ++i) {
    if (!((poses[i], "size") in seen)) { seen[poses[i], "size"] = 1; size[++sizes] = poses[i] }
    if (!((growing[i], "way") in seen)) { seen[growing[i], "way"] = 1; kind[++ways] = growing[i] }
    where[poses[i], growing[i]] = i
  }
  if (!sizes) { print "Not measured."; return }
  first = size[1]; last = size[sizes]
  printf "Half of the poses of a generated Manhattan world taken out: seconds of processor time and megabytes at most, and both at %d poses\nas multiples of those at %d, which has %.0f times fewer.\n\n| way |", last, first, last / first
  for (s = 1; s <= sizes; ++s) printf " %d: s | MB |", size[s]
  printf " s, times | MB, times |\n|---|"
  for (s = 1; s <= sizes; ++s) printf "---:|---:|"
  print "---:|---:|"
  for (w = 1; w <= ways; ++w) {
    printf "| %s |", kind[w]
    for (s = 1; s <= sizes; ++s) { i = where[size[s], kind[w]]; printf " %s | %s |", number(seconds[i], 3), number(peak[i], 3) }
    i = where[first, kind[w]]; g = where[last, kind[w]]
    if (i && seconds[i] + 0 > slowest) { slowest = seconds[i] + 0; slowest_way = kind[w] }
    if (!i || !g) { print " - | - |"; continue }
    if (peak[g] / peak[i] > widest) { widest = peak[g] / peak[i]; widest_way = kind[w] }
    printf " %.2f | %.2f |\n", seconds[g] / seconds[i], peak[g] / peak[i]
  }
  printf "\nAt %d poses the slowest is %s, with %s s; memory grows most with %s, %.2f times for %.0f times the poses.\n", first, slowest_way, number(slowest, 3), widest_way, widest, last / first
}
END {
  print "# Poses taken out\n\nDivergence is that of Kullback and Leibler from the exact marginal, in nats; EC is under wmf where no ordering is named.\n"
  print "## Where topology ec loses\n"
  losses()
  print "\n## Who dominates\n"
  dominance()
  print "\n## More pairs, less lost\n"
  compare("subgraph loses no more than tree", "subgraph", "tree")
  compare("l1 loses no more than tree", "l1", "tree")
  compare("seif loses no more than tree", "seif", "tree")
  compare("dense loses no more than any other topology", "dense", "")
  print "\n## Where the map moves\n"
  for (i = 1; i <= n; ++i)
    if ((recovered(i) || way[i] == "dense") && ate[i] != "-" && ate[i] + 0 > 1e-4) {
      printf "- %s, rate %s, %s: solved again, it is %s from where it was.\n", graph[i], rate[i], way[i], number(ate[i], 3)
      ++moved
    }
  if (!moved) print "Nowhere: every graph that was at its optimum stays there."
  print "\n## Time and memory\n"
  growth()
  print "\n## Published figures\n"
  print "None is set beside these. Mazuran, Tipaldi, Spinello and Burgard (2014), Mazuran, Burgard and Tipaldi (2016) and"
  print "Carlevaris-Bianco, Kaess and Eustice (2014) judge such recoveries by the same divergence; no table of their figures was at"
  print "hand that could be checked. Theirs would not be of the same problem, either: in the evaluation program of the second, poses"
  print "come one by one and are solved and removed in turn, the first ones stay, and a closure to a pose that is gone is composed"
  print "with others before it is added, in the reference as well."
  print "What is proved instead, per factor set: a tree has the least divergence of its structure, and more pairs no more"
  print "than a gap that is given (optimality conditions, in the unit tests)."
  print "\n## What it saves\n"
  saved()
  print "\n## By graph"
  before = ""
  for (i = 1; i <= n; ++i) {
    split(row[i], f, FS)
    if (f[1] != before) {
      printf "\n### %s\n\n![](%s.svg)\n\n| rate | way | vertices | edges | EC colamd | EC wmf | divergence | overconfidence | ATE | seconds |\n", f[1], f[1]
      print "|---:|---|---:|---:|---:|---:|---:|---:|---:|---:|"
      before = f[1]
    }
    printf "| %s | %s | %s | %s | %s | %s | %s | %s | %s | %s |\n", f[2], f[3], f[4], f[5], number(f[6], 3), number(f[7], 3),
           number(f[8], 3), number(f[9], 3), number(f[10], 3), number(f[11], 3)
  }
}
