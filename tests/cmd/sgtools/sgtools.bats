load ../common

setup() { cd "$BATS_TEST_TMPDIR"; cp "$TESTDATA/walk.g2o" .; }

@test "it runs a command as if that were called: output, status, messages, pipes" {
  [ "$(sgtools ec -f ec --no-header walk.g2o)" = 697 ]
  [ "$(sgtools sg-ec -f ec --no-header walk.g2o)" = 697 ]
  sgtools dec -r 2 walk.g2o | cmp - <(sg-dec -r 2 walk.g2o)  # the comment of the call, too
  [ "$(sgtools cut --largest <walk.g2o | sgtools info -f edges --no-header)" = "edges	11" ]
  fails 1 "sg-ec: missing.g2o: No such file or directory" sgtools ec missing.g2o
  fails 2 "sg-ec: --nonsense: there is no such option (see sg-ec --help)" sgtools ec --nonsense
  run -1 sgtools check <(echo 'EDGE_SE2 0 0 1 0 0 1 0 0 1 0 1')
  sgtools gen worst --help | cmp - <(sg-gen worst --help)
}

@test "it finds the others beside itself, not by PATH" {
  [ "$(env PATH=/nowhere "$BIN/sgtools" ec -f ec --no-header walk.g2o)" = 697 ]
  cp "$BIN/sgtools" .
  fails 3 "sgtools: $PWD/sg-ec: No such file or directory" ./sgtools ec walk.g2o
}

@test "it lists every command, as its manual page says what it is" {
  sgtools >list
  cmp list <(sgtools --help)
  [ -z "$(awk 'length > 80' list)" ]
  for command in "$BIN"/sg-*; do
    name=$(basename "$command")
    what=$(sed -n 's/^\.Nd //p' "$TESTDATA/../man/$name.1")
    grep -qE "^  ${name#sg-} +$what$" list
  done
}

@test "a name that is none: the nearest" {
  run -2 --separate-stderr sgtools socre walk.g2o
  [[ $stderr == "sgtools: no command 'socre': did you mean score? There are bayes, "*" (see sgtools --help)" ]]
  fails 2 "sgtools: -f is no command: options stand behind it (see sgtools --help)" sgtools -f ec ec walk.g2o
}

@test "--version tells the libraries and the kernels" {
  sgtools --version >said
  sg-ec --version | sed 's/.*(\(.*\)) /\1 /' | cmp - <(head -n 1 said)
  [ "$(awk '!/^(compiler|kernels) / && NF == 2 && $2 ~ /^[0-9]+[.][0-9.]*[0-9]$/' said | wc -l)" = 11 ]
  SGTOOLS_KERNELS=plain sgtools --version | grep -qE '^kernels +plain \(of plain'
  fails 3 "sgtools: <stdout>: cannot write: No space left on device" bash -c 'exec sgtools --version >/dev/full'
}
