# speed.json as Markdown: what was wanted and is not there, what is; the machine's limits; how near every stage comes to them.
# Google Benchmark writes one key a line.
/"load_avg"/ { load = $2; gsub(/^\[|,.*/, "", load); next }
{ gsub(/[",]/, ""); key = $1; sub(/:$/, "", key) }
key == "name" { name = $2; sub(/\/(real_time|iterations:1)$/, "", name); split(name, part, "/"); if (!((part[1], part[2]) in seen)) { seen[part[1], part[2]]; row[part[1], ++rows[part[1]]] = name } next }
name != "" { value[name, key] = $2 }

# What follows the kind in a benchmark's name.
function graph(name) { return substr(name, index(name, "/") + 1) }
function giga(x) { return sprintf("%.1f", x / 1e9) }
function percent(x) { return sprintf("%.0f %%", 100 * x) }
# A line of the first table: the worst of all rows of a kind by a key, at least or at most what was wanted.
function want(what, kind, key, sense, bound,   i, x, worst, where, missed) {
  if (rows[kind] == 0) return
  for (i = 1; i <= rows[kind]; ++i) {
    x = key == "by_dpotrf" ? by_dpotrf(row[kind, i]) : value[row[kind, i], key]
    if (x == "") continue
    if (where == "" || sense * x < sense * worst) { worst = x; where = graph(row[kind, i]) }
    if (sense * x < sense * bound) missed = missed (missed == "" ? "" : ", ") graph(row[kind, i]) sprintf(" %.2f", x)
  }
  if (where == "") return
  lines[missed == ""] = lines[missed == ""] sprintf("| %s | %s %s | %.2f (%s) | %s |\n", what, sense > 0 ? "at least" : "at most", bound, worst, where, missed == "" ? "holds" : "**fails**: " missed)
}
function by_dpotrf(front,   other) {
  other = front; sub(/^front/, "dpotrf", other)
  return value[other, "flops"] == "" ? "" : value[front, "flops"] / value[other, "flops"]
}

END {
  registers = value["machine/multiply_add", "flops"]; memory = value["machine/read", "bytes_per_second"]
  print "# How fast, and how near the limit\n"
  printf "%s, one core unless said, load %s at the start. Ratios are of times measured in turns in this run.\n\n", cpu, load
  print "## What was wanted\n"
  want("planning, by one elimination", "plan", "plan_part", -1, 0.1)
  want("a Gauss-Newton iteration with CHOLMOD's elimination, by ours", "iterate", "by_cholmod", 1, 3)
  want("fronts, by LAPACK's Cholesky (OpenBLAS)", "front", "by_dpotrf", 1, 0.8)
  want("eliminations on one thread, by those on two", "threads", "speedup", 1, 1.8)
  want("iSAM2's updates over a replay, by eliminations of all that is there", "replay", "update_by_batch", -1, 0.6)
  print "| what | wanted | worst | |\n|---|---|---|---|"
  printf "%s%s", lines[0], lines[1]
  print "\ng2o and GTSAM are not measured here. An iteration of g2o's does what that with CHOLMOD does: linearizes, forms normal equations,\nand has CHOLMOD eliminate them."

  print "\n## The machine\n\n| | |\n|---|---:|"
  printf "| multiplications and additions in registers | %s Gflop/s |\n", giga(registers)
  if (value["machine/dgemm", "flops"] != "") printf "| product of matrices (OpenBLAS) | %s Gflop/s, %s |\n", giga(value["machine/dgemm", "flops"]), percent(value["machine/dgemm", "flops"] / registers)
  split("read copy zero", passes, " ")
  for (i = 1; i <= 3; ++i) printf "| memory, %s | %s GB/s |\n", passes[i], giga(value["machine/" passes[i], "bytes_per_second"])

  print "\n## Eliminations\n\nAgainst registers: operations of the cliques. Against memory: the system and the factor, each gone through once.\n"
  print "| graph | Gflop/s | of registers | of memory | CHOLMOD's, by ours | iteration with CHOLMOD, by ours | of it linearizing | planning, by an elimination |\n|---|---:|---:|---:|---:|---:|---:|---:|"
  for (i = 1; i <= rows["eliminate"]; ++i) {
    name = graph(row["eliminate", i]); e = "eliminate/" name
    printf "| %s | %s | %s | %s | %.1f | %.1f | %s | %.3f |\n", name, giga(value[e, "flops"]), percent(value[e, "flops"] / registers), percent(value[e, "bytes_per_second"] / memory), value[e, "by_cholmod"], value["iterate/" name, "by_cholmod"], percent(value["iterate/" name, "linearize_part"]), value["plan/" name, "plan_part"]
  }

  print "\n## Fronts\n\n| frontal + separator | Gflop/s | of registers | by LAPACK's Cholesky |\n|---|---:|---:|---:|"
  for (i = 1; i <= rows["front"]; ++i) {
    name = row["front", i]
    x = by_dpotrf(name); split(name, part, "/")
    printf "| %s | %s | %s | %s |\n", part[2], giga(value[name, "flops"]), percent(value[name, "flops"] / registers), x == "" ? "-" : sprintf("%.2f", x)
  }

  print "\n## Reading\n\n| | MB/s | of memory |\n|---|---:|---:|"
  for (i = 1; i <= rows["read"]; ++i) {
    x = value[row["read", i], "bytes_per_second"]
    printf "| %s | %.0f | %s |\n", graph(row["read", i]), x / 1e6, percent(x / memory)
  }
  print "\n## EC from a parsed graph\n\n| | ms | CHOLMOD's analysis, by ours |\n|---|---:|---:|"
  for (i = 1; i <= rows["symbolic"]; ++i) {
    name = graph(row["symbolic", i]); x = value["symbolic/" name, "real_time"]
    printf "| %s | %.3g | %.1f |\n", name, x, value["cholmod_analyze/" name, "real_time"] / x
  }
}
