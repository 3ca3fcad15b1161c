// Boundary modes by one factorisation and blocked right-hand sides.
#include "reducer/boundary_modes.hpp"

#include <array>

#include <fmt/format.h>
#include <Eigen/QR>

#include "common/error.hpp"
#include "common/rotation.hpp"
#include "common/text.hpp"

namespace tisserand::reducer {
namespace {

/// Rigid motions about the mean of the nodes, rotations of unit edge displacement: entries of order 1 in translations.
Eigen::MatrixXd scaled_rigid_motions(const Mesh& mesh) {
  const Eigen::Vector3d mean = mesh.position.rowwise().mean();
  Eigen::MatrixXd R = rigid_motions(mesh);
  R.rightCols<3>() += R.leftCols<3>() * skew<double>(mean);
  R.rightCols<3>() /= characteristic_length(mesh);
  return R;
}

std::string direction_text(int component) {
  constexpr std::array<const char*, 6> words{"translation x", "translation y", "translation z",
                                             "rotation x",    "rotation y",    "rotation z"};
  return words[static_cast<std::size_t>(component)];
}

}  // namespace

void check_no_mechanism(const Factor& S_II, const Mesh& mesh, const Partition& p, const std::string& where) {
  if (S_II.null() == 0 && S_II.negative() == 0) return;
  if (S_II.null() == 0)
    throw Error(fmt::format("the stiffness of the inside has {} negative eigenvalues", S_II.negative()), where,
                "check the sections and materials: some stiffness is negative or vanishes beside the others");
  const Eigen::MatrixXd N = S_II.null_vectors();
  std::vector<std::string> motions;
  for (Eigen::Index k = 0; k < std::min<Eigen::Index>(N.cols(), 3); ++k) {
    std::vector<std::string> places;
    const double largest = N.col(k).cwiseAbs().maxCoeff();
    for (Eigen::Index i = 0; i < N.rows() && places.size() < 4; ++i)
      if (std::abs(N(i, k)) > 0.5 * largest)
        places.push_back(fmt::format("{} ({})", mesh.node_label[p.internal[i] / 6], direction_text(p.internal[i] % 6)));
    motions.push_back(join(places, ", "));
  }
  throw Error(fmt::format("the part has {} motion(s) without stiffness while its boundary is held: {}", S_II.null(),
                          join(motions, "; ")),
              where, "give the beams there stiffness in that direction, or hold these nodes at the boundary");
}

BoundaryModes boundary_modes(const Factor& S_II, const Blocks& blocks, const Mesh& mesh, const Partition& p) {
  BoundaryModes modes;
  modes.Psi.setZero(p.n_I(), p.n_B());
  if (p.n_I() == 0) return modes;
  modes.Psi = S_II.solve(-Eigen::MatrixXd(blocks.S_IB));
  const Eigen::MatrixXd R = scaled_rigid_motions(mesh);
  const Eigen::MatrixXd R_B = rows(R, p.boundary);
  const Eigen::MatrixXd defect = rows(R, p.internal) - modes.Psi * R_B;
  modes.rigid_defect = defect.cwiseAbs().maxCoeff();
  modes.Psi += defect * R_B.completeOrthogonalDecomposition().pseudoInverse();
  return modes;
}

}  // namespace tisserand::reducer
