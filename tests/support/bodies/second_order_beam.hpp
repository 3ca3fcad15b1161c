// SPDX-License-Identifier: GPL-3.0-or-later
// A straight beam of Bernoulli elements with its companion: geometric stiffness with moments and shear.
#pragma once

#include <string>
#include <vector>

#include "tests/support/bodies/second_order_arrays.hpp"

namespace tisserand::test_support {

/// Stiffness and mass per length of a section; rotary inertia about its three axes.
struct SectionData {
  double EA = 0.0, GJ = 0.0;
  double EI_y = 0.0;  ///< bending in the x-z plane
  double EI_z = 0.0;  ///< bending in the x-y plane
  double mass = 0.0;
  double torsional_inertia = 0.0;
  double rotary_y = 0.0, rotary_z = 0.0;
};

/// Along x from the origin, `elements` of equal length; rows as of bent_frame().
struct BernoulliBeam {
  FullModel model;
  SectionData section;
  double element_length = 0.0;
};
BernoulliBeam bernoulli_beam(const SectionData& section, double length, int elements);

/// K_G of the stress of w: THEORY (82), four Gauss points.
Eigen::MatrixXd geometric_stiffness(const BernoulliBeam& beam, const Eigen::VectorXd& w);

/// Reduced to the nodes `kept` (indices, of all elements + 1) and `modes`, the weights equal.
SecondOrderBody second_order_beam(const BernoulliBeam& beam, const std::vector<int>& kept, int modes);

/// Adds a load case from its forces on all coordinates of the beam; `kept` as for the body.
void add_load_case(const BernoulliBeam& beam, const std::vector<int>& kept, const std::string& name,
                   const Eigen::VectorXd& load, SecondOrderBody& body);

}  // namespace tisserand::test_support
