// Rates of a superelement's coordinates as its file numbers them, for output.
#pragma once

#include <Eigen/Core>

#include "mechanism/bodies/superelement/evaluate.hpp"

namespace tisserand::mechanism {

/// Rates of file_coordinates(). After update_kinematics() with the same nodes.
void file_rates(const SuperelementBody& body, SuperelementScratch& scratch, const NodeView<NodeMotion>& nodes,
                Eigen::Ref<Eigen::VectorXd> out);

}  // namespace tisserand::mechanism
