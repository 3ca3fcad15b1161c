#!/usr/bin/env bash
# Tests web/dist/view.html in headless Chromium: browser.sh <source folder>. Ends with 77 where node or Chromium is missing.
set -euo pipefail

command -v node >/dev/null || { printf 'not tested: there is no node here (apt-get install nodejs)\n'; exit 77; }
exec node "$1/web/test/viewer_test.mjs"
