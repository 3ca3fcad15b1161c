#!/usr/bin/env bash
# readme_example.sh <source> <build>: takes the files and commands of the README's first part as they stand and runs them.
set -euo pipefail
readme="$1/README.md"
folder="$(mktemp -d)"
trap 'rm -rf "$folder"' EXIT
cd "$folder"

# block <language> <number>: the text of the n-th fenced block of a language.
block() {
  awk -v fence="\`\`\`$1" -v wanted="$2" '
    /^```/ { inside = !inside && $0 == fence; if (inside) ++n; next }
    inside && n == wanted' "$readme"
}

block yaml 1 >bar.part.yaml
block yaml 2 >bar.scene.yaml
block sh 1 >commands
grep -q '^reducer run' commands || { echo "the README has no commands" >&2; exit 1; }
PATH="$2/bin:$PATH" bash -euo pipefail commands
for file in bar.superelement.h5 bar.results.h5 tip.png; do
  [ -s "$file" ] || { echo "$file was not written" >&2; exit 1; }
done
