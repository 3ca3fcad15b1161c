// SPDX-License-Identifier: GPL-3.0-or-later
// Text of section_report().
#include "formats/sections/report.hpp"

#include <cmath>

#include <fmt/format.h>

#include "formats/sections/monosymmetry.hpp"

namespace tisserand::formats {
namespace {

std::string line(const std::string& words, const std::string& symbol, double value, const std::string& unit) {
  // Adding 0.0 avoids a negative zero.
  return fmt::format("  {:<34} {:<6} {:>13.6g}{}\n", words, symbol, value + 0.0, after_number(unit));
}

std::string section_by_stiffness(const Section& s, const Units& units) {
  const std::string force = unit_label(units, 1, 1, -2), bending = unit_label(units, 3, 1, -2);
  std::string text = fmt::format("section '{}' (by stiffness)\n", s.name);
  text += line("axial stiffness", "EA", s.area, force);
  text += line("torsional stiffness", "GJ", s.torsion_constant, bending);
  text += line("bends in x-z", "EIy", s.second_moment_y, bending);
  text += line("bends in x-y", "EIz", s.second_moment_z, bending);
  text += line("shear stiffness along y", "GAy", s.shear_area_y, force);
  text += line("shear stiffness along z", "GAz", s.shear_area_z, force);
  text += line("mass per length", "", s.mass_per_length, unit_label(units, -1, 1, 0));
  text += line("rotary inertia per length, about y", "", s.rotary_inertia_y, unit_label(units, 1, 1, 0));
  return text + line("rotary inertia per length, about z", "", s.rotary_inertia_z, unit_label(units, 1, 1, 0));
}

/// Lines with Wagner's β, or the reason why it is unknown.
std::string monosymmetry_lines(const Section& s, const std::string& unit) {
  if (!third_moments(s)) return "  Wagner's beta: not known for a section that is given by constants\n";
  const Monosymmetry beta = known_monosymmetry(s);
  return line("Wagner's beta of moments about y", "beta_y", beta.beta_y, unit) +
         line("Wagner's beta of moments about z", "beta_z", beta.beta_z, unit);
}

std::string one_section(const Section& s, const Units& units) {
  if (s.by_stiffness) return section_by_stiffness(s, units);
  const auto unit = [&units](int power) { return unit_label(units, power, 0, 0); };
  std::string text = fmt::format("section '{}'{}\n", s.name, s.shape.empty() ? "" : " (" + s.shape + ")");
  text += line("area", "A", s.area, unit(2));
  text += line("torsion constant", "J", s.torsion_constant, unit(4));
  if (s.shape == "rod") return text;
  const PrincipalMoments principal = principal_moments(s);
  text += line("second moment, bends in x-z", "Iy", s.second_moment_y, unit(4));
  text += line("second moment, bends in x-y", "Iz", s.second_moment_z, unit(4));
  text += line("product of area", "Iyz", s.second_moment_yz, unit(4));
  text += line("larger principal second moment", "I1", principal.larger, unit(4));
  text += line("smaller principal second moment", "I2", principal.smaller, unit(4));
  text += line("angle from y to the axis of I1", "", principal.angle * 180.0 / M_PI, "deg");
  text += line("shear area along y, nu = 0", "A_sy", s.shear_area_y, unit(2));
  text += line("shear area along z, nu = 0", "A_sz", s.shear_area_z, unit(2));
  if (s.shear_coupling != 0.0) text += line("shear coupling of y and z, times A", "c A", s.shear_coupling * s.area, "");
  text += line("centroid from the axis of the beam", "y", s.centroid_y, unit(1));
  text += line("", "z", s.centroid_z, unit(1));
  text += line("shear centre from the centroid", "y", s.shear_center_y, unit(1));
  text += line("", "z", s.shear_center_z, unit(1));
  text += monosymmetry_lines(s, unit(1));
  if (s.warping_constant > 0.0) text += line("warping constant (not used)", "Cw", s.warping_constant, unit(6));
  return text;
}

}  // namespace

PrincipalMoments principal_moments(const Section& section) {
  const double mean = 0.5 * (section.second_moment_y + section.second_moment_z);
  const double half = 0.5 * (section.second_moment_y - section.second_moment_z);
  const double radius = std::hypot(half, section.second_moment_yz);
  // I(φ) = Iy cos²φ + Iz sin²φ − 2 Iyz sin φ cos φ about the axis rotated by φ from y.
  const double angle = radius > 0.0 ? 0.5 * std::atan2(-section.second_moment_yz, half) : 0.0;
  return {mean + radius, mean - radius, angle};
}

std::string section_report(const std::vector<Section>& sections, const Units& units) {
  std::string text;
  for (const Section& section : sections) text += (text.empty() ? "" : "\n") + one_section(section, units);
  return text;
}

}  // namespace tisserand::formats
