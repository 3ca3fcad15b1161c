// SPDX-License-Identifier: GPL-3.0-or-later
// Polynomials through the constants of sections.
#include "reducer/properties/beam_taper.hpp"

#include <array>

#include "formats/sections/profiles.hpp"

namespace tisserand::reducer {
namespace {

using formats::Section;

constexpr std::array<double Section::*, 16> interpolated{
    &Section::area,           &Section::second_moment_y, &Section::second_moment_z,  &Section::torsion_constant,
    &Section::polar_moment,   &Section::shear_area_y,    &Section::shear_area_z,     &Section::second_moment_yz,
    &Section::centroid_y,     &Section::centroid_z,      &Section::shear_center_y,   &Section::shear_center_z,
    &Section::shear_coupling, &Section::mass_per_length, &Section::rotary_inertia_y, &Section::rotary_inertia_z,
};

}  // namespace

std::vector<Section> taper_stations(const Section& first, const Section& second) {
  const bool of_points = first.shape == "polygon" || first.shape == "walls";  // sizes are corners, not dimensions
  const bool same_shape = !first.shape.empty() && first.shape == second.shape && !of_points;
  if (!same_shape || first.sizes.size() != second.sizes.size()) return {first, second};
  constexpr int count = 5;
  std::vector<Section> stations{first};
  for (int k = 1; k + 1 < count; ++k) {
    const double xi = static_cast<double>(k) / (count - 1);
    std::vector<double> sizes;
    for (std::size_t i = 0; i < first.sizes.size(); ++i)
      sizes.push_back((1.0 - xi) * first.sizes[i] + xi * second.sizes[i]);
    Section station = formats::shape_section(first.shape, sizes);
    station.centroid_y = (1.0 - xi) * first.centroid_y + xi * second.centroid_y;
    station.centroid_z = (1.0 - xi) * first.centroid_z + xi * second.centroid_z;
    stations.push_back(station);
  }
  stations.push_back(second);
  return stations;
}

std::vector<Section> stations_between(const std::vector<Section>& stations, double from, double to) {
  std::vector<Section> piece;
  const std::size_t last = stations.size() - 1;
  for (std::size_t k = 0; k <= last; ++k) {
    Section station = constants_at(stations, from + (to - from) * static_cast<double>(k) / static_cast<double>(last));
    station.name = stations[0].name;
    station.where = stations[0].where;
    piece.push_back(station);
  }
  return piece;
}

Section constants_at(const std::vector<Section>& stations, double xi) {
  Section result;
  result.by_stiffness = stations[0].by_stiffness;
  const std::size_t n = stations.size();
  const double place = xi * static_cast<double>(n - 1);
  for (std::size_t i = 0; i < n; ++i) {
    double weight = 1.0;
    for (std::size_t j = 0; j < n; ++j)
      if (j != i) weight *= (place - static_cast<double>(j)) / (static_cast<double>(i) - static_cast<double>(j));
    for (const auto constant : interpolated) result.*constant += weight * stations[i].*constant;
  }
  return result;
}

}  // namespace tisserand::reducer
