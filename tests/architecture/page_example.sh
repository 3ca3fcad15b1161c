#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# page_example.sh <source> <build> <page> [heading]: does what a page tells, in its order and in an empty folder; with a
# heading only what stands in that section (up to the next heading of its level).
#   ```yaml blocks become files. Their name is the first line, "# name.yaml", or the last `name` of the paragraph before;
#   ```sh blocks run as they stand, each in a shell of its own that stops at the first error; TISSERAND names <source>;
#   ```text blocks are lines that the commands before must have printed: equal word by word, numbers within one unit of
#   their last digit or 1e-6, integers exactly, values below 1e-9 (round-off) all alike; "..." is any rest of a line.
set -euo pipefail
export TISSERAND="$1" PATH="$2/bin:$PATH"
page="$1/$3" heading="${4:-}"
folder="$(mktemp -d)"
trap 'rm -rf "$folder"' EXIT
mkdir "$folder/blocks" "$folder/run"

fail() {
  printf '%s:%s: %s\n' "$page" "$((10#$1))" "$2" >&2
  [ ! -s "$folder/printed" ] || sed 's/^/    /' "$folder/printed" >&2
  exit 1
}

# Each block becomes a file: <line in the page>.<language>, a yaml block <line>.yaml.<name>.
awk -v folder="$folder/blocks" -v heading="$heading" '
  BEGIN { on = heading == "" }
  !fence && /^#+ / && heading != "" {
    level = length($1)
    title = $0
    sub(/^#+ +/, "", title)
    if (title == heading) { on = 1; top = level } else if (on && level <= top) on = 0
  }
  /^```/ {
    fence = !fence
    language = fence ? substr($0, 4) : ""
    out = ""
    if (fence && on && language ~ /^(sh|text)$/) out = sprintf("%s/%05d.%s", folder, NR, language)
    if (out != "") printf "" > out
    first = fence && on && language == "yaml"
    next
  }
  first {
    first = 0
    if ($1 == "#" && $2 ~ /\.yaml$/ && NF == 2) name = $2
    if (name != "") out = sprintf("%s/%05d.yaml.%s", folder, NR, name)
  }
  fence { if (out != "") print > out; next }
  /^ *$/ { ended = 1; next }
  {
    if (ended) name = ""
    ended = 0
    n = split($0, piece, "`")
    for (i = 2; i < n; i += 2) if (piece[i] ~ /^[A-Za-z0-9_.-]+\.yaml$/) name = piece[i]
  }' "$page"

# unmatched <expected> <printed>: the lines of the first file that the second does not hold.
unmatched() {
  awk '
    function words(line, list) { gsub(/[][(),;%]/, " & ", line); return split(line, list, " ") }
    function number(word) { return word ~ /^[-+]?[0-9]*\.?[0-9]+([eE][-+]?[0-9]+)?$/ }
    function size(x) { return x < 0 ? -x : x }
    function last_digit(word,  parts, mantissa) {
      split(word, parts, /[eE]/)
      mantissa = parts[1]
      return (mantissa ~ /\./ ? 10 ^ -(length(mantissa) - index(mantissa, ".")) : 1) * 10 ^ parts[2]
    }
    function same(want, got,  allowed) {
      if (!number(want) || !number(got)) return want == got
      if (want !~ /[.eE]/) return want + 0 == got + 0
      if (size(want) < 1e-9) return size(got) < 1e-9
      allowed = 1e-6 * size(want)
      if (allowed < last_digit(want)) allowed = last_digit(want)
      return size(got - want) <= 1.0001 * allowed
    }
    function matches(i,  n, m, k) {
      n = words(expected, wanted)
      m = words(printed[i], found)
      for (k = 1; k <= n; k++) {
        if (wanted[k] == "...") return 1
        if (k > m || !same(wanted[k], found[k])) return 0
      }
      return n == m
    }
    NR == FNR { printed[++lines] = $0; next }
    NF {
      expected = $0
      for (i = 1; i <= lines && !matches(i); i++);
      if (i > lines) print
    }' "$2" "$1"
}

cd "$folder/run"
commands=0
: >"$folder/printed"
for block in "$folder"/blocks/*; do
  name="${block##*/}" line="${name%%.*}"
  case "$name" in
    *.sh)
      commands=$((commands + 1))
      # through a pipe: `-o /dev/stdout` would begin a file anew
      bash -euo pipefail "$block" 2>&1 </dev/null | cat >"$folder/printed" || fail "$line" "these commands failed:"
      ;;
    *.text)
      missing="$(unmatched "$block" "$folder/printed")"
      [ -z "$missing" ] || fail "$line" "not printed by the commands before:
$missing
They printed:"
      ;;
    *.yaml.*) cp "$block" "${name#*.yaml.}" ;;
  esac
done
[ "$commands" -gt 0 ] || fail 0 "no commands found${heading:+ under "$heading"}"
# What the commands were told to write is there.
while read -r file; do
  [ -s "$file" ] || fail 0 "$file was not written"
done < <(sed -nE 's/.*(^| )-o ([A-Za-z0-9_.]+)( .*|$)/\2/p' "$folder"/blocks/*.sh)
