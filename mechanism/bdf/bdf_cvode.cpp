// SPDX-License-Identifier: GPL-3.0-or-later
// method: bdf by CVODE: vectors, callbacks, statistics.
#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunlinsol/sunlinsol_spgmr.h>
#include <sunmatrix/sunmatrix_dense.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "common/error.hpp"
#include "mechanism/bdf/bdf.hpp"
#include "mechanism/bdf/index1.hpp"
#include "mechanism/equations/evaluate.hpp"
#include "mechanism/step/accept.hpp"

namespace tisserand::mechanism {
namespace {

/// Largest size of dense Jacobians by differences.
constexpr int dense_limit = 400;
/// Tolerance of work and dissipation, which excludes them from the error control.
constexpr double no_say = 1e30;

/// Values of a vector that CVODE passes to a callback.
double* values_of(N_Vector vector) { return N_VGetArrayPointer(vector); }

}  // namespace

bool bdf_available() { return true; }

struct Bdf::Data {
  const Model& model;
  State& state;
  Workspace& workspace;
  Index1 equations;
  int size = 0;  ///< size of y, with work and dissipated energy at the end
  LoadWindow window;
  double now = 0.0;            ///< end of the last step
  std::exception_ptr failure;  ///< exception of a callback, which must not reach C code
  std::string message;         ///< last message of CVODE
  double constraint = 0.0;
  long row_choices = 0;
  BdfCounts past;  ///< counts before the last restart, at which CVODE resets its own
  SUNContext context = nullptr;
  N_Vector y = nullptr, tolerance = nullptr;
  SUNMatrix matrix = nullptr;
  SUNLinearSolver linear = nullptr;
  void* cvode = nullptr;

  Data(const formats::Scene& scene, const Model& m, State& s, Workspace& w)
      : model(m), state(s), workspace(w), equations(scene, m, s, w), size(equations.layout().size() + 2) {}
  ~Data() {
    if (cvode) CVodeFree(&cvode);
    if (linear) SUNLinSolFree(linear);
    if (matrix) SUNMatDestroy(matrix);
    if (y) N_VDestroy(y);
    if (tolerance) N_VDestroy(tolerance);
    if (context) SUNContext_Free(&context);
  }

