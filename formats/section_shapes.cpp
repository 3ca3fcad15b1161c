// Formulas of section_shapes.hpp.
#include "formats/section_shapes.hpp"

#include <cmath>

namespace tisserand::formats {

namespace {

/// ∫ over [0, 1] by Gauss-Legendre with 5 points on each of `pieces` equal parts.
template <class Function>
double integrate(const Function& f, int pieces) {
  constexpr double x1 = 0.53846931010568309, x2 = 0.90617984593866399;
  constexpr double w0 = 128.0 / 225.0, w1 = 0.47862867049936647, w2 = 0.23692688505618909;
  const double half = 0.5 / pieces;
  double sum = 0.0;
  for (int i = 0; i < pieces; ++i) {
    const double m = (2 * i + 1) * half;
    sum += half * (w0 * f(m) + w1 * (f(m - x1 * half) + f(m + x1 * half)) + w2 * (f(m - x2 * half) + f(m + x2 * half)));
  }
  return sum;
}

/// Shear area of a tube of outer radius 1 and inner radius m along a diameter, as a fraction of its area. Above z = m the
/// section is a circular segment, S = 2/3 cos³θ at z = sin θ; below, the inner segment is taken off.
double tube_shear_factor(double m) {
  constexpr int pieces = 400;
  const double from = std::asin(m), range = 0.5 * M_PI - from;
  const double outer = range * integrate([&](double u) { return 2.0 / 9.0 * std::pow(std::cos(from + range * u), 6); }, pieces);
  const double inner = 0.5 * M_PI * integrate([&](double u) {
    const double c = m * std::cos(0.5 * M_PI * u), s = m * std::sin(0.5 * M_PI * u);
    const double half_chord = std::sqrt(1.0 - s * s);
    const double moment = 2.0 / 3.0 * (half_chord * half_chord * half_chord - c * c * c);
    return moment * moment / (2.0 * (half_chord - c)) * c;
  }, pieces);
  const double second_moment = 0.25 * M_PI * (1.0 - std::pow(m, 4));
  return second_moment * second_moment / (2.0 * (outer + inner)) / (M_PI * (1.0 - m * m));
}

/// Shear area along the side `depth` of a rectangular tube, `breadth` being the other side; ∫ is over half the depth.
double box_shear_area(double depth, double breadth, double t) {
  const double h = 0.5 * depth, web = h - t, inertia = (breadth * std::pow(depth, 3) - (breadth - 2 * t) * std::pow(2 * web, 3)) / 12.0;
  const double at_web = 0.5 * breadth * (h * h - web * web);
  const double flange = t * integrate([&](double u) {
    const double z = web + t * u, moment = 0.5 * breadth * (h * h - z * z);
    return moment * moment / breadth;
  }, 1);
  const double webs = web * integrate([&](double u) {
    const double z = web * u, moment = at_web + t * (web * web - z * z);
    return moment * moment / (2.0 * t);
  }, 1);
  return inertia * inertia / (2.0 * (flange + webs));
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
  section.shear_area_y = section.shear_area_z = 0.9 * section.area;
  return section;
}

Section hollow_circle_section(double radius, double thickness) {
  const double inner = radius - thickness;
  Section section;
  section.area = M_PI * thickness * (radius + inner);
  section.second_moment_y = section.second_moment_z = 0.25 * section.area * (radius * radius + inner * inner);
  section.torsion_constant = section.polar_moment = 2.0 * section.second_moment_y;
  section.shear_area_y = section.shear_area_z = tube_shear_factor(inner / radius) * section.area;
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
  section.shear_area_y = box_shear_area(width, height, thickness);
  section.shear_area_z = box_shear_area(height, width, thickness);
  return section;
}

}  // namespace tisserand::formats
