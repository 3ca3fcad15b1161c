// ẏ of the deformation, and its rows in the order of the file.
#include "mechanism/bodies/superelement/rates.hpp"

namespace tisserand::mechanism {

void file_rates(const SuperelementBody& body, SuperelementScratch& scratch, const NodeView<NodeMotion>& nodes,
                Eigen::Ref<Eigen::VectorXd> out) {
  LocalMotion<double>& motion = scratch.motion;
  if (!body.damping.active)  // otherwise update_kinematics() has done it
    deformation_rates(body, nodes, motion);
  for (std::size_t i = 0; i < body.file.boundary_row.size(); ++i)
    out[body.file.boundary_row[i]] = motion.deformation_rate_B[i];
  for (std::size_t k = 0; k < body.file.internal_row.size(); ++k) {
    const auto row = static_cast<Eigen::Index>(k);
    out[body.file.internal_row[k]] = body.file.static_part.row(row).dot(motion.deformation_rate_B) +
                                     body.file.modal_part.row(row).dot(motion.rate_I);
  }
}

}  // namespace tisserand::mechanism
