// SPDX-License-Identifier: GPL-3.0-or-later
// Formulas of sections/shapes.hpp.
#include "formats/sections/shapes.hpp"

#include <algorithm>
#include <cmath>

namespace tisserand::formats {
namespace {

double tube_shear_factor(double m) {
  const double square = (1.0 + m * m) * (1.0 + m * m);
  return 6.0 * square / (7.0 * square + 20.0 * m * m);
}

/// Shear factor A_s/A for shear along the side `depth` of the middle line.
double box_shear_factor(double depth, double breadth) {
  const double n = breadth / depth, n3 = n * n * n;
  return 10.0 * (1.0 + 3.0 * n) * (1.0 + 3.0 * n) /
         (12.0 + 72.0 * n + 150.0 * n * n + 90.0 * n3 + 30.0 * n3 * (1.0 + n));
}

double rectangle_torsion_constant(double width, double height) {
  const double a = std::min(width, height), b = std::max(width, height);
  double sum = 0.0;
  for (int n = 401; n >= 1; n -= 2) sum += std::tanh(n * M_PI * b / (2.0 * a)) / std::pow(n, 5);
  return a * a * a * b / 3.0 * (1.0 - 192.0 / std::pow(M_PI, 5) * a / b * sum);
}

}  // namespace

Section circle_section(double radius) {
  Section section;
  section.area = M_PI * radius * radius;
  section.second_moment_y = section.second_moment_z = 0.25 * M_PI * std::pow(radius, 4);
  section.torsion_constant = section.polar_moment = 2.0 * section.second_moment_y;
  section.shear_area_y = section.shear_area_z = 6.0 / 7.0 * section.area;
  section.shape = "circle";
  section.sizes = {radius};
  return section;
}

Section hollow_circle_section(double radius, double thickness) {
  const double inner = radius - thickness;
  Section section;
  section.area = M_PI * thickness * (radius + inner);
  section.second_moment_y = section.second_moment_z = 0.25 * section.area * (radius * radius + inner * inner);
  section.torsion_constant = section.polar_moment = 2.0 * section.second_moment_y;
  section.shear_area_y = section.shear_area_z = tube_shear_factor(inner / radius) * section.area;
  section.shape = "hollow_circle";
  section.sizes = {radius, thickness};
  return section;
}

Section rectangle_section(double width, double height) {
  Section section;
  section.area = width * height;
  section.second_moment_y = section.area * height * height / 12.0;
  section.second_moment_z = section.area * width * width / 12.0;
  section.polar_moment = section.second_moment_y + section.second_moment_z;
  section.torsion_constant = rectangle_torsion_constant(width, height);
  section.shear_area_y = section.shear_area_z = 5.0 / 6.0 * section.area;
  section.shape = "rectangle";
  section.sizes = {width, height};
  return section;
}

Section hollow_rectangle_section(double width, double height, double thickness) {
  const double w = width - 2.0 * thickness, h = height - 2.0 * thickness;
  const double wm = width - thickness, hm = height - thickness;
  Section section;
  section.area = width * height - w * h;
  section.second_moment_y = (width * std::pow(height, 3) - w * std::pow(h, 3)) / 12.0;
  section.second_moment_z = (height * std::pow(width, 3) - h * std::pow(w, 3)) / 12.0;
  section.polar_moment = section.second_moment_y + section.second_moment_z;
  section.torsion_constant = 2.0 * thickness * wm * wm * hm * hm / (wm + hm);
  section.shear_area_y = box_shear_factor(wm, hm) * section.area;
  section.shear_area_z = box_shear_factor(hm, wm) * section.area;
  section.shape = "hollow_rectangle";
  section.sizes = {width, height, thickness};
  return section;
}

}  // namespace tisserand::formats
