# SPDX-License-Identifier: GPL-3.0-or-later
# What the `run` scripts of the examples share: arguments, runs with their cost, rows of tables. Sourced by them.

fail() {
  printf '%s: %s\n' "$(basename "$(dirname "$0")")/run" "$*" >&2
  exit 1
}

# arguments_of_example <arguments...>: sets `example`, `root`, `references`, `out`, `mechanism`, `reducer`.
arguments_of_example() {
  example="$(cd "$(dirname "$0")" && pwd)"
  root="$(cd "$example/../.." && pwd)"
  references="$root/tests/verification/references/cardona"
  local bin="" name
  out=""
  while [ $# -gt 0 ]; do
    case "$1" in
      -h | --help)
        printf 'Usage: %s [--bin <folder of reducer and mechanism>] [<output folder>]\n' "$0"
        printf 'Without --bin: build/release/bin, else the programs on the PATH. Output: build/examples/%s\n' \
          "$(basename "$example")"
        exit 0
        ;;
      --bin)
        [ $# -ge 2 ] || fail "--bin needs the folder of the programs"
        bin="$2"
        shift
        ;;
      -*) fail "unknown option '$1'; see --help" ;;
      *)
        [ -z "$out" ] || fail "two output folders, '$out' and '$1'; see --help"
        out="$1"
        ;;
    esac
    shift
  done
  if [ -z "$out" ] && [ -f "$root/CMakeLists.txt" ]; then out="$root/build/examples/$(basename "$example")"; fi
  [ -n "$out" ] || out="$PWD/$(basename "$example")"  # installed: the sources are read only
  if [ -z "$bin" ] && [ -x "$root/build/release/bin/mechanism" ]; then bin="$root/build/release/bin"; fi
  for name in mechanism reducer; do
    local program="${bin:+$bin/}$name"
    command -v "$program" >/dev/null ||
      fail "no program '$program'; build it (cmake --preset release && cmake --build --preset release) or give --bin"
    printf -v "$name" '%s' "$(realpath "$(command -v "$program")")"
  done
  mkdir -p "$out" && out="$(cd "$out" && pwd)"
  # One thread: the matrices are small, and CPU seconds are to be compared.
  export OPENBLAS_NUM_THREADS=1
}

# reduce <part file> <name> [--set ...]: $out/<name>.superelement.h5, its certificate in $out/<name>.reducer.log
reduce() {
  local part="$1" name="$2"
  shift 2
  "$reducer" run "$part" -o "$out/$name.superelement.h5" "$@" >"$out/$name.reducer.log" ||
    fail "reducer run $part failed; see $out/$name.reducer.log"
}

# simulate <scene file> <name> [--set ...]: $out/<name>.results.h5; what the program prints and its CPU seconds
# (user and system) in $out/<name>.log. Returns the program's exit code.
simulate() {
  local scene="$1" name="$2" code=0
  shift 2
  local TIMEFORMAT='cpu %U %S'
  { time "$mechanism" run "$scene" -o "$out/$name.results.h5" "$@" >"$out/$name.log" 2>&1 || code=$?; } \
    2>"$out/$name.cpu"
  cat "$out/$name.cpu" >>"$out/$name.log"
  rm "$out/$name.cpu"
  [ "$code" = 0 ] || printf 'mechanism run %s failed (exit code %d); see %s\n' "$scene" "$code" "$out/$name.log" >&2
  return "$code"
}

# cost <name>: "coordinates steps iterations CPU-seconds" of a run
cost() {
  awk '/coordinates, .* constraints/ { for (i = 2; i <= NF; i++) if ($i == "coordinates,") coordinates = $(i - 1) }
       $1 == "steps" { steps = $2; for (i = 3; i <= NF; i++) if ($i == "iterations,") iterations = $(i - 1) }
       $1 == "cpu" { seconds = $2 + $3 }
       END { printf "%s %s %s %.3f\n", coordinates, steps, iterations, seconds }' "$out/$1.log"
}

# node_of_base <name>: its name in a run; nonlinear beams count their nodes, a cut beam has pieces
node_of_base() {
  if grep -q 'nonlinear beam elements' "$out/$1.log"; then
    printf 'beam/0'
  elif grep -q ': Beam in .* superelements of' "$out/$1.log"; then
    printf 'piece1/base'
  else
    printf 'beam/base'
  fi
}

# channel <name>: the z angular velocity of the base
channel() {
  printf 'nodes/angular_velocity/%s/z' "$(node_of_base "$1")"
}

