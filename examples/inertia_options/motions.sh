# SPDX-License-Identifier: GPL-3.0-or-later
# Motions of examples/inertia_options: their beams, scenes and what is measured of them. Sourced by `run` and `one_against_pieces`.

# Beam of each motion: length, radius, Young's modulus, density.
declare -A beam=(
  [slider-crank]="0.3048 0.0031715 2.068e11 7820"
  [four-bar]="0.4 0.002 2.1e11 7800"
  [pendulum]="1 0.01 1e8 1000"
  [spin-up]="10 0.2 2.8e7 9.55"
  [blade]="5 0.04 7e10 2700"
  [hub]="5 0.04 7e10 2700"
)

# pieces <motion> <n> <A|B|M|F> <place of the base: x y z> <velocity of the base along y> <turn rate about z>: bodies and welds of the beam,
# in `n` superelements, or as an exact beam of n = 0. Sets bodies, welds, first, last.
pieces() {
  local motion="$1" n="$2" inertia="$3" x="$4" y="$5" velocity="$6" turn="$7" length radius modulus density k at option="inertia: $3"
  [ "$3" != F ] || option="second_order: on"
  read -r length radius modulus density <<<"${beam[$motion]}"
  welds="" bodies=""
  if [ "$n" = 0 ]; then
    bodies="  rod: {type: beam, from: [0, 0, 0], to: [$length, 0, 0], elements: 24, nodes_per_element: 3, section: {shape: circle, radius: $radius},
    material: {E: $modulus, nu: 0.3, density: $density}, pose: {position: [$x, $y, 0]}, velocity: [0, $velocity, 0], angular_velocity: [0, 0, $turn]}
"
    first=rod/0 middle=rod/24 last=rod/48
    return
  fi
  for ((k = 1; k <= n; k++)); do
    at="$(awk "BEGIN { printf \"%.12g\", ($k - 1) * $length / $n }")"
    bodies+="  p$k: {type: superelement, file: ${motion}_$n.superelement.h5, $option, pose: {position: [$(awk "BEGIN { printf \"%.12g\", $x + $at }"), $y, 0]},
    velocity: [0, $(awk "BEGIN { printf \"%.12g\", $velocity + $turn * $at }"), 0], angular_velocity: [0, 0, $turn]}
"
    [ "$k" = 1 ] || welds+="  weld$k: {type: fixed, a: p$((k - 1))/tip, b: p$k/base}
"
  done
  first=p1/base middle=p1/mid last="p$n/tip"
  [ "$n" = 1 ] || middle="p$((n / 2))/tip"
}

# scene <motion> <n> <inertia>: prints the scene; sets first, middle, last.
scene() {
  local motion="$1" n="$2" inertia="$3"
  printf 'scene: "%s, %s pieces, inertia %s"\n' "$motion" "$n" "$inertia"
  # from rest to the rate w within T, without a jump of acceleration
  smooth() { printf '"t < %s ? %s/2*(t - %s/pi*sin(pi*t/%s)) : %s*(t - %s/2)"' "$2" "$1" "$2" "$2" "$1" "$2"; }
  case "$motion" in
    slider-crank)
      pieces "$motion" "$n" "$inertia" 0.1524 0 19.01952 -62.4
      cat <<SCENE
bodies:
  crank: {type: rigid, mass: 10, inertia: [0.02, 0.02, 0.02], nodes: {pin: {position: [0.1524, 0, 0]}}, angular_velocity: [0, 0, 124.8]}
${bodies}joints:
  main: {type: revolute, a: ground, b: crank, axis: [0, 0, 1]}
  pin: {type: spherical, a: crank/pin, b: $first}
  guide: {type: generic, a: ground, b: $last, axis: [0, 0, 1], x_axis: [1, 0, 0], hold: [y, z, rx]}
${welds}motions: {drive: {coordinate: main, value: "124.8 * t"}}
integrator: {step: 1e-4, end: 0.1}
SCENE
      ;;
    four-bar)
      pieces "$motion" "$n" "$inertia" 0 0.1 0 0
      cat <<SCENE
bodies:
  crank: {type: rigid, mass: 1, inertia: [0.01, 0.01, 0.01], nodes: {pin: {position: [0, 0.1, 0]}}}
  rocker: {type: rigid, mass: 0.3, inertia: [0.003, 0.003, 0.003], pose: {position: [0.3, -0.2, 0]}, center_of_mass: [0.05, 0.15, 0], nodes: {pin: {position: [0.1, 0.3, 0]}}}
${bodies}joints:
  main: {type: revolute, a: ground, b: crank, axis: [0, 0, 1]}
  pin: {type: revolute, a: crank/pin, b: $first, axis: [0, 0, 1]}
  swing: {type: revolute, a: ground, b: rocker, axis: [0, 0, 1]}
  ball: {type: spherical, a: rocker/pin, b: $last}
${welds}motions: {drive: {coordinate: main, value: $(smooth 60 0.2)}}
integrator: {step: 5e-4, end: 1}
SCENE
      ;;
    pendulum)
      pieces "$motion" "$n" "$inertia" 0 0 0 0
      cat <<SCENE
