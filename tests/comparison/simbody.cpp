// SPDX-License-Identifier: GPL-3.0-or-later
// One mechanism by Simbody (M. A. Sherman, A. Seth, S. L. Delp, Simbody: multibody dynamics for biomedical research,
// Procedia IUTAM 2 (2011) 241-261): accelerations and reactions at the start. C++17, the last that its headers know.
#include "tests/comparison/simbody.hpp"

#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include <Simbody.h>

namespace tisserand::comparison {
namespace {

using SimTK::Constraint;
using SimTK::MobilizedBody;
using SimTK::SpatialVec;
using SimTK::Transform;
using SimTK::UnitVec3;
using SimTK::Vec3;
using test_support::Frame;
using test_support::RandomBody;
using test_support::RandomJoint;
using test_support::RandomMechanism;
using test_support::StartOfMotion;
using test_support::Wrench;

Vec3 to_vec3(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }
Eigen::Vector3d from_vec3(const Vec3& v) { return {v[0], v[1], v[2]}; }
SimTK::Rotation to_rotation(const Eigen::Matrix3d& R) {
  return SimTK::Rotation(SimTK::Mat33(R(0, 0), R(0, 1), R(0, 2), R(1, 0), R(1, 1), R(1, 2), R(2, 0), R(2, 1), R(2, 2)),
                         true);
}
Transform to_transform(const Frame& f) { return {to_rotation(f.R), to_vec3(f.p)}; }
UnitVec3 axis(const Frame& f, int k) { return UnitVec3(to_vec3(f.R.col(k))); }

SimTK::MassProperties mass_of(const RandomBody& body) {
  const Eigen::Matrix3d& I = body.inertia;
  const SimTK::Inertia central(I(0, 0), I(1, 1), I(2, 2), I(0, 1), I(0, 2), I(1, 2));
  const Vec3 center = to_vec3(body.center);
  return {body.mass, center, central.shiftFromMassCenter(center, body.mass)};
}

/// Frames whose x axis is the z axis of the joint.
Frame slider_frame(const Frame& f) {
  Frame turned = f;
  turned.R.col(0) = f.R.col(2);
  turned.R.col(1) = f.R.col(0);
  turned.R.col(2) = f.R.col(1);
  return turned;
}

/// A mechanism in Simbody: mobilisers where it has them, constraints between free bodies and across loops.
class Model {
 public:
  explicit Model(const RandomMechanism& mechanism)
      : m_(mechanism), matter_(system_), forces_(system_), gravity_(forces_, matter_, to_vec3(m_.gravity)) {
    for (std::size_t i = 0; i < m_.joints.size(); ++i) m_.joints[i].closes_loop ? constrain(i) : grow(i);
    for (const test_support::RandomSpring& s : m_.springs) {
      SimTK::Force::TwoPointLinearSpring(forces_, body(s.a), to_vec3(s.at_a), body(s.b), to_vec3(s.at_b), s.stiffness,
                                         s.free);
      SimTK::Force::TwoPointLinearDamper(forces_, body(s.a), to_vec3(s.at_a), body(s.b), to_vec3(s.at_b), s.damping);
    }
    for (const test_support::RandomGear& gear : m_.gears) add_gear(gear);
    for (const test_support::RandomDrive& drive : m_.drives) add_drive(drive);
    state_ = system_.realizeTopology();
    system_.realizeModel(state_);
    set_state();
    system_.realize(state_, SimTK::Stage::Acceleration);
  }

  /// Reactions are those of mechanism: what drives and gears exert along the coordinate of a joint is no part of them.
  StartOfMotion start() {
    StartOfMotion start;
    for (std::size_t i = 0; i < m_.bodies.size(); ++i) {
      const MobilizedBody& one = body(static_cast<int>(i));
      start.bodies.push_back(
          {from_vec3(one.getBodyOriginAcceleration(state_)), from_vec3(one.getBodyAngularAcceleration(state_))});
    }
    SimTK::Vector_<SpatialVec> mobilisers;
    matter_.calcMobilizerReactionForces(state_, mobilisers);
    for (std::size_t i = 0; i < m_.joints.size(); ++i) start.joints.push_back(wrench_of(i, mobilisers));
    for (const test_support::RandomSpring& s : m_.springs) start.springs.push_back(spring_force(s));
    for (std::size_t i = 0; i < m_.gears.size(); ++i) {
      const double second = -gears_[i].getMultipliersAsVector(state_)[0];
      start.gears.push_back({-m_.gears[i].ratio * second, second});
      take_away(m_.gears[i].first, start.gears[i][0], start);
      take_away(m_.gears[i].second, start.gears[i][1], start);
    }
    for (std::size_t i = 0; i < m_.drives.size(); ++i) {
      start.drives.push_back(-drives_[i].getMultipliersAsVector(state_)[0]);
      take_away(m_.drives[i].joint, start.drives[i], start);
    }
    return start;
  }

