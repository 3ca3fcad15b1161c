// SPDX-License-Identifier: GPL-3.0-or-later
// Reads and checks `roads` and `tyres` of scene.yaml.
#include <algorithm>
#include <cmath>
#include <map>

#include "formats/roads/road_spectrum.hpp"
#include "formats/scene/check_parts.hpp"
#include "formats/scene/reader.hpp"
#include "formats/scene/time_function_reader.hpp"
#include "formats/tyres/tyre_property_file.hpp"
#include "formats/yaml/fields.hpp"
#include "formats/yaml/geometry.hpp"
#include "formats/yaml/name_check.hpp"

namespace tisserand::formats {
namespace {

constexpr Choice<RoadKind> road_kinds[] = {
    {"plane", RoadKind::plane}, {"profile", RoadKind::profile}, {"grid", RoadKind::grid}, {"crg", RoadKind::crg}};
constexpr Choice<RoadPieceShape> piece_shapes[] = {
    {"cosine", RoadPieceShape::cosine}, {"trapezoid", RoadPieceShape::trapezoid}, {"curve", RoadPieceShape::curve}};
constexpr Choice<RoadClass> road_classes[] = {{"A", RoadClass::A}, {"B", RoadClass::B}, {"C", RoadClass::C},
                                              {"D", RoadClass::D}, {"E", RoadClass::E}, {"F", RoadClass::F},
                                              {"G", RoadClass::G}, {"H", RoadClass::H}};
constexpr Choice<TyreKind> tyre_kinds[] = {{"comprehensive_slip", TyreKind::comprehensive_slip},
                                           {"magic_formula", TyreKind::magic_formula}};

/// Keys of one kind of tyre only. The first ones of each list are required.
constexpr std::string_view slip_keys[] = {
    "radius",  "stiffness",        "slip_stiffness",   "cornering_stiffness", "friction",         "low_speed",
    "damping", "camber_stiffness", "sliding_friction", "rolling_resistance",  "relaxation_length"};
constexpr std::size_t required_slip_keys = 6;
constexpr std::string_view file_keys[] = {"file", "relaxation", "mirrored", "pressure", "scale"};
constexpr std::size_t required_file_keys = 1;
/// Factors of low_speed: of the speed in the file below which MF-Tyre changes its formulas, and of the measuring speed.
constexpr double low_of_vxlow = 0.1, low_of_longvl = 0.005;

std::map<std::string, double> read_scale(const MapReader& map) {
  std::map<std::string, double> scale;
  const YamlNode* node = map.find("scale");
  if (node == nullptr) return scale;
  if (node->kind != YamlKind::map) {
    map.context().fail(node->place, "scale must be a map of scaling factors", "write scale: {LMUX: 0.8, LMUY: 0.8}");
    return scale;
  }
  for (const YamlNode& child : node->children)
    scale[child.key] = read_number(map.context(), child, "scale." + child.key);
  return scale;
}

/// Reads the file of the tyre and sets values that the scene leaves open.
void read_properties(const MapReader& map, const SceneDefinitions& definitions, TyreSpec& tyre) {
  const YamlNode* file = map.find("file");
  if (file == nullptr || file->kind != YamlKind::scalar) return;
  const std::map<std::string, double> scale = read_scale(map);
  try {
    TyreProperties properties =
        read_tyre_property_file((map.context().reader.folder() / file->text).string(),  // absolute if the text is
                                definitions.units, scale);
    const MagicFormula& p = properties.coefficients;
    if (!map.has("relaxation")) tyre.relaxation = p.transient;
    tyre.radius = p.UNLOADED_RADIUS;
    tyre.stiffness = p.VERTICAL_STIFFNESS;
    if (!map.has("low_speed")) tyre.low_speed = p.VXLOW > 0.0 ? low_of_vxlow * p.VXLOW : low_of_longvl * p.LONGVL;
    tyre.properties = std::make_shared<const TyreProperties>(std::move(properties));
  } catch (const Error& error) {
    map.context().fail(file->place, error.what(), "");
  }
}

void read_magic_formula(const MapReader& map, const SceneDefinitions& definitions, TyreSpec& tyre) {
  for (std::size_t i = 0; i < required_file_keys; ++i) map.require(file_keys[i]);
  for (const std::string_view key : slip_keys)
    if (const YamlNode* of_slip = map.find(key); of_slip != nullptr && key != "low_speed")
      map.context().fail(
          of_slip->key_place, fmt::format("'{}' has no effect: the tyre property file gives its value", key),
          key == "friction" ? "remove it; to change the friction of the file, give scale: {LMUX: .., LMUY: ..}"
                            : "remove it");
  read_properties(map, definitions, tyre);
}

void check_slip_keys(const MapReader& map) {
  for (std::size_t i = 0; i < required_slip_keys; ++i) map.require(slip_keys[i]);
  for (const std::string_view key : file_keys)
    map.refuse({key}, "has no effect on a tyre of type comprehensive_slip", "remove it");
}

/// Requires the keys of a shape and refuses others.
void require_keys(const MapReader& map, RoadPieceShape shape) {
  const bool curve = shape == RoadPieceShape::curve;
  for (const char* key : {"start", "length", "height", "ramp", "curve", "iso_8608"}) {
    const std::string_view name = key;
    const bool of_curve = name == "curve" || name == "iso_8608";
    const bool used = of_curve ? curve : name == "ramp" ? shape == RoadPieceShape::trapezoid : !curve;
    if (used && !of_curve)
      map.require(key);
    else if (!used)
      map.refuse({key}, "has no effect with this shape", "remove it");
  }
  if (curve && map.has("curve") == map.has("iso_8608"))
    map.fail("shape curve needs either 'curve' or 'iso_8608'", "write curve: {table: [[0, 0], [10, 0.2]]}");
}

CurveSpec read_iso_road(const Context& context, const YamlNode& node, const std::string& key,
                        const SceneDefinitions& definitions) {
  const MapReader map(context, node, "iso_8608", key + ".iso_8608.");
  IsoRoadSpec spec;
  read_fields(map, spec);
  const double metre = definitions.units.length.factor;
  if (!(metre > 0.0))
    map.fail("the spectrum of iso_8608 is in metres, but the scene has no named units",
             "give units: {length: .., mass: .., time: ..}");
  if (!(spec.length > 0.0 && spec.length * metre <= longest_iso_road))
    map.fail(fmt::format("length {:g} must be positive and at most {:g} m", spec.length, longest_iso_road), "");
  if (!std::isfinite(spec.start)) map.fail("start must be finite", "");
  const bool fine =
      metre > 0.0 && spec.length > 0.0 && spec.length * metre <= longest_iso_road && std::isfinite(spec.start);
  return fine ? iso_road(spec, metre) : CurveSpec{};
}

RoadPieceSpec read_piece(const Context& context, const YamlNode& node, const std::string& key,
                         const SceneDefinitions& definitions) {
  const MapReader map(context, node, "road_piece", key + ".");
  RoadPieceSpec piece;
  read_fields(map, piece);
  if (!map.has("shape")) return piece;
  require_keys(map, piece.shape);
  if (piece.shape != RoadPieceShape::curve) return piece;
  if (const YamlNode* curve = map.find("curve"))
    piece.curve = read_curve(context, *curve, "curve");
  else if (const YamlNode* road = map.find("iso_8608"))
    piece.curve = read_iso_road(context, *road, key, definitions);
  return piece;
}

/// Reads one piece, or a list of pieces.
std::vector<RoadPieceSpec> read_track(const MapReader& map, const char* key, const SceneDefinitions& definitions) {
  std::vector<RoadPieceSpec> pieces;
  const YamlNode* node = map.find(key);
  if (node == nullptr) return pieces;
  for (const YamlNode& piece : items_of(*node))
    pieces.push_back(read_piece(map.context().inside(key), piece, key, definitions));
  return pieces;
}

std::string_view word_of(RoadKind kind) { return std::ranges::find(road_kinds, kind, &Choice<RoadKind>::value)->word; }

/// Refuses keys of other kinds of road.
void refuse_road_keys(const MapReader& map, RoadKind kind) {
  struct Use {
    const char* key;
    std::initializer_list<RoadKind> kinds;
  };
  for (const Use& use :
       {Use{"height", {RoadKind::profile}}, Use{"left", {RoadKind::profile}}, Use{"right", {RoadKind::profile}},
        Use{"transition", {RoadKind::profile}}, Use{"file", {RoadKind::grid, RoadKind::crg}},
        Use{"x", {RoadKind::grid}}, Use{"y", {RoadKind::grid}}, Use{"z", {RoadKind::grid}},
        Use{"x_start", {RoadKind::grid}}, Use{"y_start", {RoadKind::grid}}, Use{"spacing", {RoadKind::grid}}}) {
    if (std::ranges::find(use.kinds, kind) == use.kinds.end())
      map.refuse({use.key}, fmt::format("has no effect on a road of type {}", word_of(kind)),
                 fmt::format("remove it, or write type: {}", word_of(*use.kinds.begin())));
  }
}

void read_tracks(const MapReader& map, const SceneDefinitions& definitions, RoadSpec& road) {
  const bool one = map.has("height"), two = map.has("left") || map.has("right");
  if (one == two)
    map.fail("a profile needs either 'height', or 'left' and 'right'",
             "write height: {shape: cosine, start: 10, length: 1, height: 0.1}");
  if (two) map.require("transition");
  if (one && !two) map.refuse({"transition"}, "has no effect with one height for both tracks", "remove it");
  if (one) road.left = road.right = read_track(map, "height", definitions);
  if (!two) return;
  road.left = read_track(map, "left", definitions);
  road.right = read_track(map, "right", definitions);
}

void check_piece(const RoadPieceSpec& piece, const Subject& subject) {
  if (piece.shape == RoadPieceShape::curve) {
    check_curve(piece.curve, "curve", subject);
    return;
  }
  subject.positive("length", piece.length);
  subject.finite("start", piece.start);
  subject.finite("height", piece.height);
  if (piece.shape != RoadPieceShape::trapezoid) return;
  subject.positive("ramp", piece.ramp);
  if (2.0 * piece.ramp > piece.length)
    subject.add("ramp", fmt::format("two ramps of {:g} do not fit into the length {:g}", piece.ramp, piece.length),
                "shorten the ramps, or lengthen the trapezoid");
}

/// Checks that the file of a tyre has the data that the scene needs.
void check_properties(const TyreSpec& tyre, const Subject& subject) {
  const MagicFormula& p = tyre.properties->coefficients;
  if (tyre.relaxation && (p.LONGITUDINAL_STIFFNESS <= 0.0 || p.LATERAL_STIFFNESS <= 0.0) &&
      (p.PTX1 == 0.0 || p.PTY1 == 0.0))
    subject.add("relaxation",
                "its file has no relaxation lengths (LONGITUDINAL_STIFFNESS and LATERAL_STIFFNESS, or "
                "PTX1 and PTY1)",
                "write relaxation: no");
  if (tyre.pressure && p.NOMPRES <= 0.0)
    subject.add("pressure", "its file has no inflation pressure (NOMPRES)", "remove it");
}

}  // namespace

void read_roads(const MapReader& map, const SceneDefinitions& definitions, std::vector<RoadSpec>& roads) {
  read_entries(map, "roads", "road", roads, [&](const MapReader& inner, RoadSpec& road) {
    refuse_road_keys(inner, road.kind);
    if (road.kind == RoadKind::profile) read_tracks(inner, definitions, road);
    if (road.kind == RoadKind::grid || road.kind == RoadKind::crg)
      road.heights = read_road_heights(inner, definitions, road.kind);
  });
}

void read_tyres(const MapReader& map, const SceneDefinitions& definitions, std::vector<TyreSpec>& tyres) {
  read_entries(map, "tyres", "tyre", tyres, [&](const MapReader& inner, TyreSpec& tyre) {
    if (tyre.kind == TyreKind::magic_formula)
      read_magic_formula(inner, definitions, tyre);
    else if (inner.has("type"))
      check_slip_keys(inner);
  });
}

void check_road(const RoadSpec& road, const Subject& subject) {
  Subject{subject.name, subject.where, subject.faults, "pose."}.finite("position", road.pose.position);
  if (road.kind == RoadKind::grid || road.kind == RoadKind::crg) {
    const std::string fault = road.heights ? fault_of(*road.heights) : "has no heights";
    if (!fault.empty()) subject.add("file", fmt::format("{}", fault), "correct the grid or the file of the road");
  }
  subject.positive("friction", road.friction);
  subject.positive("friction_right", road.friction_right);
  subject.positive("transition", road.transition);
  for (const auto* track : {&road.left, &road.right})
    for (const RoadPieceSpec& piece : *track) {
      if (road.transition || track == &road.left) check_piece(piece, subject);
    }
}

void check_tyre(const SceneIndex& scene, const TyreSpec& tyre, const Subject& subject) {
  check_marker(scene, tyre.wheel, "wheel", subject);
  if (tyre.wheel.node == "ground") subject.add("wheel", "the wheel must not be ground", "name the body of the wheel");
  check_reference(subject, "road", "road", tyre.road, texts_of(scene.scene.roads, &RoadSpec::name));
  if (tyre.axis && !(tyre.axis->allFinite() && tyre.axis->stableNorm() > 0.0))
    subject.add("axis", "axis has zero length or is not finite",
                "give the direction of the axle, to the left of the wheel: [0, 1, 0]");
  if (tyre.axis && tyre.wheel.orientation)
    subject.add("axis", "axis has no effect, since the marker has an orientation",
                "remove it, or the orientation: the axle is y of the marker");
  subject.positive("pressure", tyre.pressure);
  if (tyre.kind == TyreKind::magic_formula) {
    if (tyre.properties == nullptr) return;  // already reported
    if (tyre.low_speed == 0.0)
      subject.add("low_speed", "its file has neither VXLOW nor LONGVL, which give low_speed",
                  "give low_speed; 0.1 m/s is usual");
    else
      subject.positive("low_speed", tyre.low_speed);
    check_properties(tyre, subject);
    return;
  }
  subject.positive("relaxation_length", tyre.relaxation_length);
  subject.positive("radius", tyre.radius);
  subject.positive("stiffness", tyre.stiffness);
  subject.positive("slip_stiffness", tyre.slip_stiffness);
  subject.positive("cornering_stiffness", tyre.cornering_stiffness);
  subject.positive("friction", tyre.friction);
  subject.positive("low_speed", tyre.low_speed);
  subject.not_negative("damping", tyre.damping);
  subject.not_negative("camber_stiffness", tyre.camber_stiffness);
  subject.not_negative("rolling_resistance", tyre.rolling_resistance);
  subject.positive("sliding_friction", tyre.sliding_friction);
  if (tyre.sliding_friction && *tyre.sliding_friction > tyre.friction)
    subject.add("sliding_friction",
                fmt::format("sliding_friction {:g} is above friction {:g}", *tyre.sliding_friction, tyre.friction));
}

std::vector<KeySet> tyre_key_sets() {
  return {
      {"road",
       {choice<&RoadSpec::kind, road_kinds>(
            "type",
            "`plane`; `profile`: heights along the road; `grid`: heights on a rectangular grid; `crg`: an OpenCRG file",
            "required"),
        plain<&RoadSpec::pose>("pose", "pose",
                               "`{position: [x, y, z], orientation: ..}` of its axes in the world: x along the road, y "
                               "to its left, z out of it",
                               "axes of the world"),
        {"height", "road_piece | [road_piece]",
         "`profile`: height of both tracks, a piece or a list of pieces, whose heights are added",
         "required without `left` and `right`"},
        {"left", "road_piece | [road_piece]",
         "`profile`: instead of `height`, the tracks y > 0 and y < 0; a track that is not given is flat", "none"},
        {"right", "road_piece | [road_piece]", ditto},
        plain<&RoadSpec::friction>("friction", "positive",
                                   "factor on the coefficients of friction of tyres on this road"),
        plain<&RoadSpec::friction_right>("friction_right", "positive",
                                         "the same factor to the right of the middle (y < 0; for `crg` v < 0); the "
                                         "transition is a strip as wide as the radius of a tyre",
                                         "`friction`"),
        plain<&RoadSpec::transition>("transition", "positive",
                                     "`profile`: width of the strip about y = 0 between both tracks [length]",
                                     "required with `left` or `right`"),
        {"file", "text", "`grid`: a table; `crg`: an OpenCRG file", "required, except for a grid with `z`"},
        {"x", "[number]2..", "`grid` without `file`: its axes, ascending [length]", "required with `z`"},
        {"y", "[number]2..", ditto},
        {"z", "[[number]2..]2..",
         "`grid` without `file`: heights, one list for each x with one number for each y [length]",
         "required without `file`"},
        {"x_start", "number",
         "`grid` whose file holds heights only: place of the first point, and distance of points [length]",
         "from the file"},
        {"y_start", "number", ditto},
        {"spacing", "positive", ditto}}},
      {"road_piece",
       {choice<&RoadPieceSpec::shape, piece_shapes>("shape",
                                                    "`cosine`: z = `height` (1 − cos(2π(x − `start`)/`length`))/2; "
                                                    "`trapezoid`: with straight ramps; `curve`: z(x) through points",
                                                    "required"),
        plain<&RoadPieceSpec::start>("start", "number", "x at which the piece begins [length]",
                                     "required for `cosine` and `trapezoid`"),
        plain<&RoadPieceSpec::length>("length", "positive", "length from foot to foot [length]",
                                      "required for `cosine` and `trapezoid`"),
        plain<&RoadPieceSpec::height>("height", "number", "height of the top, negative for a dip [length]",
                                      "required for `cosine` and `trapezoid`"),
        plain<&RoadPieceSpec::ramp>("ramp", "positive", "`trapezoid`: length of each ramp [length]",
                                    "required for this kind"),
        {"curve", "curve",
         "`curve`: `{table: [[x, z], ..], interpolation: linear}` or `{file: road.csv}`, a [curve](#curves); the road "
         "ends where the curve ends",
         "either `curve` or `iso_8608`"},
        {"iso_8608", "iso_8608",
         "`curve`: instead of `curve`, a stochastic road: `{class: C, seed: 1, start: 0, length: 200}`",
         "either `curve` or `iso_8608`"}}},
      {"iso_8608",
       {choice<&IsoRoadSpec::road_class, road_classes>("class", "", "required"),
        plain<&IsoRoadSpec::seed>("seed", "integer", "", "required"), plain<&IsoRoadSpec::start>("start", "number", ""),
        plain<&IsoRoadSpec::length>("length", "positive", "", "required")}},
      {"tyre",
       {choice<&TyreSpec::kind, tyre_kinds>(
            "type", "model of the tyre: `comprehensive_slip`, or `magic_formula` with a tyre property file",
            "required"),
        plain<&TyreSpec::wheel>("wheel", "place", "centre of the wheel: a node or marker of the body that spins",
                                "required"),
        plain<&TyreSpec::axis>("axis", "vector",
                               "axle at the start, world axes, pointing to the left of the wheel. Forward is `axis` × "
                               "up, so a right-handed rotation about `axis` rolls forward",
                               "y axis of the marker"),
        plain<&TyreSpec::road>("road", "text", "name from `roads`", "required"),
        plain<&TyreSpec::radius>("radius", "positive", "unloaded radius R₀ [length]",
                                 "required for `comprehensive_slip`"),
        plain<&TyreSpec::stiffness>("stiffness", "positive", "vertical stiffness k [force/length]",
                                    "required for `comprehensive_slip`"),
        plain<&TyreSpec::damping>("damping", "not_negative", "vertical damping c [force time/length]"),
        plain<&TyreSpec::slip_stiffness>("slip_stiffness", "positive",
                                         "longitudinal slip stiffness C_s, per slip of 1 [force]",
                                         "required for `comprehensive_slip`"),
        plain<&TyreSpec::cornering_stiffness>("cornering_stiffness", "positive", "cornering stiffness C_α [force/rad]",
                                              "required for `comprehensive_slip`"),
        plain<&TyreSpec::camber_stiffness>("camber_stiffness", "not_negative", "camber stiffness C_γ [force/rad]"),
        plain<&TyreSpec::friction>("friction", "positive", "coefficient of friction μ₀ without slip",
                                   "required for `comprehensive_slip`"),
        plain<&TyreSpec::sliding_friction>("sliding_friction", "positive",
                                           "coefficient of friction μ₁ ≤ μ₀ at a slip of 1 and beyond", "`friction`"),
        plain<&TyreSpec::rolling_resistance>(
            "rolling_resistance", "not_negative",
            "coefficient C_r: moment that resists rolling, divided by load and rolling radius"),
        plain<&TyreSpec::relaxation_length>(
            "relaxation_length", "positive",
            "relaxation length σ in both directions, over which slips build up [length]", "none"),
        {"file", "text", "`magic_formula`: tyre property file (.tir)", "required for this kind"},
        choice<&TyreSpec::relaxation, yes_or_no>(
            "relaxation", "`magic_formula`: slips build up over the relaxation lengths of the file",
            "by USE_MODE of the file"),
        choice<&TyreSpec::mirrored, yes_or_no>("mirrored",
                                               "`magic_formula`: `yes`: the tyre is on the other side of the vehicle "
                                               "than in the file; a mirrored assembly reverses this",
                                               "`no`"),
        plain<&TyreSpec::pressure>("pressure", "positive", "`magic_formula`: inflation pressure [force/length²]",
                                   "that of the file"),
        {"scale", "{name: number}",
         "`magic_formula`: scaling factors that replace those of the file: `{LMUX: 0.8, LMUY: 0.8}`",
         "those of the file"},
        plain<&TyreSpec::low_speed>("low_speed", "positive",
                                    "speed v₀ [length/time]; below it slips are computed with v₀. 0.1 m/s is usual",
                                    "required for `comprehensive_slip`; else VXLOW/10 or LONGVL/200 of the file")}}};
}

}  // namespace tisserand::formats
