# Completion of mechanism and reducer for bash. Commands and options are those that the program's own --help lists,
# channels those that `mechanism channels` finds in the results file on the line: nothing here must follow when they change.

# Options of a command with what --help says of them, one a line: "--output TEXT REQUIRED  results file".
_tisserand_options() {
  "$program" "$command" --help 2>/dev/null |
    awk '/^Options:/ { on = 1; next } /^[A-Z]/ { on = 0 } on && /^  -/ { sub(/^ */, ""); print }'
}

# _tisserand_files [endings [ending]]: folders, and files with one of the endings, or if there are none, with the other;
# without arguments all.
_tisserand_files() {
  local ending name typed="${current/#\~\//$HOME/}"
  local -a all folders=() wanted=() others=()
  mapfile -t all < <(compgen -f -- "$typed")
  for name in "${all[@]}"; do
    if [ -d "$name" ]; then
      folders+=("$name")
      continue
    fi
    for ending in $1; do
      [[ $name != *."$ending" ]] || wanted+=("$name")
    done
    [[ $# -gt 0 && $name != *."${2:-$1}" ]] || others+=("$name")
  done
  [ ${#wanted[@]} -gt 0 ] || wanted=("${others[@]}")
  COMPREPLY=("${folders[@]}" "${wanted[@]}")
  compopt -o filenames 2>/dev/null
}

_tisserand_words() { mapfile -t COMPREPLY < <(compgen -W "$*" -- "$current"); }

# The first file on the line that ends so.
_tisserand_file_on_line() {
  local word ending
  for word in "${COMP_WORDS[@]:2}"; do
    word="${word/#\~\//$HOME/}"
    for ending in "$@"; do
      if [[ $word == *."$ending" && -f $word ]]; then
        printf '%s' "$word"
        return
      fi
    done
  done
}

# Channels, up to the next "/".
_tisserand_channels() {
  local file
  file="$(_tisserand_file_on_line h5 part)"
  [ -n "$file" ] || return
  mapfile -t COMPREPLY < <("$program" channels "$file" 2>/dev/null | awk -v typed="$current" '
    NR > 1 && index($1, typed) == 1 {
      rest = substr($1, length(typed) + 1)
      slash = index(rest, "/")
      name = typed (slash ? substr(rest, 1, slash) : rest)
      if (!seen[name]++) print name
    }')
  [[ ${COMPREPLY[*]} != */ && ${COMPREPLY[*]} != */\ * ]] || compopt -o nospace 2>/dev/null
}

# Names under `analyses:` of the scene on the line.
_tisserand_analyses() {
  local file
  file="$(_tisserand_file_on_line yaml yml)"
  [ -z "$file" ] || _tisserand_words "$(awk '
    /^[^ #]/ { on = /^analyses:/; next }
    on && match($0, /^ +/) {
      if (!indent) indent = RLENGTH
      if (RLENGTH == indent) { sub(/:.*/, ""); print $1 }
    }' "$file")"
}

# What an option takes; fails if it takes nothing.
_tisserand_value() {
  local option about=""
  while read -r option; do
    [[ ",${option%% *}," != *",$previous,"* ]] || about="${option#* }"
  done < <(_tisserand_options)
  [[ $about =~ ^[A-Z] ]] || return
  case "$program_name $command $previous" in
    *' '-c | *' '--channel) _tisserand_channels ;;
    *' '--analysis) _tisserand_analyses ;;
    *' '--restart) _tisserand_files 'checkpoint.h5 results.h5' h5 ;;
    *' '--reference) _tisserand_files csv && compopt -o nospace 2>/dev/null ;;
    'mechanism plot -o' | 'mechanism plot --output') _tisserand_files 'png svg' ;;
    'mechanism picture -o' | 'mechanism picture --output') _tisserand_files png ;;
    *' '-o | *' '--output | *' '--mass | *' '--rows | *' '--positions) _tisserand_files ;;
    # a list of words: "TEXT REQUIRED   dmig, matrixmarket, fmx, mbdyn"
    'reducer '*) [[ $about != *', '* || $previous != --@(to|from) ]] ||
      _tisserand_words "$(sed -E 's/^TEXT( REQUIRED)? +//; s/ *\(.*//; s/,//g' <<<"$about")" ;;
  esac
  return 0
}

_tisserand() {
  local program="${1/#\~\//$HOME/}" current="$2" previous="$3" command="${COMP_WORDS[1]}"
  local program_name="${program##*/}"
  COMPREPLY=()
  command -v "$program" >/dev/null || return 0
  if [ "$COMP_CWORD" -le 1 ]; then
    _tisserand_words "$("$program" --help 2>/dev/null |
      awk '/^Subcommands:/ { on = 1; next } on && /^  [a-z]/ { print $1 }') --help --version"
    return 0
  fi
  if [[ $current == -* ]]; then
    _tisserand_words "$(_tisserand_options | awk '{ gsub(/,/, " ", $1); print $1 }')"
    return 0
  fi
  if [[ $previous == -* ]] && _tisserand_value; then return 0; fi
  case "$program_name $command" in
    'mechanism run' | 'mechanism check') _tisserand_files scene.yaml yaml ;;
    'mechanism study') _tisserand_files study.yaml yaml ;;
    'mechanism '*) _tisserand_files results.h5 h5 ;;
    'reducer run' | 'reducer solve' | 'reducer mesh' | 'reducer section') _tisserand_files part.yaml yaml ;;
    'reducer show' | 'reducer export') _tisserand_files superelement.h5 h5 ;;
    'reducer groups' | 'reducer view')
      _tisserand_files 'part.yaml recovery.h5 step stp STEP STP iges igs brep geo msh bdf nas dat inp' yaml ;;
    'reducer import') _tisserand_files 'pch mtx sti fmx' ;;
    *) _tisserand_files ;;
  esac
  return 0
}

complete -F _tisserand mechanism reducer
