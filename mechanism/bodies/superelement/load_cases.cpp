// Load cases of a companion on the coordinates of a body, and their power.
#include "mechanism/bodies/superelement/load_cases.hpp"

#include "common/math/rotation.hpp"

namespace tisserand::mechanism {

std::vector<BodyLoadCase> make_load_cases(const SuperelementBody& body, const formats::Companion& companion) {
  const Eigen::Index n = body.boundary_size + body.modes;
  const Eigen::MatrixXd R = rigid_columns(body);
  std::vector<BodyLoadCase> cases;
  for (const formats::LoadCase& from : companion.load_cases) {
    BodyLoadCase load;
    load.name = from.name;
    load.force = from.force.size() > 0 ? from.force : Eigen::VectorXd(Eigen::VectorXd::Zero(n));
    load.total = R.leftCols<3>().transpose() * load.force;
    load.moment = R.rightCols<3>().transpose() * load.force;
    load.arm.setZero(3, n);
    for (const SuperelementNode& node : body.node) {
      if (const int row = node.translation_row; row >= 0)
        load.arm.middleCols<3>(row) = -skew<double>(load.force.segment<3>(row));
      if (const int row = node.rotation_row; row >= 0)
        load.arm.middleCols<3>(row) = -0.5 * skew<double>(load.force.segment<3>(row));
    }
    if (from.stiffness.size() > 0) load.arm += R.rightCols<3>().transpose() * from.stiffness;
    if (body.second_order.stiffening) load.stiffness = from.stiffness;
    cases.push_back(std::move(load));
  }
  return cases;
}

double load_power(const SuperelementBody& body, const LocalMotion<double>& motion, const LoadTerms<double>& t) {
  const Eigen::Index nb = body.boundary_size;
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  // of x₀, axes of the frame
  for (const int j : body.translation_nodes) {
    const auto i = static_cast<std::size_t>(j);
    velocity += body.node[i].alpha * motion.node[i].xd;
  }
  return t.force.dot(velocity) + t.moment.dot(motion.Omega0) + t.g.head(nb).dot(motion.deformation_rate_B) +
         t.g.tail(body.modes).dot(motion.rate_I);
}

}  // namespace tisserand::mechanism
