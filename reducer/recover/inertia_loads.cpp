// From the motion of the floating frame to the loads on what the basis leaves out.
#include "reducer/recover/inertia_loads.hpp"

#include <algorithm>

#include "formats/recovery/load_factors.hpp"
#include "reducer/recover/stresses.hpp"

namespace tisserand::reducer {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double no_share = 1e-9;  ///< of loads in a mode: round-off

/// d²f/dt² by three instants that follow one another, not evenly perhaps; zero of fewer.
MatrixXd second_rates(const MatrixXd& f, const std::vector<double>& time) {
  MatrixXd rates = MatrixXd::Zero(f.rows(), f.cols());
  if (f.cols() < 3) return rates;
  for (Index t = 1; t + 1 < f.cols(); ++t) {
    const double before = time[static_cast<std::size_t>(t)] - time[static_cast<std::size_t>(t - 1)],
                 after = time[static_cast<std::size_t>(t + 1)] - time[static_cast<std::size_t>(t)];
    if (!(before > 0.0 && after > 0.0)) continue;
    rates.col(t) = 2.0 / (before + after) * ((f.col(t + 1) - f.col(t)) / after - (f.col(t) - f.col(t - 1)) / before);
  }
  rates.col(0) = rates.col(1);
  rates.col(f.cols() - 1) = rates.col(f.cols() - 2);
  return rates;
}

/// The largest stress of the mesh under each load with the factor 1.
VectorXd stress_of_loads(const formats::RecoveryReader& file, const BodyMotion& motion) {
  BodyMotion unit = motion;
  unit.y = unit.y_strain = MatrixXd::Zero(motion.y.rows(), formats::inertia_loads);
  unit.load_factor = MatrixXd::Identity(formats::inertia_loads, formats::inertia_loads);
  const RecoveredFields fields = recover_fields(file, unit, 0, formats::inertia_loads);
  VectorXd largest = VectorXd::Zero(formats::inertia_loads);
  for (const Eigen::MatrixXf* values : {&fields.beam_stress, &fields.shell_von_mises, &fields.solid_von_mises})
    if (values->rows() > 0) largest = largest.cwiseMax(values->cast<double>().colwise().maxCoeff().transpose());
  return largest;
}

/// ω² below which no mode is left out of the motion: of the file, or of the modes that the body of the scene dropped.
double lowest_left_out(const formats::Recovery& recovery, const BodyMotion& motion) {
  double lowest = recovery.loads->left_out;
  for (const Index k : motion.dropped)
    if (const double stiffness = recovery.loads->stiffness[k]; lowest == 0.0 || stiffness < lowest) lowest = stiffness;
  return lowest;
}

}  // namespace

void add_inertia_loads(const formats::Recovery& recovery, const formats::ResultsReader& results,
                       const std::vector<std::size_t>& rows, std::size_t row, BodyMotion& motion) {
  if (!recovery.loads) {
    motion.notes.push_back(
        "the recovery file has no answers to inertia loads: stress that the modes leave out is not added; reduce the "
        "part again with `recovery: yes` (method macneal has none)");
    return;
  }
  const formats::LoadFactors loads =
      formats::load_factors(recovery, results, rows, {row, motion.mirror, motion.origin, motion.to_scene});
  if (!loads.known()) {
    motion.notes.push_back(
        "the results do not hold the acceleration of the floating frame (written before version 1.10, or of an "
        "analysis "
        "without accelerations): stress that the modes leave out is not added; run the scene again");
    return;
  }
  motion.load_factor = loads.factor;
  motion.spin_squared = loads.spin_squared;
  const MatrixXd reach = recovery.loads->share.cwiseAbs() * motion.load_factor.cwiseAbs();  // n x T
  for (const Index k : formats::dropped_modes(recovery, motion.y)) {
    motion.y.row(k) = motion.y_strain.row(k) =
        recovery.loads->share.row(k) * motion.load_factor / recovery.loads->stiffness[k];
    // Modes out of the plane of a planar scene have no share in its loads but round-off.
    if (reach.row(k).maxCoeff() > no_share * reach.maxCoeff()) motion.dropped.push_back(k);
  }
}

LeftOutStress left_out_stress(const formats::RecoveryReader& file, const BodyMotion& motion) {
  LeftOutStress stress;
  if (motion.load_factor.cols() == 0) return stress;
  const VectorXd of_load = stress_of_loads(file, motion);
  stress.added = (of_load.transpose() * motion.load_factor.cwiseAbs()).maxCoeff();
  const double lowest = lowest_left_out(file.recovery(), motion);
  if (!(lowest > 0.0)) return stress;
  std::vector<double> time = motion.time;
  for (double& t : time) t /= motion.to_scene.time;
  const MatrixXd missing = second_rates(motion.load_factor, time).cwiseAbs() / lowest +
                           motion.load_factor.cwiseAbs() * (motion.spin_squared / lowest).asDiagonal();
  stress.remaining = (of_load.transpose() * missing).maxCoeff();
  return stress;
}

}  // namespace tisserand::reducer
