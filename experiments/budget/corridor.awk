# A corridor of n poses: odometry along a line, and a landmark at every third pose that is seen from four in a row.
BEGIN {
  for (k = 0; k < n; ++k) {
    if (k > 0) print "EDGE_SE2", k - 1, k, "1 0.01 0.01 100 0 0 100 0 400"
    if (k % 3 == 0) for (i = k; i < k + 4 && i < n; ++i) print "EDGE_SE2_XY", i, 10000000 + k, 2 - i + k, "1 50 0 50"
  }
}
