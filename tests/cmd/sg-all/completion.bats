load ../common

# What shells complete: asked of the commands, and through the functions that shells call.
setup() { cd "$BATS_TEST_TMPDIR"; cp "$TESTDATA/walk.g2o" .; }

source "$TESTDATA/../cmd/completion/sgtools.bash"

# tab WORD...: what bash would complete the last word to. bash takes words apart at =.
tab() {
  local COMP_WORDS=() COMP_CWORD COMPREPLY=() word
  for word in "$@"; do
    if [[ $word == --*=* ]]; then COMP_WORDS+=("${word%%=*}" = "${word#*=}"); else COMP_WORDS+=("$word"); fi
  done
  COMP_CWORD=$((${#COMP_WORDS[@]} - 1))
  _sgtools
  echo "${COMPREPLY[*]}"
}

@test "every option of --help is completed, and none besides" {
  for command in "$BIN"/sg-*; do
    name=${command##*/}
    [ "$(tab $name - | tr ' ' '\n')" = "$($name --help | option_names | LC_ALL=C sort)" ] ||
      { echo "$name" >&2; return 1; }
  done
  [ "$(tab sg-gen sine --no-)" = "--no-trace-comment" ]
  [ "$(tab sg-gen sine --see)" = --seed ]
}

@test "methods, worlds, columns, formats, words of an option" {
  [ "$(tab sg-ec -m c)" = colamd ]
  [ "$(tab sg-ec -m amd,wm)" = amd,wmf ]
  [ "$(tab sg-ec --method=sc)" = scotch ]
  [ "$(tab sg-order -m l)" = landmarks-first ]
  [ "$(tab sg-gen s)" = "sine sphere" ]
  [ "$(tab sg-ec -f ec,ec)" = "ec,ec ec,ec_bt" ]
  [ "$(tab sg-ec -f hel)" = help ]
  [ "$(tab sg-convert --to ki)" = kitti ]
  [ "$(tab sg-info --from t)" = "toro tum" ]
  [ "$(tab sg-score --weights r)" = rotation ]
  [ "$(tab sg-solve --backend t)" = tree ]
  [ "$(tab sg-plot m)" = map ]
  [ "$(tab sg-merge --ids '')" = "offset prefix keep" ]
}

@test "every ordering and every column, as their own lists have them" {
  for method in $(tab sg-ec -m ''); do sg-order -m "$method" walk.g2o >/dev/null; done
  [ "$(tab sg-ec -m '' | wc -w)" -ge 14 ]
  [ "$(tab sg-score -f '' | tr ' ' '\n' | sort)" = "$({ echo help; sg-score -f help | awk '!/:$/ {print $1}'; } | sort)" ]
}

@test "names of files, where a file belongs" {
  mkdir folder
  [ "$(tab sg-ec wa)" = walk.g2o ]
  [ "$(tab sg-ec walk.g2o wa)" = walk.g2o ]
  [ "$(tab sg-ec -o fo)" = folder ]
  [ "$(tab sg-ec --output=wa)" = walk.g2o ]
  [ "$(tab sg-plot map wa)" = walk.g2o ]
  [ "$(tab sg-score --reference wa)" = walk.g2o ]
  [ -z "$(tab sg-ec --seed w)" ]
  [ -z "$(tab sg-gen sine w)" ]
}

@test "through sgtools" {
  [ "$(tab sgtools con)" = convert ]
  [ "$(tab sgtools ec -m c)" = colamd ]
  [ "$(tab sgtools ec wa)" = walk.g2o ]
  [ -z "$(tab sgtools nonsense -)" ]
}

@test "zsh" {
  command -v zsh >/dev/null || skip "no zsh here"
  ask() {
    zsh -fc 'compadd() { print -- ${@[2,-1]} }; compset() {}; _files() { print FILES }
      words=("${@[2,-1]}"); CURRENT=$#words; source "$1"' zsh "$TESTDATA/../cmd/completion/_sgtools" "$@"
  }
  [ "$(ask sg-ec -m amd,wm)" = amd,wmf ]
  [ "$(ask sg-ec --method=sc)" = --method=scotch ]
  [ "$(ask sg-gen s)" = "sine sphere" ]
  [ "$(ask sgtools ec --no-h)" = --no-header ]
  [ "$(ask sg-ec '')" = FILES ]
  [ -z "$(ask sg-ec --seed '')" ]
  head -n 1 "$TESTDATA/../cmd/completion/_sgtools" | grep -qx '#compdef sgtools -P sg-\*'
}
