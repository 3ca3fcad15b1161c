// Boundary modes by one factorisation and blocked right-hand sides.
#include "reducer/modes/boundary_modes.hpp"

#include <fmt/format.h>
#include <Eigen/QR>

#include "common/error.hpp"
#include "common/text.hpp"

namespace tisserand::reducer {
void check_no_mechanism(const Factor& S_II, const Mesh& mesh, const System& system, const Partition& p,
                        const std::string& where) {
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
        places.push_back(coordinate_name(mesh, system, system.T.source[p.internal[i]]));
    motions.push_back(join(places, ", "));
  }
  throw Error(fmt::format("the part has {} motion(s) without stiffness while its boundary is held: {}", S_II.null(),
                          join(motions, "; ")),
              where, "give the elements there stiffness in that direction, or hold these nodes at the boundary");
}

BoundaryModes boundary_modes(const Factor& S_II, const Blocks& blocks, const System& system, const Partition& p) {
  BoundaryModes modes;
  modes.Psi.setZero(p.n_I(), p.n_B());
  if (p.n_I() == 0) return modes;
  modes.Psi = S_II.solve(-Eigen::MatrixXd(blocks.S_IB));
  const Eigen::MatrixXd R_B = rows(system.R, p.boundary);
  const Eigen::MatrixXd defect = rows(system.R, p.internal) - modes.Psi * R_B;
  modes.rigid_defect = defect.cwiseAbs().maxCoeff();
  modes.Psi += defect * R_B.completeOrthogonalDecomposition().pseudoInverse();
  return modes;
}

}  // namespace tisserand::reducer
