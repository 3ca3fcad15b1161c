#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# seen.sh <program> <fault> <text>: the program fails on this fault, and what it prints holds the text.
set -uo pipefail
if printed="$("$1" "$2" 2>&1)"; then
  printf '%s\nplanted %s: nothing has seen this fault\n' "$printed" "$2"
  exit 1
fi
grep -qE "$3" <<<"$printed" || { printf '%s\nplanted %s: failed, but not by "%s"\n' "$printed" "$2" "$3"; exit 1; }