 private:
  MobilizedBody& body(int i) { return i < 0 ? matter_.updGround() : matter_.updMobilizedBody(index_.at(i)); }

  void grow(std::size_t number) {
    const RandomJoint& joint = m_.joints[number];
    const std::string word = test_support::word_of(joint);
    MobilizedBody& parent = body(joint.a);
    const SimTK::Body::Rigid rigid(mass_of(m_.bodies[joint.b]));
    const Transform a = to_transform(joint.in_a), b = to_transform(joint.in_b);
    const auto hang = [&](const MobilizedBody& mobiliser) { index_[joint.b] = mobiliser.getMobilizedBodyIndex(); };
    if (word == "fixed") return hang(MobilizedBody::Weld(parent, a, rigid, b));
    if (word == "revolute") return hang(MobilizedBody::Pin(parent, a, rigid, b));
    if (word == "spherical") return hang(MobilizedBody::Ball(parent, a, rigid, b));
    if (word == "universal") return hang(MobilizedBody::Universal(parent, a, rigid, b));
    if (word == "cylindrical") return hang(MobilizedBody::Cylinder(parent, a, rigid, b));
    if (word == "screw") return hang(MobilizedBody::Screw(parent, a, rigid, b, joint.pitch / (2.0 * SimTK::Pi)));
    if (word == "prismatic")
      return hang(MobilizedBody::Slider(parent, to_transform(slider_frame(joint.in_a)), rigid,
                                        to_transform(slider_frame(joint.in_b))));
    if (word == "planar") return hang(MobilizedBody::Planar(parent, a, rigid, b));
    if (word == "constant_orientation") return hang(MobilizedBody::Translation(parent, a, rigid, b));
    hang(MobilizedBody::Free(parent, a, rigid, b));
    constrain(number);
  }

  void constrain(std::size_t number) {
    const RandomJoint& joint = m_.joints[number];
    const std::string word = test_support::word_of(joint);
    MobilizedBody &a = body(joint.a), &b = body(joint.b);
    const Frame &A = joint.in_a, &B = joint.in_b;
    std::vector<Constraint>& parts = constraints_[number];
    const auto together = [&] { parts.push_back(Constraint::Ball(a, to_vec3(A.p), b, to_vec3(B.p))); };
    const auto normal = [&](int i, int j) { parts.push_back(Constraint::ConstantAngle(a, axis(A, i), b, axis(B, j))); };
    const auto on_line = [&] {
      parts.push_back(Constraint::PointOnLine(a, axis(A, 2), to_vec3(A.p), b, to_vec3(B.p)));
    };
    const auto in_plane = [&] {
      parts.push_back(Constraint::PointInPlane(a, axis(A, 2), A.R.col(2).dot(A.p), b, to_vec3(B.p)));
    };
    const auto along_z = [&] { normal(0, 2), normal(1, 2); };
    const auto no_turn = [&] {
      parts.push_back(Constraint::ConstantOrientation(a, to_rotation(A.R), b, to_rotation(B.R)));
    };
    if (word == "fixed") {
      parts.push_back(Constraint::Weld(a, to_transform(A), b, to_transform(B)));
    } else if (word == "revolute") {
      together(), along_z();
    } else if (word == "spherical") {
      together();
    } else if (word == "universal") {
      together(), normal(0, 1);
    } else if (word == "cylindrical") {
      on_line(), along_z();
    } else if (word == "prismatic") {
      on_line(), no_turn();
    } else if (word == "planar") {
      in_plane(), along_z();
    } else if (word == "point_on_line") {
      on_line();
    } else if (word == "point_on_plane") {
      in_plane();
    } else if (word == "distance") {
      const auto place = [&](int i, const Frame& f) { return i < 0 ? f.p : (m_.bodies[i].pose * f).p; };
      parts.push_back(
          Constraint::Rod(a, to_vec3(A.p), b, to_vec3(B.p), (place(joint.b, B) - place(joint.a, A)).norm()));
    } else if (word == "constant_orientation") {
      no_turn();
    } else if (word == "parallel_axes") {
      along_z();
    } else {
      throw std::logic_error("Simbody lacks joints of kind " + word);
    }
  }

  /// The coordinate z of a cylinder is its second; all others that are used are the first.
  void add_gear(const test_support::RandomGear& gear) {
    const RandomJoint &first = m_.joints[gear.first], &second = m_.joints[gear.second];
    SimTK::Vector factors(3);
    factors[0] = -gear.ratio;
    factors[1] = 1.0;
    factors[2] = gear.ratio * first.value - second.value;
    SimTK::Array_<SimTK::MobilizedBodyIndex> bodies{index_.at(first.b), index_.at(second.b)};
    SimTK::Array_<SimTK::MobilizerQIndex> coordinates(2, SimTK::MobilizerQIndex(0));
    gears_.push_back(Constraint::CoordinateCoupler(matter_, new SimTK::Function::Linear(factors), bodies, coordinates));
  }

