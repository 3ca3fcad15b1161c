// Modes of the linearised mechanism: frequencies, damping ratios and shapes about any state.
#pragma once

#include <complex>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "formats/results/results.hpp"
#include "formats/scene/scene.hpp"
#include "mechanism/analyses/linearise.hpp"

namespace tisserand::mechanism {

/// ξ(t) = Re(shape e^{λt}).
struct Mode {
  std::complex<double> eigenvalue;  ///< λ [1/time], Im λ ≥ 0; 0 of a rigid motion
  Eigen::VectorXcd shape;           ///< n: per node [δx; δθ] in world axes, then internal coordinates
  bool unstable = false;            ///< Re λ > 0 beyond round-off: it grows
  /// |λ|/2π in the other axes of the report; NaN of a motion that has two frequencies there, or 0 in both.
  double seen_from_other_axes = std::numeric_limits<double>::quiet_NaN();
  double frequency() const { return std::abs(eigenvalue) / (2.0 * std::numbers::pi); }
  double damping_ratio() const { return std::abs(eigenvalue) > 0.0 ? -eigenvalue.real() / std::abs(eigenvalue) : 0.0; }
};

struct ModesReport {
  std::vector<Mode> modes;            ///< ascending |λ|; the lowest `count`, and all that are unstable
  int degrees_of_freedom = 0;         ///< coordinates − rank of the constraints
  int rigid = 0;                      ///< modes with λ = 0
  double largest_acceleration = 0.0;  ///< |v̇| of the state relative to the axes; 0 if no inertia force of it is felt
  Eigen::Vector3d axes = Eigen::Vector3d::Zero();  ///< angular velocity of the axes of the modes
  Eigen::Vector3d spin = Eigen::Vector3d::Zero();  ///< of `spins` in these axes; with axes at rest, the other axes' own
  std::string spins;                               ///< the node that spins fastest in the axes; empty if none does
  std::string undecided;  ///< a body that spins whose internal coordinates are not in the axes (steady_axes.hpp)
  double change = 0.0;    ///< largest_change() of the coefficients (steady_axes.hpp); above 1e-3 modes are in doubt
};

/// Orthonormal basis of the null space of B (columns scaled with 1, or 1/length for rotations) by a rank-revealing QR:
/// n x (n − rank), in the coordinates of `linearise`.
Eigen::MatrixXd null_space(const Model& model, const Eigen::MatrixXd& B);

/// The modes of (λ² ZᵀMZ + λ ZᵀCZ + ZᵀKZ) η = 0, ξ = Z η, Z the null space of B. Directions without mass follow the
/// others quasi-statically. Internal coordinates of bodies that spin count in the axes of the modes (steady_axes.hpp).
/// Dense, O(n³): eigenvalues μ of the inverse (A − sE)⁻¹E of the first-order form, λ = s +
/// 1/μ, with a shift s > 0 of the size of the lowest frequency, so that low modes keep all their digits beside stiff
/// ones.
ModesReport solve_modes(const Model& model, const State& state, const formats::ModesSpec& spec, Evaluation& evaluation);

/// Shapes at the places that results report.
formats::ModesTable modes_table(const Model& model, const Evaluation& evaluation, const ModesReport& report);

/// One line per mode for people: number, frequency, damping ratio, where it moves most.
std::vector<std::string> modes_lines(const Model& model, const ModesReport& report);

}  // namespace tisserand::mechanism
