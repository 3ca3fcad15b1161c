// From frames of results to loads on what the basis of a superelement leaves out.
#include "formats/recovery/load_factors.hpp"

#include <Eigen/Geometry>

namespace tisserand::formats {
namespace {

using Eigen::Index;
using Eigen::Matrix3Xd;
using Eigen::MatrixXd;
using Eigen::Vector3d;

/// Three columns of a dataset over time, 3 x T; without columns where they are not stored.
Matrix3Xd vectors_of(const ResultsReader& results, const char* dataset, const std::vector<std::size_t>& rows,
                     std::size_t row) {
  const MatrixXd all = results.read_dataset(dataset, rows);
  const auto first = static_cast<Index>(3 * row);
  if (all.cols() < first + 3) return Matrix3Xd(3, 0);
  return all.middleCols<3>(first).transpose();
}

}  // namespace

Eigen::Matrix<double, inertia_loads, 1> inertia_factors(const Vector3d& a, const Vector3d& omega,
                                                        const Vector3d& omega_rate, const Vector3d& d) {
  Eigen::Matrix<double, inertia_loads, 1> f;
  f << -(a + omega_rate.cross(d) + omega.cross(omega.cross(d))), -omega_rate, omega.cwiseAbs2(),
      2.0 * omega.y() * omega.z(), 2.0 * omega.x() * omega.z(), 2.0 * omega.x() * omega.y();
  return f;
}

LoadFactors load_factors(const Recovery& recovery, const ResultsReader& results, const std::vector<std::size_t>& rows,
                         const LoadedBody& body) {
  LoadFactors loads;
  if (!recovery.loads) return loads;
  const Matrix3Xd a = vectors_of(results, "superelements/frame_acceleration", rows, body.row),
                  w = vectors_of(results, "superelements/frame_angular_velocity", rows, body.row),
                  wd = vectors_of(results, "superelements/frame_angular_acceleration", rows, body.row);
  const bool stored = a.cols() > 0 && w.cols() > 0 && wd.cols() > 0;
  if (!stored || !a.allFinite() || !w.allFinite() || !wd.allFinite() || !body.origin.allFinite()) return loads;
  const UnitConversion& to = body.to_scene;
  const double turning = body.mirror.prod();
  const Vector3d d = recovery.loads->reference_point - body.mirror.cwiseProduct(body.origin) / to.length;
  loads.factor.resize(inertia_loads, a.cols());
  for (Index t = 0; t < a.cols(); ++t)
    loads.factor.col(t) = inertia_factors(body.mirror.cwiseProduct(a.col(t)) * (to.time * to.time / to.length),
                                          turning * body.mirror.cwiseProduct(w.col(t)) * to.time,
                                          turning * body.mirror.cwiseProduct(wd.col(t)) * (to.time * to.time), d);
  loads.spin_squared = w.colwise().squaredNorm().transpose() * (to.time * to.time);
  return loads;
}

std::vector<Index> dropped_modes(const Recovery& recovery, const MatrixXd& y) {
  std::vector<Index> dropped;
  for (Index k = 0; k < y.rows(); ++k)
    if (recovery.dof_node[static_cast<std::size_t>(k)] < 0 && y.row(k).isZero(0.0)) dropped.push_back(k);
  return dropped;
}

}  // namespace tisserand::formats
