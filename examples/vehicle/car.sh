# SPDX-License-Identifier: GPL-3.0-or-later
# What run and tables share: the files of the chassis, and one run of the car.
part="$root/examples/chassis/chassis.part.yaml"
[ -f "$part" ] || part="$example/../chassis/chassis.part.yaml"  # installed

# make_chassis <folder> [--set ...]: scenes, chassis.superelement.h5 and the modal body of ten modes in the folder below $out
make_chassis() {
  local folder="$1"
  shift
  mkdir -p "$out/$folder"
  cp "$example"/*.yaml "$out/$folder"
  reduce "$part" "$folder/chassis" --set 'modal_body={reference: center, modes: 10}' --set second_order=no \
    --set recovery=yes "$@"  # pages and pictures show the surface of the chassis
}

# car <folder/name> <chassis> <hinge> [--set ...]: $out/<folder/name>.{standing,drive}.results.h5 and .log
car() {
  local name="$1" chassis="$2" hinge="$3"
  shift 3
  sed "s/chassis_rigid.yaml/chassis_$chassis.yaml/; s/hinge_revolute.yaml/hinge_$hinge.yaml/" "$example/car.scene.yaml" >"$out/$name.scene.yaml"
  (cd "$out/$(dirname "$name")" && "$mechanism" run "$(basename "$name").scene.yaml" "$@" >"$out/$name.log" 2>&1) ||
    fail "mechanism run failed; see $out/$name.log"
}
