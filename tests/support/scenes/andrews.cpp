// SPDX-License-Identifier: GPL-3.0-or-later
// The squeezing mechanism's place at the start, its bodies, hinges, spring and motor.
#include "tests/support/scenes/andrews.hpp"

#include <cmath>

namespace tisserand::test_support {

formats::RigidBodySpec body_at(const std::string& name, double mass, const Eigen::Vector3d& center,
                               const Eigen::Vector3d& principal_inertia) {
  formats::RigidBodySpec body = rigid_body(name, mass, Eigen::Vector3d::Zero(), principal_inertia);
  body.start.pose.position = center;
  return body;
}

formats::Scene andrews(double step) {
  using M = Andrews;
  const auto c = [](double a) { return std::cos(a); };
  const auto s = [](double a) { return std::sin(a); };
  const std::array<Eigen::Vector3d, 7> center{
      Eigen::Vector3d(M::ra * c(M::be), M::ra * s(M::be), 0),
      Eigen::Vector3d(M::rr * c(M::be) - M::da * c(M::be + M::th), M::rr * s(M::be) - M::da * s(M::be + M::th), 0),
      M::B + Eigen::Vector3d(M::sa * s(M::ga) + M::sb * c(M::ga), -M::sa * c(M::ga) + M::sb * s(M::ga), 0),
      M::A + Eigen::Vector3d(M::zt * c(M::de) + (M::e - M::ea) * s(M::ph + M::de),
                             M::zt * s(M::de) - (M::e - M::ea) * c(M::ph + M::de), 0),
      M::A + Eigen::Vector3d(M::ta * c(M::de) - M::tb * s(M::de), M::ta * s(M::de) + M::tb * c(M::de), 0),
      M::A + Eigen::Vector3d(M::u * s(M::ep) + (M::zf - M::fa) * c(M::om + M::ep),
                             -M::u * c(M::ep) + (M::zf - M::fa) * s(M::om + M::ep), 0),
      M::A + Eigen::Vector3d(M::ua * s(M::ep) - M::ub * c(M::ep), -M::ua * c(M::ep) - M::ub * s(M::ep), 0)};
  const Eigen::Vector3d F(M::rr * c(M::be), M::rr * s(M::be), 0);
  const Eigen::Vector3d E = M::B + Eigen::Vector3d(M::ss * s(M::ga), -M::ss * c(M::ga), 0);
  const Eigen::Vector3d G = M::A + Eigen::Vector3d(M::zt * c(M::de), M::zt * s(M::de), 0);
  const Eigen::Vector3d H = M::A + Eigen::Vector3d(M::u * s(M::ep), -M::u * c(M::ep), 0);
  const Eigen::Vector3d D =
      M::B + Eigen::Vector3d(M::sc * s(M::ga) + M::sd * c(M::ga), -M::sc * c(M::ga) + M::sd * s(M::ga), 0);

  formats::Scene scene = empty_scene(step, 0.05);
  for (std::size_t i = 0; i < 7; ++i)
    scene.bodies.push_back(
        body_at("k" + std::to_string(i + 1), M::mass[i], center[i], Eigen::Vector3d::Constant(M::inertia[i])));
  const auto hinge = [&scene](const std::string& name, const std::string& a, const std::string& b,
                              const Eigen::Vector3d& p) {
    scene.joints.push_back(joint(name, formats::JointKind::revolute, a, b, p, Eigen::Vector3d::UnitZ()));
  };
  hinge("O", "ground", "k1", Eigen::Vector3d::Zero());
  hinge("F", "k1", "k2", F);
  hinge("E3", "k2", "k3", E);
  hinge("E4", "k2", "k4", E);
  hinge("E6", "k2", "k6", E);
  hinge("B", "ground", "k3", M::B);
  hinge("G", "k4", "k5", G);
  hinge("H", "k6", "k7", H);
  hinge("A5", "ground", "k5", M::A);
  hinge("A7", "ground", "k7", M::A);
  formats::SpringSpec spring;
  spring.name = "spring";
  spring.a.node = "ground";
  spring.a.position = M::C;
  spring.b.node = "k3";
  spring.b.position = D - center[2];
  spring.stiffness = 4530.0;
  spring.free = 0.07785;
  scene.springs.push_back(spring);
  scene.loads.push_back(constant_load("motor", formats::LoadKind::moment, "k1", {0, 0, 0.033}));
  return scene;
}

}  // namespace tisserand::test_support
