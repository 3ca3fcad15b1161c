#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# mechanism_alone.sh <source> <build>: mechanism needs no PETSc, SLEPc or gmsh. It configures where these cannot be found,
# nothing of them is in that build graph, and the mechanism of this build neither included nor links them.
set -euo pipefail
source_dir="$1"
build_dir="$2"
foreign='petsc|slepc|gmsh'
alone="$(mktemp -d)"
trap 'rm -rf "$alone"' EXIT

fail() {
  printf 'mechanism alone: %s\n' "$*" >&2
  exit 1
}

# A pkg-config that knows neither PETSc nor SLEPc, as on a machine without them.
cat >"$alone/pkg-config" <<'SCRIPT'
#!/bin/sh
case "$*" in *petsc* | *slepc*) exit 1 ;; esac
exec pkg-config "$@"
SCRIPT
chmod +x "$alone/pkg-config"

configure() {
  cmake -S "$source_dir" -B "$alone/$1" -G Ninja -DPKG_CONFIG_EXECUTABLE="$alone/pkg-config" -DTISSERAND_TESTS=OFF \
    -DTISSERAND_BENCHMARKS=OFF -DTISSERAND_REDUCER="$1" >"$alone/$1.log" 2>&1
}

configure OFF || { cat "$alone/OFF.log"; fail "does not configure without PETSc, SLEPc and gmsh"; }
! grep -iE "$foreign" "$alone/OFF/build.ninja" || fail "its build graph knows the libraries above"
! configure ON || fail "PETSc was not hidden, this test proves nothing"

program="$build_dir/bin/mechanism"
[ -x "$program" ] || fail "$program is not built"
! ldd "$program" | grep -iE "$foreign" || fail "links the libraries above"

inclusions="$(ninja -C "$build_dir" -t deps | awk '/^[^ ]/ { ours = /^(common|formats|mechanism)\// } ours')"
grep -q 'mechanism/main\.cpp' <<<"$inclusions" || fail "ninja recorded no inclusions of mechanism, this test proves nothing"
! grep -iE "/($foreign)[^/]*\.h|/($foreign)[^/]*/" <<<"$inclusions" || fail "includes the headers above"
