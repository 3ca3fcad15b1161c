// SPDX-License-Identifier: GPL-3.0-or-later
// The dense Newton iteration of the cantilever.
#include "tests/support/bodies/beam_statics.hpp"

#include <Eigen/LU>

#include "common/math/rotation.hpp"

namespace tisserand::mechanism::test {
namespace {

template <class Element>
void assemble(const std::vector<Element>& elements, const std::vector<NodeMotion>& nodes, const TangentCoefficients& c,
              Eigen::VectorXd& r, Eigen::MatrixXd& A) {
  constexpr int n = Element::dofs / 6;
  Eigen::Matrix<double, Element::dofs, 1> re;
  Eigen::Matrix<double, Element::dofs, Element::dofs> Ae;
  for (const Element& element : elements) {
    residual_and_tangent(element, nodes, Eigen::Vector3d::Zero(), c, re, Ae);
    for (int i = 0; i < n; ++i) {
      r.segment<6>(6 * element.nodes[i]) += re.template segment<6>(6 * i);
      for (int j = 0; j < n; ++j)
        A.block<6, 6>(6 * element.nodes[i], 6 * element.nodes[j]) += Ae.template block<6, 6>(6 * i, 6 * j);
    }
  }
}

}  // namespace

BeamMesh without_twist_elongation(BeamMesh mesh) {
  for (auto& element : mesh.elements2) element.polar_radius_squared = 0.0;
  for (auto& element : mesh.elements3) element.polar_radius_squared = 0.0;
  return mesh;
}

std::vector<NodeMotion> reference_nodes(const BeamMesh& mesh) {
  std::vector<NodeMotion> nodes(mesh.position.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) nodes[i].x = mesh.position[i];
  return nodes;
}

void assemble(const BeamMesh& mesh, const std::vector<NodeMotion>& nodes, const TangentCoefficients& c,
              Eigen::VectorXd& r, Eigen::MatrixXd& A) {
  const Eigen::Index n = 6 * static_cast<Eigen::Index>(nodes.size());
  r.setZero(n);
  A.setZero(n, n);
  assemble(mesh.elements2, nodes, c, r, A);
  assemble(mesh.elements3, nodes, c, r, A);
}

Cantilever bend_cantilever(const BeamMesh& mesh, const TipLoad& load, int load_steps, double tolerance) {
  Cantilever result;
  result.nodes = reference_nodes(mesh);
  Eigen::VectorXd r;
  Eigen::MatrixXd A;
  const Eigen::Index last = 6 * (static_cast<Eigen::Index>(result.nodes.size()) - 1);
  for (int step = 1; step <= load_steps; ++step) {
    const double factor = static_cast<double>(step) / load_steps;
    result.converged = false;
    for (result.iterations = 1; result.iterations <= 40 && !result.converged; ++result.iterations) {
      assemble(mesh, result.nodes, {.mass = 0, .damping = 0, .stiffness = 1}, r, A);
      const Eigen::Vector3d moment = result.nodes.back().R.transpose() * (factor * load.moment);
      r.segment<3>(last) -= factor * load.force;
      r.segment<3>(last + 3) -= moment;
      A.block<3, 3>(last + 3, last + 3) -= skew<double>(moment);
      const Eigen::VectorXd dq = A.bottomRightCorner(last, last).partialPivLu().solve(-r.tail(last));
      for (std::size_t i = 1; i < result.nodes.size(); ++i) {
        const Eigen::Index k = 6 * (static_cast<Eigen::Index>(i) - 1);
        result.nodes[i].x += dq.segment<3>(k);
        result.nodes[i].R = (result.nodes[i].R * exp_so3<double>(dq.segment<3>(k + 3))).eval();
      }
      result.last_step = dq.cwiseAbs().maxCoeff();
      result.converged = result.last_step < tolerance;
    }
  }
  return result;
}

}  // namespace tisserand::mechanism::test
