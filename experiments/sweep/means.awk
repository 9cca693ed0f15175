# Of every world, policy, rate and order: how many seeds, and of each column after these the mean, the standard deviation, and half
# of the 95 % confidence interval of the mean (Student's t), in the order in which they come.
BEGIN {
  FS = OFS = "\t"
  split("12.706 4.3027 3.1824 2.7764 2.5706 2.4469 2.3646 2.3060 2.2622 2.2281 2.2010 2.1788 2.1604 2.1448 2.1314 2.1199 2.1098 2.1009 2.0930 2.0860 2.0796 2.0739 2.0687 2.0639 2.0595 2.0555 2.0518 2.0484 2.0452 2.0423", t, " ")
}
NR == 1 {
  line = $1 OFS $2 OFS $3 OFS $5 OFS "seeds"
  for (k = 6; k <= NF; ++k) line = line OFS $k "_mean" OFS $k "_sd" OFS $k "_ci"
  print line
  next
}
{
  group = $1 OFS $2 OFS $3 OFS $5
  if (!(group in count)) name[++groups] = group
  ++count[group]
  columns = NF
  for (k = 6; k <= NF; ++k) value[group, count[group], k] = $k
}
END {
  for (g = 1; g <= groups; ++g) {
    group = name[g]; n = count[group]
    line = group OFS n
    for (k = 6; k <= columns; ++k) {
      mean = square = 0
      for (i = 1; i <= n; ++i) mean += value[group, i, k] / n
      for (i = 1; i <= n; ++i) square += (value[group, i, k] - mean) ^ 2
      line = line OFS sprintf("%.10g", mean)
      if (n < 2) { line = line OFS OFS; continue }
      sd = sqrt(square / (n - 1))
      line = line OFS sprintf("%.6g", sd) OFS sprintf("%.6g", (n <= 31 ? t[n - 1] : 1.96) * sd / sqrt(n))
    }
    print line
  }
}
