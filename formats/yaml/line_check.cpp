// SPDX-License-Identifier: GPL-3.0-or-later
// Checks the geometry of lines, and whether a real body can have an inertia tensor.
#include "formats/yaml/line_check.hpp"

#include <algorithm>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

namespace tisserand::formats {
namespace {

constexpr double smallest_angle = 1e-8;  ///< smaller angles [rad] count as parallel in double precision

std::string text_of(const Eigen::Vector3d& v) { return fmt::format("({:g}, {:g}, {:g})", v.x(), v.y(), v.z()); }

bool parallel(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return a.stableNormalized().cross(b.stableNormalized()).norm() <= smallest_angle;
}

}  // namespace

void check_line(const LineToCheck& line, const Subject& subject) {
  const Eigen::Vector3d chord = line.to - line.from;
  if (!chord.allFinite()) return;
  const double scale = std::max(line.from.cwiseAbs().maxCoeff(), line.to.cwiseAbs().maxCoeff());
  if (chord.stableNorm() <= 1e-12 * scale) {
    subject.add("", fmt::format("has zero length: both ends are at {}", text_of(line.from)), "move one end");
    return;
  }
  if (line.through && line.through->allFinite() &&
      (parallel(*line.through - line.from, chord) || parallel(*line.through - line.to, chord)))
    subject.add("through",
                fmt::format("the point {} of the arc lies on the line through its ends", text_of(*line.through)),
                "move it off the line, or remove 'through' for a straight beam");
  if (!line.orientation || !line.orientation->allFinite()) return;
  if (line.orientation->stableNorm() == 0.0) {
    subject.add("orientation", "orientation has zero length", "give the direction of the local y axis");
  } else if (!line.through && parallel(*line.orientation, chord)) {
    subject.add("orientation", fmt::format("orientation {} is parallel to the beam", text_of(*line.orientation)),
                "give the direction of the local y axis, not parallel to the beam");
  }
}

void check_mass(double mass, const Eigen::Matrix3d& inertia, MassSign sign, const Subject& subject) {
  if (sign == MassSign::zero_allowed)
    subject.not_negative("mass", mass);
  else
    subject.positive("mass", mass);
  if (!subject.finite("inertia", inertia)) return;
  const double scale = inertia.cwiseAbs().maxCoeff();
  if (scale == 0.0) return;
  if ((inertia - inertia.transpose()).cwiseAbs().maxCoeff() > 1e-9 * scale) {
    subject.add("inertia", "inertia is not symmetric", "give a symmetric matrix");
    return;
  }
  const Eigen::Matrix3d scaled = inertia / scale;
  const Eigen::Vector3d principal =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(scaled, Eigen::EigenvaluesOnly).eigenvalues();
  constexpr double round_off = 1e-9, typed = 1e-3;
  const Eigen::Vector3d shown = scale * principal;
  if (principal[0] < -round_off) {
    subject.add("inertia", fmt::format("inertia has the negative principal moment {:g}", shown[0]),
                "check values, order and units");
  } else if (principal[2] > principal[0] + principal[1] + typed * principal[2]) {
    subject.add(
        "inertia",
        fmt::format(
            "the largest of the principal moments of inertia {:g}, {:g}, {:g} exceeds the sum of the other two, "
            "which is impossible for a body",
            shown[0], shown[1], shown[2]),
        "check values, order and units");
  }
}

std::string inertia_doubt(const std::string& subject, const Eigen::Matrix3d& inertia) {
  const Eigen::Vector3d principal =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(inertia, Eigen::EigenvaluesOnly).eigenvalues();
  const double excess = principal[2] - principal[0] - principal[1];
  if (!(excess > 1e-9 * principal[2])) return {};
  return fmt::format(
      "{}: the largest of the principal moments of inertia {:g}, {:g}, {:g} exceeds the sum of the other two "
      "by {:.2g} of its value. This is impossible for a body. The values are used as given",
      subject, principal[0], principal[1], principal[2], excess / principal[2]);
}

}  // namespace tisserand::formats
