#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# install.sh <source> <build>: installs this build into a folder of its own, moves it, and uses what is there as a user would:
# programs, the page with the first part, the schemas, manual pages, completion.
set -euo pipefail
source_dir="$1"
build_dir="$2"
folder="$(mktemp -d)"
trap 'rm -rf "$folder"' EXIT

fail() {
  printf 'install: %s\n' "$*" >&2
  exit 1
}

cmake --install "$build_dir" --prefix "$folder/first" >"$folder/log" 2>&1 || { cat "$folder/log"; fail "cmake --install"; }
mv "$folder/first" "$folder/moved" # nothing may name the folder of the first installation
prefix="$folder/moved"
pages="$prefix/share/doc/tisserand"
programs=(mechanism)
[ ! -x "$build_dir/bin/reducer" ] || programs+=(reducer)

# Commands that a program's help lists.
commands() { "$prefix/bin/$1" --help | awk '/^Subcommands:/ { on = 1; next } on && /^  [a-z]/ { print $1 }'; }

for program in "${programs[@]}"; do
  [ -n "$(commands "$program")" ] || fail "$program --help lists no commands"
  zgrep -q "^\.TH ${program^^} 1 \"\" \"$program [0-9.]* (Tisserand)\"$" "$prefix/share/man/man1/$program.1.gz" || fail "no manual page of $program"
  for command in $(commands "$program"); do
    zgrep -q "^\.SH ${command^^}$" "$prefix/share/man/man1/$program.1.gz" || fail "$program.1 lacks $command"
  done
done

for schema in part scene study; do
  cmp "$source_dir/formats/schema/$schema.schema.json" "$prefix/share/tisserand/schema/$schema.schema.json"
done
for page in README.md CHANGELOG.md copyright docs/TUTORIAL.md formats/SCENE.md reducer/decks/nastran/NASTRAN.md \
  examples/crank/crank.part.yaml meshes/crank.step; do
  [ -s "$pages/$page" ] || fail "$page is not installed"
done
[ -x "$prefix/share/tisserand/examples/crank/run" ] || fail "examples do not run"

# The page that a new user follows, with what is installed and nothing else.
if [ -x "$prefix/bin/reducer" ]; then
  "$source_dir/tests/architecture/page_example.sh" "$pages" "$prefix" README.md "Your first part"
  for program in reducer-solver reducer-mesher; do
    [ ! -e "$prefix/bin/$program" ] || fail "$program is no command for users"
  done
  (cd "$folder" && "$prefix/bin/reducer" groups "$prefix/share/tisserand/meshes/square.step") | grep -q '^face 1' ||
    fail "reducer groups"
fi

# complete_words <words of a command line...>: what bash offers for the last one, a line each.
complete_words() {
  (
    cd "$folder/work"
    # shellcheck source=../../packaging/completion.bash
    source "$prefix/share/bash-completion/completions/$(basename "$1")"
    COMP_WORDS=("$@") COMP_CWORD=$(($# - 1)) COMPREPLY=()
    _tisserand "$1" "${COMP_WORDS[COMP_CWORD]}" "${COMP_WORDS[COMP_CWORD - 1]}"
    printf '%s\n' "${COMPREPLY[@]}"
  )
}

# The same of zsh: through its own search for functions, with what would be shown printed instead.
zsh_words() {
  (cd "$folder/work" && zsh -f -c '
    fpath=("$1" $fpath)
    shift
    autoload -Uz compinit && compinit -D -u
    compadd() { while [[ $1 != -- ]]; do shift; done; shift; print -rl -- "$@" }
    words=("$@") CURRENT=$#words
    $_comps[${words[1]:t}]' zsh "$prefix/share/zsh/vendor-completions" "$@")
}

# The same of fish, which can be asked for what it would show; it marks folders.
fish_words() {
  (cd "$folder/work" && PATH="$prefix/bin:$PATH" fish --no-config -c '
    source $argv[1]
    complete -C (string join " " -- $argv[2..])' "$prefix/share/fish/vendor_completions.d/$(basename "$1").fish" \
    "$(basename "$1")" "${@:2}" | sed 's,^sub/$,sub,')
}

shells=(complete_words)
for shell in zsh fish; do
  if command -v "$shell" >/dev/null; then
    shells+=("${shell}_words")
  else
    printf 'install: completion of %s: not tested, %s is not installed\n' "$shell" "$shell"
  fi
done

# offers <expected lines> <words...>: every shell that is here offers these
offers() {
  local expected="$1" got shell
  shift
  for shell in "${shells[@]}"; do
    got="$("$shell" "$@" | LC_ALL=C sort | tr '\n' ' ')"
    [ "$got" = "$expected " ] || fail "$shell: completion of '$*' offers '$got', not '$expected '"
  done
}

mkdir "$folder/work" "$folder/work/sub"
cat >"$folder/work/drop.scene.yaml" <<'SCENE'
scene: drop
gravity: [0, 0, -9.81]
bodies: {stone: {type: rigid, mass: 1, inertia: [1, 1, 1]}}
integrator: {step: 0.1, end: 0.2}
analyses:
  fall: {type: dynamics}
SCENE
touch "$folder/work/notes.yaml" "$folder/work/arm.part.yaml" "$folder/work/frame.step"
(cd "$folder/work" && "$prefix/bin/mechanism" run drop.scene.yaml -o drop.results.h5 >/dev/null)
for program in "${programs[@]}"; do
  bash -n "$prefix/share/bash-completion/completions/$program"
  # shellcheck disable=SC2046 # commands are words
  offers "$(printf '%s\n' --help --version $(commands "$program") | LC_ALL=C sort | tr '\n' ' ' | sed 's/ $//')" \
    "$prefix/bin/$program" ""
done
offers "drop.scene.yaml sub" "$prefix/bin/mechanism" run ""
offers "--analysis --append --at" "$prefix/bin/mechanism" run --a
offers "fall" "$prefix/bin/mechanism" run drop.scene.yaml --analysis ""
offers "drop.results.h5 sub" "$prefix/bin/mechanism" plot ""
offers "nodes/position/" "$prefix/bin/mechanism" plot drop.results.h5 -c nodes/p
offers "energy/kinetic" "$prefix/bin/mechanism" export drop.results.h5 --channel energy/k
if [ -x "$prefix/bin/reducer" ]; then
  offers "arm.part.yaml sub" "$prefix/bin/reducer" run ""
  offers "arm.part.yaml frame.step sub" "$prefix/bin/reducer" groups ""
  offers "dmig fmx matrixmarket mbdyn" "$prefix/bin/reducer" export arm.superelement.h5 --to ""
fi
