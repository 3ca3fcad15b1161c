#compdef mechanism reducer
# Completion of mechanism and reducer for zsh. It asks the one for bash, which asks the programs: three shells, one list.
# bashcompinit would run the bash code in zsh, which has neither mapfile nor compopt.
local engine="${${(%):-%x}:A:h:h:h}/bash-completion/completions/${words[1]:t}"
local -a found
found=("${(@f)$(command bash -c 'source "$1" && COMP_CWORD="$2" && shift 2 && COMP_WORDS=("$@") &&
  _tisserand "$1" "${COMP_WORDS[COMP_CWORD]}" "${COMP_WORDS[COMP_CWORD - 1]}" && printf "%s\n" "${COMPREPLY[@]}"' \
  tisserand "$engine" "$((CURRENT - 1))" "${(@Q)words}" 2>/dev/null)}")
found=(${found:#}) # without empty ones
(($#found)) || return 1
local -a groups folders words_and_files
groups=(${(M)found:#*/}) folders=(${^${found:#*/}}(N-/)) words_and_files=(${${found:#*/}:|folders})
# What the shell would not match by itself: ~ stands for the home folder.
local -a replace
[[ $words[CURRENT] != \~* ]] || replace=(-U)
(($#groups)) && compadd $replace -S '' -- $groups
(($#folders)) && compadd $replace -f -S / -q -- $folders
(($#words_and_files)) && compadd $replace -f -- $words_and_files
return 0
