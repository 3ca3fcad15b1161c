#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Runs a test of web/test in headless Chromium: browser.sh <source folder> <test> <argument>... Ends with 77 where node or
# Chromium is missing.
set -euo pipefail

command -v node >/dev/null || { printf 'not tested: there is no node here (apt-get install nodejs)\n'; exit 77; }
source="$1" script="$2"
shift 2
exec node "$source/web/test/$script.mjs" "$@"
