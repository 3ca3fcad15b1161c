// Keys that have no effect with the method are errors; `step: auto` becomes a number.
#include "formats/scene/integrator_reader.hpp"

#include <algorithm>

namespace tisserand::formats {

namespace {

/// First step of `step: auto`, as a part of the whole time: the error control finds its own within a few steps.
constexpr double automatic_part = 1e-4;

/// Keys that only some methods know.
void refuse(const MapReader& map, const char* key, bool used, const char* remedy) {
  const YamlNode* node = map.find(key);
  if (node != nullptr && !used)
    map.context().fail(node->key_place, fmt::format("'{}' has no effect with this method", key), remedy);
}

void check_keys(const MapReader& map, Method method) {
  const bool bdf = method == Method::bdf;
  if (map.has("rho") && method == Method::hht)
    map.context().fail(map.find("rho")->key_place, "'rho' has no effect with method: hht",
                       "give alpha, or method: generalised_alpha");
  if (map.has("alpha") && method == Method::generalised_alpha)
    map.context().fail(map.find("alpha")->key_place, "'alpha' has no effect with method: generalised_alpha",
                       "give rho, or method: hht");
  if (bdf)
    for (const char* key : {"rho", "alpha", "formulation", "tolerance", "constraint_tolerance", "max_iterations",
                            "max_halvings", "error_control"})
      refuse(map, key, false, "leave it out, or use method: generalised_alpha");
  for (const char* key : {"relative_tolerance", "absolute_tolerance", "stabilisation", "baumgarte"})
    refuse(map, key, bdf, "leave it out, or use method: bdf");
}

ErrorControl read_error_control(const MapReader& map) {
  ErrorControl control;
  control.active = true;
  control.tolerance = map.number("tolerance", control.tolerance);
  control.absolute = map.number("absolute", control.absolute);
  control.min_step = map.number("min_step", control.min_step);
  control.max_step = map.number("max_step", control.max_step);
  return control;
}

BdfSpec read_bdf(const MapReader& map) {
  BdfSpec spec;
  spec.relative_tolerance = map.number("relative_tolerance", spec.relative_tolerance);
  spec.absolute_tolerance = map.number("absolute_tolerance", spec.absolute_tolerance);
  spec.stabilisation = map.choice(
      "stabilisation",
      {Choice<Stabilisation>{"projection", Stabilisation::projection}, {"baumgarte", Stabilisation::baumgarte}},
      spec.stabilisation);
  const YamlNode* baumgarte = map.find("baumgarte");
  if (baumgarte == nullptr) return spec;
  if (spec.stabilisation == Stabilisation::projection)
    map.context().fail(baumgarte->key_place, "'baumgarte' has no effect with stabilisation: projection",
                       "give stabilisation: baumgarte");
  const Context inside{map.context().reader, "integrator baumgarte", map.context().entry};
  const MapReader numbers(inside, *baumgarte, "baumgarte", "integrator.baumgarte.");
  spec.alpha = numbers.number("alpha", spec.alpha);
  spec.beta = numbers.number("beta", spec.beta);
  return spec;
}

/// `auto` where something controls the error; with bdf also when left out.
double read_step(const MapReader& map, const IntegratorSpec& spec, AnalysisKind analysis) {
  const YamlNode* node = map.find("step");
  const bool word = node != nullptr && node->kind == YamlKind::scalar && node->text == "auto";
  const bool controlled = spec.error_control.active || spec.method == Method::bdf;
  if (word && !controlled)
    map.context().fail(node->place, "step: auto needs something that controls the error",
                       "add error_control: {tolerance: 1e-3}, or give the step in units of time");
  if (word || (node == nullptr && spec.method == Method::bdf)) {
    const double whole = spec.end - spec.start, part = automatic_part * whole;
    return spec.error_control.max_step > 0.0 ? std::min(part, spec.error_control.max_step) : part;
  }
  return takes_steps(analysis) ? map.number("step") : map.number("step", spec.step);
}

}  // namespace

IntegratorSpec read_integrator(const MapReader& map, AnalysisKind analysis) {
  IntegratorSpec spec;
  spec.method = map.choice(
      "method",
      {Choice<Method>{"generalised_alpha", Method::generalised_alpha}, {"hht", Method::hht}, {"bdf", Method::bdf}},
      spec.method);
  check_keys(map, spec.method);
  spec.rho = map.number("rho", spec.rho);
  spec.alpha = map.number("alpha", spec.alpha);
  spec.formulation = map.choice(
      "formulation",
      {Choice<Formulation>{"index3", Formulation::index3}, {"stabilised_index2", Formulation::stabilised_index2}},
      spec.formulation);
  if (const YamlNode* control = map.find("error_control")) {
    const Context inside{map.context().reader, "integrator error_control", map.context().entry};
    spec.error_control = read_error_control(MapReader(inside, *control, "error_control", "integrator.error_control."));
  }
  spec.bdf = read_bdf(map);
  spec.start = map.number("start", spec.start);
  spec.end = takes_steps(analysis) ? map.number("end") : map.number("end", spec.end);
  spec.step = read_step(map, spec, analysis);
  spec.tolerance = map.number("tolerance", spec.tolerance);
  spec.constraint_tolerance = map.number("constraint_tolerance", spec.constraint_tolerance);
  spec.max_iterations = map.integer("max_iterations", spec.max_iterations);
  spec.max_halvings = map.integer("max_halvings", spec.max_halvings);
  spec.linear_solver = map.choice("linear_solver",
                                  {Choice<LinearSolver>{"auto", LinearSolver::automatic},
                                   {"klu", LinearSolver::klu},
                                   {"umfpack", LinearSolver::umfpack},
                                   {"dense", LinearSolver::dense},
                                   {"qr", LinearSolver::qr}},
                                  spec.linear_solver);
  return spec;
}

}  // namespace tisserand::formats
