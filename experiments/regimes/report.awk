# regimes.tsv as Markdown. A cell is a world under an ordering. In each: does the paper's claim hold, and which policy pays?
BEGIN { FS = "\t" }
NR == 1 { next }
{
  key = $1 FS $2 FS $3 FS $5
  if (!(key in seen)) { seen[key]; cell[++cells] = key; world[cells] = $1 " | " $2 " | " $3 " | " $4 " | " $5; ordering[cells] = $5 }
  if (!($6 in known)) { known[$6]; policy[++policies] = $6 }
  edges[key, $6] = $8; ec[key, $6] = $9; sigma[key, $6] = $10; eliminate[key, $6] = $11; update[key, $6] = $12
}
function given(x) { return x != "" && x != "-" }
function of(table, k, p) { return given(table[cell[k], p]) && given(table[cell[k], "full"]) ? table[cell[k], p] / table[cell[k], "full"] : "-" }
function number(x, digits) { return given(x) ? sprintf("%." digits "g", x) : "-" }
# "+" holds, "-" fails, "?" not known, of a share between two bounds.
function between(x, low, high) { return !given(x) ? "?" : low <= x + 0 && x + 0 <= high ? "+" : "-" }
function cubed(k, r) { return between(of(ec, k, "kf@" r), .5 / r ^ 3, 2 / r ^ 3) }
function squared(k, r) { return between(of(ec, k, "dec@" r), 4.5 / r ^ 2, 18 / r ^ 2) }
function hardly(k, r,   a, b) {
  a = between(of(ec, k, "rand@" r), .5, 9); b = between(of(ec, k, "tgreedy@" r), .5, 9)
  return a == "-" || b == "-" ? "-" : a == "?" || b == "?" ? "?" : "+"
}
# Table I: kf < dec < rand and tgreedy < full, by the mean time of an update.
function ordered(k, r,   a, b, c, d) {
  a = of(update, k, "kf@" r); b = of(update, k, "dec@" r); c = of(update, k, "rand@" r); d = of(update, k, "tgreedy@" r)
  if (!given(a) || !given(b) || !given(c) || !given(d)) return "?"
  return a < b && b < c && b < d && c < 1 && d < 1 ? "+" : "-"
}
function verdict(claim, k, r) {
  return claim == 1 ? cubed(k, r) : claim == 2 ? squared(k, r) : claim == 3 ? hardly(k, r) : ordered(k, r)
}
# The policy of least EC (or time) among those that lose no more than a quarter of sigma.
function pays(k, table,   p, best) {
  for (p = 1; p <= policies; ++p)
    if (given(of(sigma, k, policy[p])) && of(sigma, k, policy[p]) <= 1.25 && given(of(table, k, policy[p])) && (best == "" || of(table, k, policy[p]) < of(table, k, best))) best = policy[p]
  return best
}
END {
  name[1] = "keyframes: EC falls by about r³ (half of that to twice as much)"
  name[2] = "decimation: EC falls by about r²/9 (half of that to twice as much)"
  name[3] = "rand and tgreedy hardly help: more than half of the EC is left"
  name[4] = "Table I: kf < dec < rand and tgreedy < full, by iSAM2's mean update"
  split("colamd wmf", orders, " ")
  print "# Where pruning pays, and which policy\n\nA cell is a world of `sg-gen sine` under an ordering: " cells " of them. track: observations a landmark.\n"
  print "## The paper's claims: in how many cells each holds\n\n| claim | r | COLAMD | wmf |\n|---|---:|---:|---:|"
  for (c = 1; c <= 4; ++c) for (r = 4; r <= 6; r += 2) {
    line = "| " name[c] " | " r
    for (o = 1; o <= 2; ++o) {
      good = all = 0
      for (k = 1; k <= cells; ++k) if (ordering[k] == orders[o] && (v = verdict(c, k, r)) != "?") { ++all; good += v == "+" }
      line = line " | " (all ? good " of " all : "-")
    }
    print line " |"
  }
  whole = beats = known_cells = 0
  for (k = 1; k <= cells; ++k) if (ordering[k] == "wmf") {
    other = cell[k]; sub(/wmf$/, "colamd", other)
    if (!given(ec[other, "dec@4"])) continue
    ++known_cells
    whole += ec[cell[k], "full"] + 0 < ec[other, "dec@4"] + 0
    beats += ec[cell[k], "rand@4"] + 0 < ec[cell[k], "dec@4"] + 0
  }
  if (known_cells) printf "\nUnder wmf the whole graph costs less than dec at r = 4 under COLAMD in %d of %d worlds, and rand less than dec, both at r = 4 and under wmf, in %d.\n", whole, known_cells, beats
  print "\n## Which policy pays\n\nOf the policies that lose no more than a quarter of sigma, the one of least EC, and the one of the quickest updates; what is left of the whole's.\n"
  print "| range | density | noise | track | ordering | least EC | left | quickest updates | left |\n|---:|---:|---:|---:|---|---|---:|---|---:|"
  for (k = 1; k <= cells; ++k) {
    a = pays(k, ec); b = pays(k, update)
    print "| " world[k] " | " a " | " number(a == "" ? "-" : of(ec, k, a), 2) " | " b " | " number(b == "" ? "-" : of(update, k, b), 2) " |"
    ++first[ordering[k], a]; ++quick[ordering[k], b]
  }
  print "\nIn how many cells:\n\n| policy | least EC, COLAMD | wmf | quickest updates, COLAMD | wmf |\n|---|---:|---:|---:|---:|"
  for (p = 1; p <= policies; ++p) print "| " policy[p] " | " first["colamd", policy[p]] + 0 " | " first["wmf", policy[p]] + 0 " | " quick["colamd", policy[p]] + 0 " | " quick["wmf", policy[p]] + 0 " |"
  print "\n![what is left of the EC](regimes.svg)\n\n## By cell\n\nThe claims in the order above, at r = 4 and 6: + holds, - fails, ? not known. EC, sigma, elimination and update are shares of the whole graph's.\n"
  for (k = 1; k <= cells; ++k) {
    printf "\n| range | density | noise | track | ordering | claims, r = 4 | r = 6 |\n|---:|---:|---:|---:|---|---|---|\n| %s |", world[k]
    for (r = 4; r <= 6; r += 2) printf " %s%s%s%s |", verdict(1, k, r), verdict(2, k, r), verdict(3, k, r), verdict(4, k, r)
    print "\n\n| policy | edges | EC | EC | sigma | elimination | update |\n|---|---:|---:|---:|---:|---:|---:|"
    for (p = 1; p <= policies; ++p) {
      q = policy[p]
      print "| " q " | " edges[cell[k], q] " | " number(ec[cell[k], q], 4) " | " number(of(ec, k, q), 3) " | " number(of(sigma, k, q), 4) " | " number(of(eliminate, k, q), 3) " | " number(of(update, k, q), 3) " |"
    }
  }
}
