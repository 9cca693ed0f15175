# Bundle adjustment in the large: told by its content, priced, solved, drawn, written, or refused with the line.
load ../common

setup() {
  cd "$BATS_TEST_TMPDIR"
  cp "$TESTDATA/desk.bal" .
}

@test "a bundle is read as what it is, whatever its packing and its line ends" {
  run -0 sg-info --no-header -f format,vertices,poses,landmarks,edges,dim desk.bal
  [ "$(cut -f 2 <<< "$output" | paste -s -d ' ')" = "bal 21 5 16 69 93" ]
  sg-info desk.bal | tail -n 3 | diff - <(printf 'EDGE_OBSERVATION_BAL\t69\nVERTEX_CAMERA_BAL\t5\nVERTEX_XYZ\t16\n')
  sg-ec -f ec desk.bal > ec
  sg-ec -f ec < desk.bal | diff ec -
  sed 's/$/\r/' desk.bal | sg-ec -f ec | diff ec -
  sed 's/^/  /; s/$/\t/' desk.bal | sg-ec -f ec | diff ec -
  bzip2 -c desk.bal | sg-ec -f ec | diff ec -
  xz -c desk.bal | sg-ec --from bal -f ec | diff ec -
  # Nine numbers a line, and three.
  { head -n 70 desk.bal; tail -n +71 desk.bal | sed -n 1,45p | paste -d ' ' - - - - - - - - -
    tail -n +116 desk.bal | paste -d ' ' - - -; } > wide.bal
  [ "$(wc -l < wide.bal)" = 91 ]
  [ "$(sg-solve --chi2 wide.bal)" = "$(sg-solve --chi2 desk.bal)" ]
}

@test "a bundle is solved: pose, focal length and distortion of every camera" {
  near "$(sg-solve --chi2 desk.bal)" 30642.170234 1e-9
  run -0 sg-solve desk.bal -o solved.g2o
  [[ $output == "sg-solve: nothing fixes the scale: "* ]]
  [ "${#lines[@]}" -eq 1 ]
  chi2=$(sg-solve --chi2 solved.g2o)
  near "$chi2" 9.5860356 1e-6  # by another program, too
  # Nothing of a second, constant camera moves; all but the pose of the first one does.
  { cat solved.g2o; echo "FIX 1"; } > fixed.g2o
  near "$(sg-solve -q fixed.g2o | sg-solve --chi2)" "$chi2" 1e-6
  before=$(sg-convert desk.bal | awk '$1 == "VERTEX_CAMERA_BAL" && $2 == 0 {print $10}')
  after=$(awk '$1 == "VERTEX_CAMERA_BAL" && $2 == 0 {print $10}' solved.g2o)
  [ "$before" != "$after" ]
  near "$(sg-convert desk.bal | awk '$2 == 0 && /^VERTEX/ {print $3}')" "$(awk '$2 == 0 && /^VERTEX/ {print $3}' solved.g2o)"
  near "$(sg-solve -q --backend cholmod desk.bal | sg-solve --chi2)" "$chi2" 1e-6
  near "$(sg-solve -q --backend qr desk.bal | sg-solve --chi2)" "$chi2" 1e-6
  near "$(sg-convert --to bal solved.g2o | sg-solve --chi2)" "$chi2" 1e-9
}

@test "a bundle goes to g2o and back, and to a trajectory" {
  sg-convert desk.bal > desk.g2o
  near "$(sg-solve --chi2 desk.g2o)" "$(sg-solve --chi2 desk.bal)"
  sg-convert --to bal desk.g2o > back.bal
  [ "$(sg-info --no-header -f format back.bal)" = "$(printf 'format\tbal')" ]
  near "$(sg-solve --chi2 back.bal)" "$(sg-solve --chi2 desk.bal)"
  [ "$(sg-ec --no-header -f ec desk.g2o)" = "$(sg-ec --no-header -f ec back.bal)" ]
  diff <(head -n 70 desk.bal | awk '{$1 = $1; print $1, $2, $3 + 0, $4 + 0}') \
    <(head -n 70 back.bal | awk '{print $1, $2, $3 + 0, $4 + 0}')
  sg-convert --to tum desk.bal > desk.tum
  [ "$(wc -l < desk.tum)" = 5 ]
  near "$(sg-score --reference desk.tum -f ate_rmse --no-header desk.bal)" 0
  sg-plot map desk.bal > map.svg
  grep -q '<svg' map.svg
}

@test "what BAL cannot hold is refused with its line" {
  sg-convert desk.bal > desk.g2o
  sed '3s/ 1 0 1$/ 2 0 1/' desk.g2o > weighed.g2o
  fails 1 "sg-convert: weighed.g2o:3: bal cannot hold information other than the identity (1 line; --lossy leaves them out)" \
    sg-convert --to bal weighed.g2o
  run -0 sg-convert --to bal --lossy weighed.g2o -o lossy.bal
  near "$(sg-solve --chi2 lossy.bal)" "$(sg-solve --chi2 desk.bal)"
  fails 1 "sg-convert: $TESTDATA/walk.g2o:10: bal cannot hold EDGE_SE2 (5 lines; --lossy leaves them out)" \
    sg-convert --to bal "$TESTDATA/walk.g2o"
  sed 's/^VERTEX_CAMERA_BAL 0 .*/VERTEX_CAMERA_BAL 0 0 0 5 0 0 0 0 500 0 0/' desk.g2o > zero.g2o
  line=$(grep -n '^VERTEX_CAMERA_BAL 0 ' zero.g2o | cut -d : -f 1)
  fails 1 "sg-convert: zero.g2o:$line: the quaternion is zero" sg-convert --to bal zero.g2o
  fails 1 "sg-solve: zero.g2o:$line: a quaternion has length zero" sg-solve zero.g2o
}

@test "a bundle that is damaged is refused with its line" {
  head -n 40 desk.bal > cut.bal
  fails 1 "sg-ec: cut.bal:40: the file ends before observation 40 of 69" sg-ec cut.bal
  head -n 75 desk.bal > cut.bal
  fails 1 "sg-ec: cut.bal:75: the file ends before camera 1 of 5" sg-ec cut.bal
  { cat desk.bal; echo 1; } > long.bal
  fails 1 "sg-ec: long.bal:164: the file goes on behind the last point" sg-ec long.bal
  sed '5s/^[0-9]*/5/' desk.bal > camera.bal
  fails 1 "sg-ec: camera.bal:5: camera 5: there are no more than 5, counted from 0" sg-ec camera.bal
  sed '80s/.*/nan/' desk.bal > nan.bal
  fails 1 "sg-solve: nan.bal:80: a number is not finite" sg-solve nan.bal
  sed '80s/.*/1,5/' desk.bal > comma.bal
  fails 1 "sg-ec: comma.bal:80: '1,5' is not a number" sg-ec comma.bal
}