# error_against <name> <reference file:t:column> [--from t --to t]: "max RMS relative%" of the base's angular velocity
error_against() {
  local name="$1" reference="$2"
  shift 2
  "$mechanism" compare "$out/$name.results.h5" --label run -c "$(channel "$name")" \
    --reference "$reference" "$@" | awk '$1 == "run" && NF > 3 && $2 ~ /^nodes/ { print $3, $4, $5 }'
}

# history <name>: a run as reference for others, "file:t:column"
history() {
  "$mechanism" export "$out/$1.results.h5" -c "$(channel "$1")" -o "$out/$1.csv" >/dev/null
  printf '%s:time:%s' "$out/$1.csv" "$(channel "$1")"
}

# picture <file> <title> <first time> <last time> <reference> <name=label>...
picture() {
  local file="$1" title="$2" from="$3" to="$4" reference="$5" one
  shift 5
  local files=() labels=() channels=()
  for one in "$@"; do
    files+=("$out/${one%%=*}.results.h5")
    labels+=(--label "${one#*=}")
    [[ " ${channels[*]} " == *" $(channel "${one%%=*}") "* ]] || channels+=(-c "$(channel "${one%%=*}")")
  done
  "$mechanism" plot "${files[@]}" "${labels[@]}" "${channels[@]}" ${reference:+--reference "$reference"} \
    --title "$title" --range "$from" "$to" \
    --y-label "angular velocity of the base about z" -o "$out/$file" >/dev/null
}

# split_scene <superelement file> <pieces> <modes> <joint of the base> <step> <end>: the beam in equal pieces, each the same
# superelement, welded together. The joint is `revolute` (section 8.1) or `spherical` (8.2, with the impulse at the tip).
# Prints the scene.
split_scene() {
  awk -v file="$1" -v pieces="$2" -v modes="$3" -v joint="$4" -v step="$5" -v end="$6" '
    BEGIN {
      length_ = 141.42 / pieces
      print "scene: \"Beam in " pieces " superelements of " modes " modes\"\nunits: consistent\nbodies:"
      for (i = 1; i <= pieces; i++)
        printf "  piece%d: {type: superelement, file: %s, second_order: off, modes: %d, pose: {position: [%.10g, 0, 0]}}\n", i, file, modes,
          (i - 1) * length_
      print "joints:"
      print "  base: {type: " joint ", a: ground, b: piece1/base" (joint == "revolute" ? ", axis: [0, 0, 1]" : "") "}"
      for (i = 2; i <= pieces; i++)
        printf "  weld%d: {type: fixed, a: piece%d/tip, b: piece%d/base}\n", i - 1, i - 1, i
      print "loads:"
      print "  torque: {type: moment, at: piece1/base, value: [0, 0, {table: [[0, 0], [0.2, 200], [10, 200], [10.2, 0]]}]}"
      if (joint == "spherical")
        print "  impulse: {type: force, at: piece" pieces "/tip, value: [0, 0, {table: [[15, 0], [15.2, 100], [15.4, 0]]}]}"
      printf "integrator: {method: generalised_alpha, rho: 0.9, step: %s, end: %s}\noutput: {every: 1}\n", step, end
    }'
}