  void create(const formats::Scene& scene);
  void pack(double* values) const {
    const FlatLayout& layout = equations.layout();
    std::copy_n(state.block().data() + layout.first, layout.size(), values);
    values[size - 2] = state.work();
    values[size - 1] = state.dissipated();
  }
  void unpack(double time, const double* values) {
    equations.load(time, window, values);
    state.work() = values[size - 2];
    state.dissipated() = values[size - 1];
  }
  /// Computes accelerations and multipliers at the state that the solver has reached.
  void complete() {
    equations.accelerate();
    equations.settle();
    constraint = equations.violation();
  }
  /// Chooses other constraint rows after a step of this size if the active ones become nearly dependent. The motion
  /// does not depend on the choice, so CVODE continues.
  void renew_rows(double step) {
    workspace.memory.rows.note_turn(model, step, state);
    if (!mechanism::renew_rows(model, state, workspace)) return;
    ++row_choices;
    complete();
  }
  /// Runs the action of a callback. Returns 0, or −1 (unrecoverable) and stores the exception.
  template <class Action>
  int guard(Action action) {
    try {
      return action();
    } catch (...) {
      failure = std::current_exception();
      return -1;
    }
  }
  long count(int (*read)(void*, long*)) const {
    long value = 0;
    read(cvode, &value);
    return value;
  }
};

struct BdfCallbacks {
  template <class Data>
  static int rates(realtype t, N_Vector y, N_Vector ydot, void* user) {
    auto& data = *static_cast<Data*>(user);
    return data.guard([&] {
      data.equations.load(t, data.window, values_of(y));
      if (!data.equations.try_accelerate()) return 1;  // recoverable: CVODE may try a shorter step
      data.equations.rates(values_of(y), values_of(ydot));
      values_of(ydot)[data.size - 2] = data.workspace.now.load_power;
      values_of(ydot)[data.size - 1] = damping_power(data.model, data.workspace.now);
      const bool finite = std::isfinite(data.state.vdot().sum()) && std::isfinite(data.workspace.now.load_power);
      return finite ? 0 : 1;
    });
  }
  template <class Data>
  static int project(realtype t, N_Vector y, N_Vector correction, realtype, N_Vector, void* user) {
    auto& data = *static_cast<Data*>(user);
    return data.guard([&] {
      data.equations.load(t, data.window, values_of(y));
      const bool done = data.equations.project();
      const FlatLayout& layout = data.equations.layout();
      const double* projected = data.state.block().data() + layout.first;
      for (int k = 0; k < layout.size(); ++k) values_of(correction)[k] = projected[k] - values_of(y)[k];
      values_of(correction)[data.size - 2] = values_of(correction)[data.size - 1] = 0.0;
      return done ? 0 : 1;
    });
  }
  template <class Data>
  static void note(int code, const char*, const char*, char* text, void* user) {
    if (code < 0) static_cast<Data*>(user)->message = text;
  }
};

void Bdf::Data::create(const formats::Scene& scene) {
  const formats::BdfSpec& spec = scene.integrator.bdf;
  const auto check = [](int flag) { TISSERAND_ENSURE(flag == CV_SUCCESS, "CVODE flag {}", flag); };
  check(SUNContext_Create(nullptr, &context));
  y = N_VNew_Serial(size, context);
  tolerance = N_VNew_Serial(size, context);
  equations.tolerances(values_of(tolerance));
  values_of(tolerance)[size - 2] = values_of(tolerance)[size - 1] = no_say;
  pack(values_of(y));
  cvode = CVodeCreate(CV_BDF, context);
  check(CVodeInit(cvode, BdfCallbacks::rates<Data>, state.time(), y));
  check(CVodeSetUserData(cvode, this));
  check(CVodeSetErrHandlerFn(cvode, BdfCallbacks::note<Data>, this));
  check(CVodeSVtolerances(cvode, spec.relative_tolerance, tolerance));
  if (size <= dense_limit) {
    matrix = SUNDenseMatrix(size, size, context);
    linear = SUNLinSol_Dense(y, matrix, context);
  } else {
    linear = SUNLinSol_SPGMR(y, SUN_PREC_NONE, 0, context);
  }
  check(CVodeSetLinearSolver(cvode, linear, matrix));
  check(CVodeSetProjFn(cvode, BdfCallbacks::project<Data>));
  check(CVodeSetProjErrEst(cvode, SUNFALSE));
  if (scene.integrator.step > 0.0) check(CVodeSetInitStep(cvode, scene.integrator.step));
}

Bdf::Bdf(const formats::Scene& scene, const Model& model, State& state, Workspace& workspace)
    : data_(std::make_unique<Data>(scene, model, state, workspace)) {
  constexpr double ever = std::numeric_limits<double>::infinity();
  data_->now = state.time();
  data_->window = {state.time(), ever};
  data_->complete();
  data_->create(scene);
}

Bdf::~Bdf() = default;

std::string Bdf::step(const StepEnd& stop) {
  data_->window.to = stop.load_time;
  CVodeSetStopTime(data_->cvode, stop.time);
  realtype reached = data_->now;
  const int flag = CVode(data_->cvode, stop.time, data_->y, &reached, CV_ONE_STEP);
  if (data_->failure) std::rethrow_exception(std::exchange(data_->failure, nullptr));
  if (flag < 0) return fmt::format("CVODE failed: {}", data_->message);
  const double size = reached - std::exchange(data_->now, reached);
  data_->unpack(reached, values_of(data_->y));
  data_->complete();
  data_->renew_rows(size);
  return {};
}

void Bdf::go_to(double time) {
  if (time >= data_->now) {
    data_->unpack(data_->now, values_of(data_->y));
  } else {
    N_Vector at = N_VClone(data_->y);
    const int flag = CVodeGetDky(data_->cvode, time, 0, at);
    TISSERAND_ENSURE(flag == CV_SUCCESS, "CVODE flag {}", flag);
    data_->unpack(time, values_of(at));
    N_VDestroy(at);
    data_->equations.project();
  }
  data_->complete();
}

void Bdf::restart(double load_from) {
  data_->past = counts();
  data_->window.from = load_from;
  data_->window.to = std::numeric_limits<double>::infinity();
  data_->pack(values_of(data_->y));
  const int flag = CVodeReInit(data_->cvode, data_->now, data_->y);
  TISSERAND_ENSURE(flag == CV_SUCCESS, "CVODE flag {}", flag);
  data_->unpack(data_->now, values_of(data_->y));
  data_->complete();
}

double Bdf::violation() const { return data_->constraint; }

BdfCounts Bdf::counts() const {
  BdfCounts counts = data_->past;
  counts.steps += data_->count(CVodeGetNumSteps);
  counts.iterations += data_->count(CVodeGetNumNonlinSolvIters);
  counts.error_failures += data_->count(CVodeGetNumErrTestFails);
  counts.convergence_failures += data_->count(CVodeGetNumNonlinSolvConvFails);
  counts.evaluations = data_->equations.evaluations();
  counts.factorisations = data_->equations.factorisations();
  counts.row_choices = data_->row_choices;
  CVodeGetLastOrder(data_->cvode, &counts.order);
  return counts;
}

}  // namespace tisserand::mechanism
