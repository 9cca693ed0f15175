# bash completion of sgtools and of every sg-COMMAND: the command itself says what a word could become
# (cmd/common/complete.h).
_sgtools() {
  local words=() candidates=() word joined=''
  # bash takes --method=amd apart at the =; here it is one word.
  for word in "${COMP_WORDS[@]:1:COMP_CWORD}"; do
    if [[ ${#words[@]} -gt 0 && ( $word == = || ${words[-1]} == --*= ) ]]; then
      words[-1]+=$word joined=1
    else
      words+=("$word") joined=''
    fi
  done
  mapfile -t candidates < <("${COMP_WORDS[0]}" --complete "${words[@]}" 2>/dev/null)
  if [[ ${candidates[*]} == '*' ]]; then
    compopt -o filenames 2>/dev/null
    word=${words[-1]}
    if [[ $joined ]]; then word=${word#*=}; fi
    mapfile -t COMPREPLY < <(compgen -f -- "$word")
  elif [[ $joined ]]; then
    COMPREPLY=("${candidates[@]#*=}")
  else
    COMPREPLY=("${candidates[@]}")
  fi
}
complete -F _sgtools @commands@