# benchmark_tables <folder with targets.csv>: runs every scene of the file with each value of `refine` and prints one table per scene: target, results,
# error of the last result, and its order (log2 of the factor by which the error falls when the value is halved). Scenes with one result each that
# follow each other and have the same targets share a table. Tables without a time lack that column. Columns of targets.csv: scene file, with several
# analyses `scene:analysis`; the setting to vary and its values; quantity; channel (with *: the last that matches), or `modes/2` for the second
# frequency; time; target; scale of the relative error; largest error that the tests accept (empty: none); order that the tests expect (empty: none).
benchmark_tables() {
  local folder="$1" group refine values target
  while IFS=, read -r group refine values; do
    local scenes titles=() timed
    read -ra scenes <<<"$group"
    for target in "${scenes[@]}"; do
      run_refined "$target" "$refine" "$values"
      titles+=("$(title_of "$folder" "$target")")
    done
    timed="$(awk -F, -v scene="${scenes[0]}" '$1 == scene && $6 != 0 { on = 1 } END { print on + 0 }' "$folder/targets.csv")"
    printf '\n### %s\n' "$(printf '%s\n' "${titles[@]}" | awk 'NR == 1 { printf "%s", $0; head = $0; sub(/[^,]*$/, "", head) }
      NR > 1 { printf ", %s", substr($0, 1, length(head)) == head ? substr($0, length(head) + 2) : $0 }')"
    for target in "${scenes[@]}"; do
      awk '/^#/ { sub(/^# */, ""); print; next } { exit }' "$folder/${target%%:*}.scene.yaml"
    done
    for target in "${scenes[@]}"; do rows_of "$folder" "$target" "$values"; done | benchmark_table "$timed" "$values" "${titles[@]}"
  done < <(awk -F, 'NR > 1 { if (!seen[$1]++) order[++n] = $1; set[$1] = $2 "," $3; alike[$1] = alike[$1] $4 "," $6 "," $7 ";" }
    END { for (i = 1; i <= n; i++) { s = order[i]
      if (i > 1 && set[s] == "," && set[order[i - 1]] == "," && alike[s] == alike[order[i - 1]]) line = line " " s
      else { if (i > 1) print line "," last; line = s; last = set[s] } } print line "," last }' "$folder/targets.csv")
}

# title_of <folder> <target>: the name of the scene, and its analysis if it has several
title_of() {
  printf '%s%s' "$(awk '$1 == "scene:" { sub(/^scene: */, ""); print }' "$1/${2%%:*}.scene.yaml")" "$([ "${2%%:*}" = "$2" ] || printf ', %s' "${2#*:}")"
}

# name_of_run <target> <value>
name_of_run() { printf '%s_%s' "${1/:/_}" "$2"; }

# run_refined <target> <refine> <values>: one run for each value, or one without
run_refined() {
  local value
  for value in ${3:--}; do
    local settings=()
    [ "${1%%:*}" = "$1" ] || settings+=(--analysis "${1#*:}")
    [ "$value" = - ] || settings+=(--set "$2=$value")
    simulate "$out/${1%%:*}.scene.yaml" "$(name_of_run "$1" "$value")" "${settings[@]}" || true
  done
}

# rows_of <folder> <target> <values>: quantity,time,target,scale,results of each value
rows_of() {
  awk -F, -v scene="$2" '$1 == scene { print $4 "," $5 "," $6 "," $7 "," $8 }' "$1/targets.csv" |
    while IFS=, read -r quantity channel time target scale; do
      local results=() value name
      for value in ${3:--}; do
        name="$(name_of_run "$2" "$value")"
        if [ "${channel%%/*}" = modes ]; then
          results+=("$(awk -v mode="${channel#*/}" '$1 == "no." { on = 1 } on && $1 == mode { print $2; exit }' "$out/$name.log")")
          continue
        fi
        "$mechanism" export "$out/$name.results.h5" -c "$channel" -o "$out/channel.csv" >/dev/null
        results+=("$(awk -F, -v t="$time" 'NR > 1 { d = $1 - t; if (d < 0) d = -d; if (NR == 2 || d < best) { best = d; y = $NF } }
          END { printf "%.9g", y }' "$out/channel.csv")")
      done
      printf '%s,%s,%s,%s,%s\n' "$quantity" "$time" "$target" "$scale" "${results[*]}"
    done
}

# benchmark_table <timed> <values> <titles...>: the table of the rows on standard input. Several titles: the rows of each in turn, two columns each.
benchmark_table() {
  local timed="$1" values="$2"
  shift 2
  awk -F, -v timed="$timed" -v values="$values" -v titles="$(printf '%s;' "$@")" '
    { row[++rows] = $0 }
    END {
      scenes = split(titles, title, ";") - 1
      if (values != "") { heads = values; gsub(/ /, " | ", heads); heads = heads " | error % | order" }
      else for (k = 1; k <= scenes; k++) {
        sub(/^.*, /, "", title[k])
        heads = heads (k > 1 ? " | " : "") (scenes > 1 ? title[k] : "result") " | error %"
      }
      head = "| quantity |" (timed ? " time |" : "") " target | " heads " |"
      rule = head; gsub(/[^|]+/, " --: ", rule); sub(/--:/, "---", rule)
      printf "\n%s\n%s\n", head, rule
      each = rows / scenes
      for (r = 1; r <= each; r++) {
        for (k = 0; k < scenes; k++) {
          split(row[r + k * each], cell, ","); n = split(cell[5], y, " ")
          if (k == 0) text = sprintf("| %s |%s %.9g |", cell[1], timed ? sprintf(" %g |", cell[2]) : "", cell[3])
          for (i = 1; i <= n; i++) { e[i] = (y[i] - cell[3]) / cell[4]; text = text sprintf(" %.7g |", y[i]) }
          text = text sprintf(" %+.2g |", 100 * e[n])
          order = ""
          if (n > 1 && e[n] != 0 && e[n - 1] / e[n] > 1) order = sprintf("%.1f", log(e[n - 1] / e[n]) / log(2))
          if (values != "") text = text sprintf(" %s |", order)
        }
        print text
      }
    }'
}
