# scale.tsv as Markdown.
BEGIN { FS = "\t" }
NR == 1 { next }
{
  if (!($1 in edges)) pipes[++np] = $1
  edges[$1] = $7
  key = $1 FS $2
  if (!(key in total)) { commands[++nc] = key; peak[key] = $6 }
  total[key] += $5; wall[key] += $4
  if ($3 == "read") read[key] += $5
  if ($3 == "write") write[key] += $5
  all[$1] += $5; reading[$1] += ($3 == "read") * $5; writing[$1] += ($3 == "write") * $5
  stages[++ns] = $2 ": " $3; seconds[ns] = $5; in_pipe[ns] = $1
}
END {
  print "# Large graphs\n"
  printf "One block of memory after the other is zeroed at %s.\n", memory
  for (p = 1; p <= np; ++p) {
    name = pipes[p]; million = edges[name] / 1e6
    call = name == "city" ? city : name == "walk" ? walk : solve
    printf "\n## `%s`\n\n%d edges; %.2f s of processor time, %.2f s per million edges. Reading text takes %.0f %% of it, writing %.0f %%.\n\n", call, edges[name], all[name], all[name] / million, 100 * reading[name] / all[name], 100 * writing[name] / all[name]
    print "| command | CPU s | s per million edges | of it reading | writing | peak MB | MB per million edges |\n|---|---:|---:|---:|---:|---:|---:|"
    for (c = 1; c <= nc; ++c) {
      split(commands[c], part, FS)
      if (part[1] != name) continue
      printf "| `%s` | %.2f | %.2f | %.2f | %.2f | %.0f | %.0f |\n", part[2], total[commands[c]], total[commands[c]] / million, read[commands[c]], write[commands[c]], peak[commands[c]], peak[commands[c]] / million
    }
    print "\nThe slowest stages:\n"
    split("", done)
    for (i = 1; i <= 4; ++i) {
      best = 0
      for (s = 1; s <= ns; ++s) if (in_pipe[s] == name && !(s in done) && (!best || seconds[s] > seconds[best])) best = s
      if (!best) break
      done[best]
      printf "%d. %s, %.2f s (%.0f %%)\n", i, stages[best], seconds[best], 100 * seconds[best] / all[name]
    }
  }
}
