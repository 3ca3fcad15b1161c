// SPDX-License-Identifier: GPL-3.0-or-later
// Text of off_axis_text().
#include "formats/sections/axis.hpp"

#include <cmath>

#include <fmt/format.h>

namespace tisserand::formats {

std::optional<std::string> off_axis_text(const Section& section) {
  constexpr double tolerance = 1e-9;
  const double Iyz = section.second_moment_yz;
  if (std::abs(Iyz) > tolerance * std::sqrt(std::abs(section.second_moment_y * section.second_moment_z)))
    return fmt::format("its axes are not principal axes (Iyz = {:g})", Iyz);
  const double radius = tolerance * std::sqrt(std::abs(section.area));
  if (std::hypot(section.centroid_y, section.centroid_z) > radius)
    return fmt::format("its centroid lies at [{:g}, {:g}], not on the axis of the beam", section.centroid_y,
                       section.centroid_z);
  if (std::hypot(section.shear_center_y, section.shear_center_z) > radius)
    return fmt::format("its shear centre lies at [{:g}, {:g}] from its centroid", section.shear_center_y,
                       section.shear_center_z);
  if (std::abs(section.shear_coupling) * section.area > tolerance)
    return fmt::format("its shear deformations along y and z are coupled (by c = {:g} per unit of area)",
                       section.shear_coupling);
  if (section.shape == "rod") return "it is a rod, which does not resist bending";
  return std::nullopt;
}

}  // namespace tisserand::formats
