# Completion of mechanism and reducer for fish. It asks the one for bash, which asks the programs: three shells, one list.
set -g __tisserand_engines (path resolve (status dirname)/../../bash-completion/completions)

function __tisserand_complete
    set -l words (commandline -opc)
    set -l typed (commandline -ct)
    set -l engine $__tisserand_engines/(path basename $words[1])
    set -l found (command bash -c 'source "$1" && COMP_CWORD="$2" && shift 2 && COMP_WORDS=("$@") &&
      _tisserand "$1" "${COMP_WORDS[COMP_CWORD]}" "${COMP_WORDS[COMP_CWORD - 1]}" && printf "%s\n" "${COMPREPLY[@]}"' \
      tisserand $engine (count $words) $words "$typed" 2>/dev/null)
    for word in $found
        test -d "$word"; and not string match -q '*/' -- $word; and set word $word/
        string match -q '~*' -- $typed; and set word (string replace -- $HOME '~' $word)
        test -n "$word"; and echo $word
    end
end

for program in mechanism reducer
    complete -c $program -f -a '(__tisserand_complete)'
end
