// Beginning, samples and end of a window.
#include "mechanism/run/effect_windows.hpp"

#include <string>
#include <utility>

#include "mechanism/step/step_control.hpp"

namespace tisserand::mechanism {
namespace {

/// Samples of a window besides that of its beginning, where its steps allow.
constexpr int samples = 5;
/// Windows that become one where it must be seen how far forces grow.
constexpr double most_extended = 20.0;

}  // namespace

EffectWindows::EffectWindows(Run& run, StepLoop& loop, Stepper& stepper, RowWriter& out)
    : run_(run), loop_(loop), stepper_(stepper), out_(out) {
  if (run_.automatic) begin_window();
}

void EffectWindows::mark_beginning() {
  const State& state = run_.built.state;
  beginning_.emplace(Beginning{state, loop_, run_.report, run_.doubts, checkpoint_due_});
  next_sample_ = state.time() + run_.automatic->window() / samples;
  end_ = state.time() + run_.automatic->window();
}

void EffectWindows::begin_window() {
  run_.automatic->begin_window(run_);
  mark_beginning();
}

/// What nodes of the model that is left have turned is told while it is there.
template <class Switch>
void EffectWindows::tell_angles_if(Switch has_switched) {
  RunReport told;
  loop_.angles.tell(run_.built.model, told);
  if (!has_switched()) return;
  loop_.angles = FrameAngles(run_.built.model);
  for (std::string& note : told.notes) run_.report.notes.push_back(std::move(note));
  for (std::string& doubt : told.doubts) run_.report.doubts.push_back(std::move(doubt));
}

void EffectWindows::store(const StepReport& step, double size) {
  if (run_.automatic)
    waiting_.push_back({run_.built.state, step, size});
  else
    write_row(run_, step, size, out_);
}

void EffectWindows::flush() {
  if (waiting_.empty()) return;
  const State present = run_.built.state;
  for (const Waiting& row : waiting_) {
    run_.built.state.block() = row.state.block();
    write_row(run_, row.step, row.size, out_);
  }
  run_.built.state.block() = present.block();
  waiting_.clear();
}

void EffectWindows::repeat() {
  const long steps = run_.report.steps, iterations = run_.report.iterations;
  const long factorisations = run_.report.factorisations;
  run_.built.state.block() = beginning_->state.block();
  run_.report = beginning_->report;
  run_.doubts = beginning_->doubts;
  loop_ = beginning_->loop;
  run_.report.repeated += steps - run_.report.steps;
  run_.report.iterations = iterations;
  run_.report.factorisations = factorisations;
  std::optional<Waiting> first;  // of the instant at which the window begins, at the beginning of the run
  if (!waiting_.empty() && waiting_.front().state.time() == run_.built.state.time()) first = waiting_.front();
  waiting_.clear();
  checkpoint_due_ = beginning_->checkpoint_due;
  stepper_.forget(run_.workspace);
  tell_angles_if([this] { return run_.automatic->wake(run_); });
  if (first) waiting_.push_back({run_.built.state, first->step, first->size});
  mark_beginning();
}

void EffectWindows::end_window() {
  flush();
  bool switched = false;
  if (!loop_.schedule.finished(run_.built.state.time()))
    tell_angles_if([&] { return switched = run_.automatic->end_window(run_); });
  // A sleep may still be undone, to a state that no checkpoint knows: one that is due waits for the next window.
  if (checkpoint_due_ && !switched) loop_.checkpoints.write(run_, loop_.schedule, stepper_, out_.writer);
  checkpoint_due_ = checkpoint_due_ && switched;
  begin_window();
}

bool EffectWindows::after_step() {
  if (!run_.automatic) {
    loop_.checkpoints.after_step(run_, loop_.schedule, stepper_, out_.writer);
    return false;
  }
  const double time = run_.built.state.time();
  checkpoint_due_ = loop_.checkpoints.due_after_step(time) || checkpoint_due_;
  const double round_off = instant_tolerance(run_.scene.integrator.step, time);
  const bool last = loop_.schedule.finished(time), ends = time >= end_ - round_off || last;
  if (!ends && time < next_sample_ - round_off) return false;
  while (next_sample_ <= time + round_off) next_sample_ += run_.automatic->window() / samples;
  using Verdict = AutomaticEffects::Verdict;
  const Verdict verdict = run_.automatic->sample(run_);
  const bool enough = last || time - beginning_->state.time() >= most_extended * run_.automatic->window() - round_off;
  if (verdict == Verdict::matters || (verdict == Verdict::may_matter && enough)) {
    repeat();
    return true;
  }
  if (!ends) return false;
  if (verdict == Verdict::may_matter) {
    end_ += run_.automatic->window();
    run_.automatic->extend_window();
  } else {
    end_window();
  }
  return false;
}

}  // namespace tisserand::mechanism