  void add_drive(const test_support::RandomDrive& drive) {
    const RandomJoint& joint = m_.joints[drive.joint];
    SimTK::Vector factors(3);
    factors[0] = 0.5 * drive.acceleration;
    factors[1] = joint.rate;
    factors[2] = joint.value;
    drives_.push_back(Constraint::PrescribedMotion(matter_, new SimTK::Function::Polynomial(factors),
                                                   index_.at(joint.b), SimTK::MobilizerQIndex(0)));
  }

  void set_state() {
    for (const RandomJoint& joint : m_.joints) {
      if (joint.closes_loop) continue;
      const bool slider = test_support::word_of(joint) == "prismatic";
      const Frame A = slider ? slider_frame(joint.in_a) : joint.in_a,
                  B = slider ? slider_frame(joint.in_b) : joint.in_b;
      const Frame parent = joint.a < 0 ? Frame{} : m_.bodies[joint.a].pose, &child = m_.bodies[joint.b].pose;
      const Frame a = parent * A, b = child * B;
      const MobilizedBody& mobiliser = body(joint.b);
      mobiliser.setQToFitTransform(state_, to_transform(a.inverse() * b));
      Eigen::Vector3d v = m_.bodies[joint.b].velocity + m_.bodies[joint.b].omega.cross(b.p - child.p);
      Eigen::Vector3d omega = m_.bodies[joint.b].omega;
      if (joint.a >= 0) {
        v -= m_.bodies[joint.a].velocity + m_.bodies[joint.a].omega.cross(b.p - parent.p);
        omega -= m_.bodies[joint.a].omega;
      }
      system_.realize(state_, SimTK::Stage::Position);
      mobiliser.setUToFitVelocity(state_, SpatialVec(to_vec3(a.R.transpose() * omega), to_vec3(a.R.transpose() * v)));
    }
  }

  Wrench wrench_of(std::size_t number, const SimTK::Vector_<SpatialVec>& mobilisers) {
    const RandomJoint& joint = m_.joints[number];
    const auto found = constraints_.find(number);
    if (found == constraints_.end()) {
      const SpatialVec& at_M = mobilisers[index_.at(joint.b)];
      return {from_vec3(at_M[1]), from_vec3(at_M[0])};
    }
    const MobilizedBody& b = body(joint.b);
    Wrench sum{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
    for (const Constraint& part : found->second) {
      const SimTK::Vector_<SpatialVec> forces = part.getConstrainedBodyForcesAsVector(state_);
      for (SimTK::ConstrainedBodyIndex k(0); k < part.getNumConstrainedBodies(); ++k) {
        if (!part.getMobilizedBodyFromConstrainedBody(k).isSameMobilizedBody(b)) continue;
        sum.force -= from_vec3(forces[k][1]);  // as of multipliers: on the left side of the equations of motion
        sum.moment -= from_vec3(forces[k][0]);
      }
    }
    const Eigen::Vector3d arm = from_vec3(b.getBodyTransform(state_).R() * to_vec3(joint.in_b.p));
    sum.moment -= arm.cross(sum.force);
    return sum;
  }

  /// From the reaction of a joint what acts along its coordinate.
  void take_away(int joint, double force, StartOfMotion& start) const {
    const RandomJoint& j = m_.joints[joint];
    const Frame parent = j.a < 0 ? Frame{} : m_.bodies[j.a].pose;
    const Eigen::Vector3d z = (parent * j.in_a).R.col(2);
    (j.along ? start.joints[joint].force : start.joints[joint].moment) -= force * z;
  }

  double spring_force(const test_support::RandomSpring& s) {
    const MobilizedBody &a = body(s.a), &b = body(s.b);
    const Vec3 d =
        b.findStationLocationInGround(state_, to_vec3(s.at_b)) - a.findStationLocationInGround(state_, to_vec3(s.at_a));
    const Vec3 v =
        b.findStationVelocityInGround(state_, to_vec3(s.at_b)) - a.findStationVelocityInGround(state_, to_vec3(s.at_a));
    return -s.stiffness * (d.norm() - s.free) - s.damping * SimTK::dot(d, v) / d.norm();
  }

  const RandomMechanism& m_;
  SimTK::MultibodySystem system_;
  SimTK::SimbodyMatterSubsystem matter_;
  SimTK::GeneralForceSubsystem forces_;
  SimTK::Force::UniformGravity gravity_;
  SimTK::State state_;
  std::map<int, SimTK::MobilizedBodyIndex> index_;
  std::map<std::size_t, std::vector<Constraint>> constraints_;
  std::vector<Constraint> gears_, drives_;
};

}  // namespace

test_support::StartOfMotion start_by_simbody(const RandomMechanism& mechanism) { return Model(mechanism).start(); }

}  // namespace tisserand::comparison
