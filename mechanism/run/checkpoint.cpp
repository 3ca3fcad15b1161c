// SPDX-License-Identifier: GPL-3.0-or-later
// Checkpoint files, and runs that continue from files.
#include "mechanism/run/checkpoint.hpp"

#include <cmath>
#include <filesystem>
#include <limits>
#include <sstream>
#include <system_error>

#include <fmt/format.h>

#include "common/error.hpp"
#include "common/output_path.hpp"
#include "common/program/version.hpp"
#include "common/sha256.hpp"
#include "common/text.hpp"
#include "formats/scene/expand/values.hpp"
#include "formats/scene/fields.hpp"
#include "mechanism/run/automatic_effects.hpp"
#include "mechanism/run/stored_state.hpp"
#include "mechanism/step/step_control.hpp"

namespace tisserand::mechanism {
namespace {

namespace fs = std::filesystem;

void require_before_end(const formats::Scene& scene, double time, const std::string& file) {
  if (time < scene.integrator.end) return;
  throw Error(fmt::format("is at t = {:.9g}{}, but the run ends at t = {:.9g}{}", time, after_time(scene.units),
                          scene.integrator.end, after_time(scene.units)),
              file, "increase integrator.end");
}

bool is_same_file(const std::string& a, const std::string& b) {
  std::error_code ignored;
  return fs::weakly_canonical(a, ignored) == fs::weakly_canonical(b, ignored) || fs::equivalent(a, b, ignored);
}

/// Name of the finished results: "arm.results.h5.part" -> "arm.results.h5".
std::string final_name(const std::string& results) { return without_ending(results, {".part"}); }

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

std::string results_of(const formats::Checkpoint& checkpoint, const std::string& file) {
  if (checkpoint.results.empty()) return "";
  return (fs::path(file).parent_path() / fs::path(checkpoint.results).filename()).string();
}

/// Rows that the run of a checkpoint had stored until then.
formats::ResultsBeginning rows_until(const formats::Checkpoint& checkpoint, const std::string& file) {
  const std::string results = results_of(checkpoint, file);
  if (results.empty())
    throw Error("does not name its results file: its format is older than version 1.1", file,
                "omit --append and give -o a new name");
  for (const std::string& candidate : {results, results + ".part"}) {
    if (!fs::exists(candidate)) continue;
    const formats::ResultsReader reader(candidate);
    if (reader.run() == checkpoint.run && reader.rows() >= checkpoint.rows) return {candidate, checkpoint.rows};
  }
  throw Error(fmt::format("the results of its run no longer exist: {} is missing or belongs to another run", results),
              file, "omit --append and give -o a new name");
}

/// Takes the rows of the previous run, and its report if it was written.
void begin_with(Run& run, const formats::ResultsBeginning& beginning) {
  run.beginning = beginning;
  run.report.rows = static_cast<long>(beginning.rows);
  run.report.before = formats::ResultsReader(beginning.file).report_json();
  run.report.notes.push_back(fmt::format("begins with the {} instants of {}", beginning.rows, beginning.file));
}

std::vector<formats::ValueChange> changes_since(const Run& run, const std::string& values) {
  if (run.values.empty() || values.empty()) return {};
  return formats::scene_changes(values, run.values, formats::scene_key_sets());
}

[[noreturn]] void throw_of_another_scene(const Run& run, const formats::Checkpoint& checkpoint,
                                         const std::string& file) {
  const std::vector<formats::ValueChange> changes = changes_since(run, checkpoint.values);
  throw Error(
      fmt::format("is a checkpoint of scene '{}', whose bodies, joints, superelements or companion files differ from "
                  "those of '{}'{}{}",
                  checkpoint.scene, run.scene.name, changes.empty() ? "" : ":", formats::changes_text(changes, "\n  ")),
      file, "continue with the scene that wrote it; integrator, output and tolerances may differ");
}

/// Compares the scene with `values`, those of the scene of the file.
void compare_scenes(Run& run, const std::string& file, const std::string& values, ChangedValues changed) {
  if (run.values.empty()) return;
  if (values.empty()) {
    run.report.notes.push_back(
        fmt::format("{} does not contain its scene, so changes of the scene since then cannot be listed", file));
    return;
  }
  const std::vector<formats::ValueChange> changes = changes_since(run, values);
  if (changes.empty()) return;
  const std::string count = changes.size() == 1 ? "1 value" : fmt::format("{} values", changes.size());
  if (changed == ChangedValues::refused)
    throw Error(fmt::format("belongs to a scene that differs in {}:{}", count, formats::changes_text(changes, "\n  ")),
                file, "set them back, or continue with the changed scene by --changed");
  run.report.notes.push_back(
      fmt::format("continues with {} changed since {}:{}", count, file, formats::changes_text(changes, "\n    ")));
}

void resume_checkpoint(Run& run, const std::string& file, Joining joining, ChangedValues changed) {
  const formats::Checkpoint checkpoint = formats::read_checkpoint(file);
  if (checkpoint.schedule.size() != Schedule(run.scene, run.built.model.breakpoints).memory().size())
    throw_of_another_scene(run, checkpoint, file);
  run.schedule_memory = checkpoint.schedule;
  State& state = run.built.state;
  const std::string own = fingerprint(run.built.model, state);
  if (checkpoint.state_version != State::version || checkpoint.state.size() != state.block().size() ||
      checkpoint.fingerprint != own)
    throw_of_another_scene(run, checkpoint, file);
  compare_scenes(run, file, checkpoint.values, changed);
  require_before_end(run.scene, checkpoint.time, file);
  state.block() = checkpoint.state;
  run.report.mobility = count_mobility(run.built.model, state, run.workspace.now);
  run.workspace.forget();
  run.report.notes.push_back(
      fmt::format("continues from {} at t = {:.9g}{}{}", file, checkpoint.time, after_time(run.scene.units),
                  checkpoint.producer == producer("mechanism")
                      ? ""
                      : fmt::format(", written by {}: results are equal within the tolerance, not bit for bit",
                                    checkpoint.producer)));
  if (joining == Joining::appended) begin_with(run, rows_until(checkpoint, file));
}

std::string values_of_results(const std::string& file) {
  const std::string text = formats::ResultsReader(file).layout().simulated.text;
  return text.empty() ? text : formats::values_of_text(text, file + ": /scene/text");
}

void resume_results(Run& run, const std::string& file, const std::optional<double>& at, Joining joining,
                    ChangedValues changed) {
  compare_scenes(run, file, values_of_results(file), changed);
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
  run.report.notes.push_back(
      fmt::format("continues from {} at t = {:.9g}{}", file, state.time(), after_time(run.scene.units)));
  if (joining == Joining::appended) begin_with(run, {file, sums.row + 1});
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
  for (const SuperelementUse& use : model.superelements)
    if (!use.companion_id.empty()) add(use.name + " " + use.companion_id);
  return sha.hex();
}

std::string checkpoint_path(const std::string& results) {
  return without_ending(results, {".results.h5", ".h5"}) + ".checkpoint.h5";
}

Checkpoints::Checkpoints(const formats::Scene& scene, const std::string& results, double time)
    : spec_(scene.checkpoint),
      scene_(scene.name),
      path_(checkpoint_path(results)),
      results_(fs::path(results).filename().string()),
      start_(scene.integrator.start),
      round_off_(instant_tolerance(scene.integrator.step, scene.integrator.end)) {
  set_next(time);
}

void Checkpoints::set_next(double time) {
  steps_ = 0;
  next_ = std::numeric_limits<double>::infinity();
  if (spec_.interval)
    next_ = start_ + *spec_.interval * (std::floor((time - start_ + round_off_) / *spec_.interval) + 1.0);
}

bool Checkpoints::due_after_step(double time) {
  ++steps_;
  return (spec_.every && steps_ >= *spec_.every) || time >= next_ - round_off_;
}

void Checkpoints::write(Run& run, const Schedule& schedule, Stepper& stepper, formats::ResultsWriter& results) {
  const State& state = run.built.state;
  const std::vector<std::string> off = run.automatic != nullptr ? run.automatic->off() : std::vector<std::string>{};
  results.flush();
  formats::write_checkpoint(
      path_, {scene_, producer("mechanism"), fingerprint(run.built.model, state), State::version, state.time(),
              results_, results.run(), results.rows(), state.block(), schedule.memory(), run.values, join(off, "\n")});
  written_ = true;
  stepper.forget(run.workspace);
  set_next(state.time());
}

void Checkpoints::discard() const {
  std::error_code ignored;
  if (written_) fs::remove(path_, ignored);
}

std::vector<std::string> effects_off(const std::string& named, const std::vector<EffectUse>& uses) {
  const std::string file = formats::existing_results(named);
  if (formats::is_checkpoint(file)) return lines_of(formats::read_checkpoint(file).off);
  const formats::ResultsLayout layout = formats::ResultsReader(file).layout();
  const auto deforms = [&layout](const std::string& body) {
    const auto modal = std::ranges::find(layout.modal_bodies, body) - layout.modal_bodies.begin();
    if (modal < std::ssize(layout.modal_bodies)) return layout.modal_offset[modal + 1] > layout.modal_offset[modal];
    return std::ranges::find(layout.superelements, body) != layout.superelements.end();
  };
  std::vector<std::string> off;
  for (const EffectUse& use : uses)
    if (!deforms(use.owner)) off.push_back(effect_name(use));
  return off;
}

RestartFile find_restart(const std::string& file) {
  RestartFile found{formats::existing_results(file), false, ""};
  found.checkpoint = formats::is_checkpoint(found.path);
  found.results =
      found.checkpoint ? results_of(formats::read_checkpoint(found.path), found.path) : final_name(found.path);
  return found;
}

void require_apart(const RestartFile& restart, const std::string& results) {
  const bool own_results = !restart.results.empty() && is_same_file(restart.results, results);
  const bool own_checkpoint = restart.checkpoint && is_same_file(restart.path, checkpoint_path(results));
  if (own_results || own_checkpoint)
    throw Error(
        fmt::format("would overwrite the run that it continues, {}", own_results ? restart.results : restart.path),
        results, "give -o another name, or store the rows of both runs in one file with --append");
}

void resume(Run& run, const std::string& named, const std::optional<double>& at, Joining joining,
            ChangedValues changed) {
  const std::string file = formats::existing_results(named);
  if (run.scene.analysis != formats::AnalysisKind::dynamics)
    throw Error("only dynamics can continue from a file", file, "name an analysis of `type: dynamics` with --analysis");
  if (run.scene.integrator.method == formats::Method::bdf)
    throw Error("method: bdf cannot continue from a file, because it starts with order 1", file,
                "use generalised_alpha or hht");
  const bool checkpoint = formats::is_checkpoint(file);
  if (checkpoint && at)
    throw Error(fmt::format("is a checkpoint, which holds only one instant: t = {:.9g}{} cannot be chosen", *at,
                            after_time(run.scene.units)),
                file, "omit --at, or give a results file");
  if (checkpoint)
    resume_checkpoint(run, file, joining, changed);
  else
    resume_results(run, file, at, joining, changed);
}

}  // namespace tisserand::mechanism
