// SPDX-License-Identifier: GPL-3.0-or-later
// Reads part.yaml into the struct Part.
#include "formats/part/part.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "formats/part/check.hpp"
#include "formats/part/fields.hpp"
#include "formats/part/reader.hpp"
#include "formats/sections/reader.hpp"
#include "formats/yaml/fields.hpp"
#include "formats/yaml/reader.hpp"
#include "formats/yaml/units_reader.hpp"

namespace tisserand::formats {
namespace {

constexpr Choice<SecondOrder> second_order_words[] = {{"yes", SecondOrder::yes}, {"no", SecondOrder::no}};

constexpr Choice<ReductionMethod> method_words[] = {{"craig_bampton", ReductionMethod::craig_bampton},
                                                    {"rubin", ReductionMethod::rubin},
                                                    {"macneal", ReductionMethod::macneal}};

constexpr Choice<EigenSolverChoice> eigensolver_words[] = {{"auto", EigenSolverChoice::automatic},
                                                           {"block_lanczos", EigenSolverChoice::block_lanczos},
                                                           {"krylov_schur", EigenSolverChoice::krylov_schur},
                                                           {"lapack", EigenSolverChoice::lapack}};

constexpr Choice<Mechanisms> mechanism_words[] = {{"refuse", Mechanisms::refuse}, {"allow", Mechanisms::allow}};

/// Keys that determine the number of modes, of which one is given.
constexpr const char* how_many[] = {"modes", "cutoff", "accuracy"};

/// Removes the key of the file if an override gives another one of these.
void replace_mode_choice(const std::vector<Override>& overrides, YamlDocument& document) {
  const auto is = [](const Override& one, std::string_view key) {
    return one.path == key || (one.path.starts_with(key) && one.path[key.size()] == '.');
  };
  const auto overridden = [&](std::string_view key) {
    return std::ranges::any_of(overrides, [&](const Override& one) { return is(one, key); });
  };
  if (std::ranges::none_of(how_many, overridden)) return;
  std::erase_if(document.root.children, [&](const YamlNode& node) {
    return std::ranges::find(how_many, node.key) != std::end(how_many) && !overridden(node.key);
  });
}

ModeSelection read_modes(const MapReader& map) {
  ModeSelection modes;
  const char* given = nullptr;
  for (const char* key : how_many) {
    if (!map.has(key)) continue;
    if (given != nullptr)
      map.context().fail(map.find(key)->key_place, fmt::format("both '{}' and '{}' are given", given, key),
                         "give one of them");
    given = key;
  }
  modes.where = map.context().entry;
  read_fields(map, modes);
  if (const YamlNode* node = map.find("eigensolver"))
    modes.eigensolver_where = map.context().reader.where(node->key_place);
  if (const YamlNode* node = map.find("accuracy")) {
    const Context context = key_context(map.context().reader, *node);
    read_fields(MapReader(context, *node, "accuracy"), modes.accuracy.emplace());
    modes.where = context.entry;
  }
  return modes;
}

Part read_tree(YamlReader& reader, const std::string& path) {
  const Context context{reader, "", path};
  const MapReader map(context, reader.root(), "part");
  Part part;
  part.file = path;
  read_fields(map, part);
  if (part.double_curvature > 0 && part.second_order == SecondOrder::no)
    map.refuse({"double_curvature"}, "has no effect with second_order: no", "remove one of them");
  part.units = read_units(map);
  read_part_materials(map, part);
  part.sections = read_sections(map, part.units);
  read_part_points(map, part);
  read_mesh_file(map, part);
  read_groups(map, part);
  read_patches(map, part);
  read_shells_and_solids(map, part);
  read_beams(map, part);
  read_attachments(map, part);
  read_boundary(map, part);
  part.modes = read_modes(map);
  read_modal_body(map, part);
  read_loads(map, part);
  part.recovery = map.choice("recovery", yes_or_no, false);
  return part;
}

}  // namespace

std::vector<Field> part_fields() {
  return {
      plain<&Part::name>("part", "text+", "name of the part; the superelement file stores it", "required"),
      {"units", "'consistent' | units",
       "labels `{length, mass, time}`, or `consistent` for numbers without named units. Such files fit only scenes "
       "that are `consistent` too. Length `m mm cm km in ft`, mass `kg g t lb slug` (t = 1000 kg), time `s ms`",
       "SI"},
      {"mesh", "mesh", "geometry, mesh or deck of another program, see [mesh](#mesh)", "none"},
      {"materials", "{name: material | material_orthotropic}", "name -> material", "none"},
      {"sections", "{name: section}", "name -> section", "none"},
      {"points", "{name: vector | place}",
       "name -> position `[x, y, z]`, or a [place](#place) in the mesh file (`{near: ..}`, `{node: ..}`, "
       "`{centroid: ..}`)",
       "none"},
      {"groups", "{name: group}", "name -> group of faces, edges, volumes or nodes", "none"},
      {"plates", "{name: plate}", "name -> surface that this file draws", "none"},
      {"discs", "{name: disc}", ditto},
      {"cylinders", "{name: cylinder}", ditto},
      {"extrusions", "{name: extrusion}", ditto},
      {"shells", "{name: shell}", "name -> layout and material of groups of faces or volumes", "none"},
      {"solids", "{name: solid}", ditto},
      {"beams", "{name: beam}", "name -> beam", "none"},
      {"point_masses", "{name: point_mass}", "name -> point mass", "none"},
      {"springs", "{name: spring}", "name -> spring", "none"},
      {"spiders", "{name: spider}", "name -> spider", "none"},
      {"boundary", "[name]1.. | {name: 'all' | 'translations' | 'rotations' | boundary_entry}+",
       "nodes of the superelement: a list of points and spiders (all six directions), or a map from names to `all`, "
       "`translations`, `rotations`, or to a [place](#place) with `keep`",
       "required by `reducer run`; with a deck: the boundary of the deck"},
      plain<&ModeSelection::count>("modes", "number_of",
                                   "number of internal modes, lowest first; 0 is Guyan reduction"),
      plain<&ModeSelection::cutoff>(
          "cutoff", "positive",
          "instead of `modes`: keep all internal modes below this frequency [1/time, not rad/time]", "-"),
      {"accuracy", "accuracy", "instead of `modes`: keep as many as this accuracy needs, see [accuracy](#accuracy)",
       "-"},
      plain<&ModeSelection::moments>(
          "moments", "number_of",
          "number of moment vectors, in addition to the internal modes: responses of the interior to accelerations of "
          "the boundary. They improve low frequencies far more than the same number of modes",
          "0; with `accuracy`: as many as it needs"),
      choice<&ModeSelection::method, method_words>(
          "method",
          "`craig_bampton`: modes with the boundary held. `rubin` (Craig-Chang), `macneal`: modes of the free part "
          "with residual flexibility. See [method](#method)"),
      choice<&ModeSelection::eigensolver, eigensolver_words>(
          "eigensolver",
          "eigenvalue solver: `block_lanczos` (our own, blocks of columns), `krylov_schur` (of SLEPc, one column at a "
          "time), `lapack` (all modes of dense matrices, at most 6000 coordinates). [Their "
          "cost](../docs/PERFORMANCE.md#eigenvalue-solvers)"),
      choice<&ModeSelection::mechanism, mechanism_words>(
          "mechanism",
          "`refuse`: error if something inside can move without stiffness while the boundary is held. `allow`: keep "
          "such motions, see [mechanism](#mechanism)"),
      {"recovery", "'yes' | 'no' | true | false",
       "`yes`: also write a [recovery file](RECOVERY.md), from which `reducer recover` computes displacements and "
       "stresses inside the part",
       "no"},
      choice<&Part::second_order, second_order_words>("second_order",
                                                      "`yes`: also write a [companion file](COMPANION.md), from which "
                                                      "a mechanism takes stiffening, buckling and exact inertia",
                                                      "`yes` while the file stays below 20 MB"),
      plain<&Part::double_curvature>(
          "double_curvature", "integer>=0<=100",
          "for plates that bend by their thickness or more: number of elastic modes (lowest ones of the free reduced "
          "part) for whose pairs the companion file stores the membrane stress of double curvature; 0: none",
          "0"),
      {"modal_body", "modal_body", "also write a [modal body file](MODAL_BODY.md), see [modal_body](#modal_body)",
       "none"},
      {"supports", "{text: held | support}",
       "for `reducer solve`: place or group -> directions that are held, see [supports](#supports)", "none"},
      {"load_cases", "{name: load_case}",
       "name -> loads, for `reducer solve` and, through the [companion file](COMPANION.md), for scenes; see "
       "[load_cases](#load_cases)",
       "none"}};
}

std::vector<Field> accuracy_fields() {
  return {plain<&Accuracy::error>("error", "positive",
                                  "largest relative error of a frequency that omitted modes may cause", "required"),
          plain<&Accuracy::up_to>("up_to", "positive",
                                  "highest frequency for which `error` holds [1/time, not rad/time]", "required")};
}

Part read_part(const std::string& path, const std::vector<Override>& overrides) {
  YamlDocument document = load_yaml(path);
  const std::vector<KeySet> legal_keys = part_key_sets();
  apply_overrides(document, overrides, collection_keys(legal_keys));
  replace_mode_choice(overrides, document);
  YamlReader reader(document, legal_keys);
  require_kind(reader, "part", "scene", "give it to `mechanism run`");
  Part part = read_tree(reader, path);
  reader.raise(find_faults(part));
  return part;
}

}  // namespace tisserand::formats
