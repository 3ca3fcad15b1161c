// Between runs and checkpoint files.
#include "mechanism/run/checkpoint.hpp"

#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "common/error.hpp"
#include "common/sha256.hpp"
#include "mechanism/run/stored_state.hpp"

namespace tisserand::mechanism {
namespace {

std::string producer() { return std::string("tisserand mechanism ") + TISSERAND_VERSION; }

void require_before_end(const formats::Scene& scene, double time, const std::string& file) {
  if (time < scene.integrator.end) return;
  throw Error(fmt::format("stands at t = {:.9g}, the run ends at {:.9g}", time, scene.integrator.end), file,
              "raise integrator.end");
}

void resume_checkpoint(Run& run, const std::string& file) {
  const formats::Checkpoint checkpoint = formats::read_checkpoint(file);
  State& state = run.built.state;
  const std::string own = fingerprint(run.built.model, state);
  if (checkpoint.state_version != State::version || checkpoint.state.size() != state.block().size() ||
      checkpoint.schedule.size() != Schedule(run.scene, run.built.model.breakpoints).memory().size() ||
      checkpoint.fingerprint != own)
    throw Error(fmt::format("is a checkpoint of scene '{}' with other bodies, joints or superelements than '{}' has",
                            checkpoint.scene, run.scene.name),
                file, "go on with the scene that wrote it; values, loads and the end may differ");
  require_before_end(run.scene, checkpoint.time, file);
  state.block() = checkpoint.state;
  run.schedule_memory = checkpoint.schedule;
  run.report.mobility = count_mobility(run.built.model, state, run.workspace.now);
  run.workspace.forget();
  run.report.notes.push_back(
      fmt::format("goes on from {} at t = {:.9g}{}", file, checkpoint.time,
                  checkpoint.producer == producer()
                      ? ""
                      : fmt::format(", written by {}: equal to its tolerance, not bit for bit", checkpoint.producer)));
}

void resume_results(Run& run, const std::string& file, const std::optional<double>& at) {
  State& state = run.built.state;
  const StoredSums sums = read_stored_state(run.built.model, file, at, state, run.workspace);
  require_before_end(run.scene, state.time(), file);
  run.from = StartFrom::motion;
  start(run);
  state.work() = sums.work;
  state.dissipated() = sums.dissipated;
  state.initial_energy() = sums.initial_energy;
  Schedule schedule(run.scene, run.built.model.breakpoints);
  schedule.skip_to(state.time());
  run.schedule_memory = schedule.memory();
  run.report.notes.push_back(fmt::format("goes on from {} at t = {:.9g}", file, state.time()));
}

}  // namespace

std::string fingerprint(const Model& model, const State& state) {
  Sha256 sha;
  const auto add = [&sha](const std::string& text) { sha.add(text.c_str(), text.size() + 1); };
  add(fmt::format("state {}", State::version));
  for (const StateField& field : state.fields()) add(fmt::format("{} {} {}", field.name, field.offset, field.size));
  for (const Node& node : model.nodes) add(fmt::format("{} {} {}", node.name, node.translation, node.rotation));
  for (const Joint& joint : model.joints)
    add(fmt::format("{} {} {}", joint.name, formats::joint_word(joint.kind), joint.row));
  for (const Coupling& coupling : model.couplings) add(fmt::format("{} {}", coupling.name, coupling.row));
  for (const Coordinate& coordinate : model.coordinates) add(coordinate.name);
  for (const std::string& id : model.superelement_content_ids) add(id);
  return sha.hex();
}

std::string checkpoint_path(const std::string& results) {
  for (const std::string_view ending : {".results.h5", ".h5"})
    if (results.ends_with(ending)) return results.substr(0, results.size() - ending.size()) + ".checkpoint.h5";
  return results + ".checkpoint.h5";
}

Checkpoints::Checkpoints(const formats::Scene& scene, const std::string& results, double time)
    : spec_(scene.checkpoint),
      scene_(scene.name),
      path_(checkpoint_path(results)),
      start_(scene.integrator.start),
      round_off_(1e-9 * scene.integrator.step) {
  set_next(time);
}

void Checkpoints::set_next(double time) {
  steps_ = 0;
  next_ = std::numeric_limits<double>::infinity();
  if (spec_.interval)
    next_ = start_ + *spec_.interval * (std::floor((time - start_ + round_off_) / *spec_.interval) + 1.0);
}

void Checkpoints::after_step(const Model& model, const Schedule& schedule, const State& state, Workspace& workspace) {
  ++steps_;
  const bool due = (spec_.every && steps_ >= *spec_.every) || state.time() >= next_ - round_off_;
  if (!due) return;
  formats::write_checkpoint(path_, {scene_, producer(), fingerprint(model, state), State::version, state.time(),
                                    state.block(), schedule.memory()});
  workspace.forget();
  set_next(state.time());
}

void resume(Run& run, const std::string& file, const std::optional<double>& at) {
  if (run.scene.analysis != formats::AnalysisKind::dynamics)
    throw Error("only dynamics can go on from a file", file, "name an analysis of `type: dynamics` with --analysis");
  if (run.scene.integrator.method == formats::Method::bdf)
    throw Error("method: bdf begins with order 1 and cannot go on from a file", file, "use generalised_alpha or hht");
  const bool checkpoint = formats::is_checkpoint(file);
  if (checkpoint && at)
    throw Error(fmt::format("is a checkpoint and holds one instant; t = {:.9g} cannot be chosen", *at), file,
                "leave --at out, or give a results file");
  if (checkpoint)
    resume_checkpoint(run, file);
  else
    resume_results(run, file, at);
}

}  // namespace tisserand::mechanism
