#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# old_processor.sh <folder of programs> <-march of the build> <program>...: on a processor that lacks instructions, each
# program says what is missing and ends with status 1, whatever the command; on one that has them it runs. Needs qemu-user.
set -euo pipefail
folder="$1"
march="$2"
shift 2

fail() {
  printf 'old processor: %s\n' "$*" >&2
  exit 1
}
skip() {
  printf 'skipped: %s\n' "$*"
  exit 77
}

qemu="$(command -v qemu-x86_64-static || command -v qemu-x86_64)" || skip "qemu-x86_64 is missing (Debian: qemu-user-static)"
old=Nehalem
lacks=AVX2
case "$march" in
  x86-64) skip "the build is for every x86-64 processor" ;;
  x86-64-v2) old=Conroe lacks=SSE4.2 ;;
esac

out="$(mktemp)"
errors="$(mktemp)"
trap 'rm -f "$out" "$errors"' EXIT

# refuses <program> [argument...]: on the old processor.
refuses() {
  local status=0
  "$qemu" -cpu "$old" "$folder/$1" "${@:2}" </dev/null >"$out" 2>"$errors" || status=$?
  [ "$status" -eq 1 ] || fail "$* on $old: status $status in place of 1: $(cat "$errors")"
  grep -q "^$1: compiled with -march=$march, but this processor lacks .*$lacks" "$errors" ||
    fail "$* on $old does not name $lacks: $(cat "$errors")"
  grep -q 'cmake --preset native' "$errors" || fail "$* on $old names no build that helps: $(cat "$errors")"
  [ ! -s "$out" ] || fail "$* on $old began to work: $(cat "$out")"
}

# What a native build uses, qemu may not have: that runs on this machine.
run=("$qemu" -cpu max)
[ "$march" != native ] || run=()

for program in "$@"; do
  refuses "$program" --version
  refuses "$program" run missing.yaml
  [ "$program" != reducer-mesher ] || continue # it has no options
  "${run[@]}" "$folder/$program" --version </dev/null >"$out" 2>"$errors" ||
    fail "$program --version fails on a processor that has all: $(cat "$errors")"
  grep -q '[0-9]\.[0-9]' "$out" || fail "$program --version prints no version: $(cat "$out")"
done
