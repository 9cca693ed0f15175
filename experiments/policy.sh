# What the names of policies mean, for all experiments that compare them: sourced.
#
# policy NAME[@VALUE]: a filter. VALUE is a rate, ecgreedy's share of the whole graph's EC, covisible's PART,N. The caller has set
#   min_obs    observations that a landmark needs
#   seed       of what draws
#   ordering   that ecgreedy prices by; unset: its own default
#   online     of tgreedy: "--online" or nothing
policy() {
  local name=${1%@*} value=${1#*@}
  case $name in
    full) cat ;;
    kf) sg-kf -r "$value" --min-obs "$min_obs" ;;
    covisible) sg-kf --covisible "$value" --min-obs "$min_obs" ;;
    dec) sg-dec -r "$value" --min-obs "$min_obs" ;;
    aligned) sg-dec -r "$value" --offset aligned --min-obs "$min_obs" ;;
    rand) sg-rand -r "$value" --seed "$seed" --min-obs "$min_obs" ;;
    tgreedy) sg-tgreedy ${online:-} -r "$value" --min-obs "$min_obs" ;;
    ecgreedy) sg-ecgreedy --ec-part "$value" ${ordering:+-m "$ordering"} --seed "$seed" --min-obs "$min_obs" ;;
    *) echo "policy: no '$name'" >&2 && return 2 ;;
  esac
}
