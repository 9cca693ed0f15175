load ../common

# What a newcomer asks first. Every command has a manual page; the worlds of sg-gen have a help text each.
MAN=$TESTDATA/../man
commands=$(cd "$MAN" && printf '%s\n' sg-*.1 | sed 's/\.1$//')
worlds=$(sg-gen --help | sed -n '/^Worlds:/,$s/^  \([a-z0-9]*\) .*/\1/p')

helps() { printf '%s\n' $commands; printf 'sg-gen %s\n' $worlds; }

# long_options FILE: of a help text. documented PAGE...: of the items of a manual page.
long_options() { option_names "$@" | grep -- '^--' | sort -u; }
documented() {
  awk '/^\.(It|Op|Fl|Oo) / && /Fl/ || /^\.Fl / {
    for (i = 2; i < NF; i++) if ($i == "Fl" && $(i + 1) ~ /^\\?-[a-z]/) print "-" $(i + 1)
    if ($1 == ".Fl" && $2 ~ /^-[a-z]/) print "-" $2
  }' "$@" | sed 's/\\//g' | sort -u
}

@test "every executable has a manual page, and the other way round" {
  [ "$(cd "$BIN" && printf '%s\n' sg-* | grep -v '[.]')" = "$commands" ]
}

@test "--help is a screen, 80 columns wide" {
  [ "$(wc -w <<<"$worlds")" -ge 7 ]
  helps | while read -r command; do
    $command --help >"$BATS_TEST_TMPDIR/help"
    awk -v command="$command" 'length > 80 || /{false}/ {print command ": " $0; bad = 1} END {
      if (NR > 40) print command ": " NR " lines"
      exit bad || NR > 40
    }' "$BATS_TEST_TMPDIR/help" >&2
  done
}

@test "--help and --version end with 0, an unknown option with 2 and one line" {
  for command in $commands; do
    $command -h | grep -q '^Usage: '
    [[ $($command --version) == "$command (sgtools) "[0-9]* ]]
    run -2 $command --no-such-thing <"$TESTDATA/walk.g2o"
    [ "${#lines[@]}" = 1 ]
    [[ $output == "$command: "*" (see $command --help)" ]]
  done
}

@test "the options of --help are those of the manual" {
  cd "$BATS_TEST_TMPDIR"
  documented "$MAN/sgtools.7" >shared
  # Three commands choose how much stays in the same way, told in sg-rand(1) and shared by reference.
  printf '%s\n' --rate --part --keep --like --candidates --min-obs >by_reference
  for command in $commands; do
    { $command --help; [ $command != sg-gen ] || for world in $worlds; do sg-gen $world --help; done; } |
      long_options >said
    documented "$MAN/$command.1" >page
    sort -u shared page >known
    if grep -q '^\.Xr sg-rand 1 \.$' "$MAN/$command.1"; then sort -u -o known known by_reference; fi
    missing=$(comm -23 said known) surplus=$(comm -13 said page | grep -vxF -f <(grep -ohE -- '--[a-z-]+' said shared) || true)
    [ -z "$missing$surplus" ] || { echo "$command: undocumented: $missing; unknown: $surplus" >&2; return 1; }
  done
}

@test "the tour names every command" {
  for command in $commands; do grep -qx "\.It Xr $command 1" "$MAN/sgtools.7"; done
}
