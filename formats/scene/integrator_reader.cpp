// SPDX-License-Identifier: GPL-3.0-or-later
// Reads `integrator`. Keys without effect for the method are errors, and `step: auto` becomes a number.
#include "formats/scene/integrator_reader.hpp"

#include <algorithm>

#include "formats/yaml/fields.hpp"

namespace tisserand::formats {
namespace {

constexpr Choice<Method> methods[] = {{"generalised_alpha", Method::generalised_alpha},
                                      {"hht", Method::hht},
                                      {"bdf", Method::bdf},
                                      {"radau", Method::radau},
                                      {"auto", Method::automatic}};
constexpr Choice<Formulation> formulations[] = {{"index3", Formulation::index3},
                                                {"stabilised_index2", Formulation::stabilised_index2}};
constexpr Choice<LinearSolver> linear_solvers[] = {{"auto", LinearSolver::automatic},
                                                   {"klu", LinearSolver::klu},
                                                   {"umfpack", LinearSolver::umfpack},
                                                   {"dense", LinearSolver::dense},
                                                   {"qr", LinearSolver::qr}};

/// First step of `step: auto` as a part of the whole time. The error control adapts it within a few steps.
constexpr double automatic_part = 1e-4;

/// Checks keys that apply to some methods only.
void check_keys(const MapReader& map, Method method) {
  const bool bdf = method == Method::bdf;
  if (method == Method::hht)
    map.refuse({"rho"}, "has no effect with method: hht", "give alpha, or use method: generalised_alpha");
  if (method == Method::generalised_alpha)
    map.refuse({"alpha"}, "has no effect with method: generalised_alpha", "give rho, or use method: hht");
  const std::string why = "has no effect with this method";
  if (bdf || method == Method::radau)
    map.refuse({"rho", "alpha", "formulation"}, why, "remove it, or use method: generalised_alpha");
  if (bdf)
    map.refuse({"tolerance", "constraint_tolerance", "max_iterations", "max_halvings", "error_control"}, why,
               "remove it, or use method: generalised_alpha");
  else
    map.refuse({"relative_tolerance", "absolute_tolerance"}, why, "remove it, or use method: bdf");
}

ErrorControl read_error_control(const MapReader& map) {
  ErrorControl control;
  control.active = true;
  read_fields(map, control);
  return control;
}

/// Reads `accuracy`, with which the error controls the steps. mechanism/study/accuracy.cpp continues from there.
std::optional<AccuracySpec> read_accuracy(const MapReader& map, AnalysisKind analysis) {
  const YamlNode* node = map.find("accuracy");
  if (node == nullptr || analysis != AnalysisKind::dynamics) return std::nullopt;  // other analyses share the group
  map.refuse({"step", "error_control", "relative_tolerance", "absolute_tolerance"}, "is chosen by 'accuracy'",
             "remove one");
  const Context inside{map.context().reader, "integrator accuracy", map.context().entry};
  AccuracySpec spec;
  read_fields(MapReader(inside, *node, "accuracy", "integrator.accuracy."), spec);
  return spec;
}

/// Method; `automatic` with `accuracy` if neither the method nor parameters of generalised_alpha are given.
Method read_method(const MapReader& map, const IntegratorSpec& spec, AnalysisKind analysis) {
  if (spec.method == Method::automatic && !spec.accuracy && analysis == AnalysisKind::dynamics)
    map.context().fail(map.find("method")->place, "method: auto needs 'accuracy' to choose the method",
                       "add accuracy: {error: .., of: <channel>}, or name the method");
  for (const char* key : {"method", "rho", "formulation"})
    if (map.has(key)) return spec.method;
  return spec.accuracy && spec.linear_solver != LinearSolver::qr ? Method::automatic : spec.method;
}

/// First step: `auto` needs a control of the error, and is the default with bdf and `accuracy`.
double read_step(const MapReader& map, const IntegratorSpec& spec, AnalysisKind analysis) {
  const YamlNode* node = map.find("step");
  const bool word = node != nullptr && node->kind == YamlKind::scalar && node->text == "auto";
  const bool controlled = spec.error_control.active || spec.method == Method::bdf;
  if (word && !controlled)
    map.context().fail(node->place, "step: auto needs error_control or method: bdf",
                       "add error_control: {tolerance: 1e-3}, or give the step in units of time");
  if (word || (node == nullptr && (spec.method == Method::bdf || spec.accuracy))) {
    const double whole = spec.end - spec.start, part = automatic_part * whole;
    return spec.error_control.max_step > 0.0 ? std::min(part, spec.error_control.max_step) : part;
  }
  return takes_steps(analysis) ? map.number("step") : map.number("step", spec.step);
}

}  // namespace

IntegratorSpec read_integrator(const MapReader& map, AnalysisKind analysis) {
  IntegratorSpec spec;
  read_fields(map, spec);
  if (takes_steps(analysis)) map.require("end");
  check_keys(map, spec.method);
  if (const YamlNode* control = map.find("error_control")) {
    const Context inside{map.context().reader, "integrator error_control", map.context().entry};
    spec.error_control = read_error_control(MapReader(inside, *control, "error_control", "integrator.error_control."));
  }
  read_fields(map, spec.bdf);
  spec.accuracy = read_accuracy(map, analysis);
  spec.method = read_method(map, spec, analysis);
  spec.error_control.active = spec.error_control.active || (spec.accuracy && spec.method != Method::bdf);
  spec.step = read_step(map, spec, analysis);
  return spec;
}

std::vector<KeySet> integrator_key_sets() {
  const std::vector<Field> of_bdf = shared_fields(
      "integrator_bdf",
      {plain<&BdfSpec::relative_tolerance>("relative_tolerance", "positive",
                                           "error of each coordinate and velocity per step, relative to its size"),
       plain<&BdfSpec::absolute_tolerance>(
           "absolute_tolerance", "positive",
           "error per step of positions (relative to the size of the scene) and of Euler parameters. For velocities: "
           "the same number per second, or per unit of time with `units: consistent`")});
  return {
      {"integrator",
       {choice<&IntegratorSpec::method, methods>(
            "method",
            "`generalised_alpha`, `hht`, `radau` or `bdf`, see [methods](#methods); `auto` only with `accuracy`",
            "`generalised_alpha`; with `accuracy`: `auto`, unless `rho` or `formulation` is given"),
        plain<&IntegratorSpec::rho>(
            "rho", "number>=0<=1",
            "`generalised_alpha`: spectral radius at infinite frequency, from 0 to 1; 1 is without numerical damping"),
        plain<&IntegratorSpec::alpha>("alpha", "number>=0<=0.3333333333333333", "`hht`: its parameter α, 0 to 1/3"),
        choice<&IntegratorSpec::formulation, formulations>(
            "formulation", "formulation of the constraints: `stabilised_index2` or `index3`", "`stabilised_index2`"),
        {"step", "positive | 'auto'",
         "size of a step [time]; with `error_control` the first step, or `auto` (1e-4 of the whole time)",
         "required in dynamics"},
        plain<&IntegratorSpec::start>("start", "number", "time at which the analysis starts [time]"),
        plain<&IntegratorSpec::end>("end", "number", "time at which it ends, later than `start` [time]",
                                    "required in dynamics"),
        plain<&IntegratorSpec::tolerance>("tolerance", "positive",
                                          "tolerance of Newton's iteration, relative to the largest force so far"),
        plain<&IntegratorSpec::constraint_tolerance>(
            "constraint_tolerance", "positive",
            "largest violation of a constraint, relative to the characteristic length. For its rate it is relative to "
            "this length divided by the step. If 5 `tolerance` × step² × largest acceleration is smaller, steps use "
            "this value, down to round-off"),
        plain<&IntegratorSpec::max_iterations>("max_iterations", "count",
                                               "largest number of Newton iterations per step"),
        plain<&IntegratorSpec::max_halvings>("max_halvings", "number_of",
                                             "how many times a step is halved if it does not converge"),
        choice<&IntegratorSpec::linear_solver, linear_solvers>(
            "linear_solver",
            "`klu` (sparse LU, little fill), `umfpack` (sparse LU, much fill), `dense`, `qr` (sparse QR, slow, always "
            "stable), or `auto`: the one of the first three with the fewest operations"),
        {"error_control", "error_control", "the local error chooses the steps: see [error_control](#error_control)",
         "off: steps as given"},
        {"accuracy", "accuracy",
         "instead of `step` and `error_control`: an error that a result must not exceed, see [accuracy](#accuracy)",
         "none"}},
       of_bdf},
      {"error_control",
       {plain<&ErrorControl::tolerance>(
            "tolerance", "positive",
            "error at the end of the run: positions relative to the size of the scene, rotations in rad. Each step may "
            "add a part in proportion to its duration. A tolerance ten times smaller takes about 3.2 times the steps"),
        plain<&ErrorControl::min_step>("min_step", "not_negative",
                                       "smallest step [time]; the run ends if the error demands a smaller one",
                                       "1e-12 of the whole time"),
        plain<&ErrorControl::max_step>("max_step", "not_negative", "largest step [time]",
                                       "a tenth of the whole time")}},
      {"accuracy",
       {plain<&AccuracySpec::error>("error", "positive", "largest error of the channel, divided by `scale`",
                                    "required"),
        plain<&AccuracySpec::of>("of", "text", "channel of the results, for example `nodes/position/arm/tip/x`",
                                 "required"),
        choice<&AccuracySpec::norm, error_norms>("norm", "`max`, `rms`, `final`, `peak` or `peak_time`"),
        plain<&AccuracySpec::scale>(
            "scale", "positive", "number by which errors are divided",
            "the size of the channel in this norm, as in [STUDY.md](STUDY.md); 1 for `peak_time`")}}};
}

}  // namespace tisserand::formats