gravity: [0, -9.81, 0]
bodies:
${bodies}joints:
  pivot: {type: revolute, a: ground, b: $first, axis: [0, 0, 1]}
${welds}integrator: {step: 2e-3, end: 3}
SCENE
      ;;
    spin-up)
      pieces "$motion" "$n" "$inertia" 0 0 0 0
      cat <<SCENE
bodies:
${bodies}joints:
  root: {type: revolute, a: ground, b: $first, axis: [0, 0, 1]}
${welds}motions: {turn: {coordinate: root, value: $(smooth 3 10)}}
integrator: {step: 0.01, end: 15}
SCENE
      ;;
    blade)
      pieces "$motion" "$n" "$inertia" 0 0 0 0
      cat <<SCENE
bodies:
${bodies}joints:
  mast: {type: revolute, a: ground, b: $first, axis: [0, 0, 1]}
${welds}motions: {turn: {coordinate: mast, value: $(smooth 20 2)}}
loads: {lift: {type: force, at: $last, value: [0, 0, "t < 1 ? 0 : 30*(1 - cos(20*(t - 1)))"]}}
integrator: {step: 2e-3, end: 4}
SCENE
      ;;
    hub)
      pieces "$motion" "$n" "$inertia" 1 0 0 0
      cat <<SCENE
bodies:
  hub: {type: rigid, mass: 10, inertia: [3, 3, 5], nodes: {rim: {position: [1, 0, 0]}}}
${bodies}joints:
  mast: {type: revolute, a: ground, b: hub, axis: [0, 0, 1]}
  root: {type: fixed, a: hub/rim, b: $first}
${welds}motions: {turn: {coordinate: mast, value: $(smooth 20 2)}}
loads: {lift: {type: force, at: $last, value: [0, 0, "t < 1 ? 0 : 30*(1 - cos(20*(t - 1)))"]}}
integrator: {step: 2e-3, end: 4}
SCENE
      ;;
  esac
  printf 'output: {channels: [nodes/position, nodes/rotation]}\n'
}

# measure <motion> <name>: $out/<name>.txt, the deflection over time: of the middle off the chord, of the tip across the root's axis, of the
# tip out of the plane.
measure() {
  local motion="$1" name="$2" c channels=()
  for c in "nodes/position/$first/"{x,y} "nodes/rotation/$first/"{w,z} "nodes/position/$middle/"{x,y} "nodes/position/$last/"{x,y,z}; do
    "$mechanism" export "$out/$name.results.h5" -c "$c" -o "$out/column.csv" >/dev/null
    sed '1d; s/.*,//' "$out/column.csv" >"$out/column_${#channels[@]}.txt"
    channels+=("$out/column_${#channels[@]}.txt")
  done
  paste -d' ' "${channels[@]}" | awk -v motion="$motion" '{
    if (motion == "blade" || motion == "hub") print $9
    else if (motion == "slider-crank" || motion == "four-bar") {
      cx = $7 - $1; cy = $8 - $2; print (cx * ($6 - $2) - cy * ($5 - $1)) / sqrt(cx * cx + cy * cy)
    } else { a = 2 * atan2($4, $3); print -sin(a) * ($7 - $1) + cos(a) * ($8 - $2) }
  }' >"$out/$name.txt"
}

# one <motion> <n> <inertia>: "error% iterations-per-step CPU" of a model, or "-" where it does not run to the end
one() {
  local name="$1_$2_$3" coordinates steps iterations seconds
  pieces "$1" "$2" "$3" 0 0 0 0
  scene "$1" "$2" "$3" >"$out/$name.scene.yaml"
  if ! simulate "$out/$name.scene.yaml" "$name" 2>/dev/null; then
    echo "- - -"
    return
  fi
  measure "$1" "$name"
  read -r coordinates steps iterations seconds <<<"$(cost "$name")"
  [ "$2" != 0 ] || return 0
  paste -d' ' "$out/$name.txt" "$out/$1_0_exact.txt" | awk -v i="$iterations" -v s="$steps" -v cpu="$seconds" '
    { e += ($1 - $2) ^ 2; r += $2 ^ 2 } END { printf "%.3g %.2f %.2f\n", 100 * sqrt(e / r), i / s, cpu }'
}

# reduce_pieces <motion> <n>: the superelement of one of `n` pieces; its halves of 16/n beam elements, at least one
reduce_pieces() {
  local motion="$1" n="$2" elements=$((16 / $2)) length radius modulus density
  [ "$elements" -ge 1 ] || elements=1
  read -r length radius modulus density <<<"${beam[$motion]}"
  local settings=(--set "sections.any.radius=$radius" --set "materials.any.E=$modulus" --set "materials.any.density=$density")
  settings+=(--set "points.mid.0=$(awk "BEGIN { printf \"%.12g\", $length / $n / 2 }")" --set "beams.first.elements=$elements")
  settings+=(--set "points.tip.0=$(awk "BEGIN { printf \"%.12g\", $length / $n }")" --set "beams.second.elements=$elements")
  [ "$n" != 1 ] || settings+=(--set "boundary=[base, mid, tip]")
  reduce "$example/piece.part.yaml" "${motion}_$n" "${settings[@]}"
}
