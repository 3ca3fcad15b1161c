// SPDX-License-Identifier: GPL-3.0-or-later
// No heap allocation in the functions of the superelement body that a time step calls.
#include <string>

#include <gtest/gtest.h>

#include "tests/support/allocation_counter.hpp"
#include "tests/support/bodies/reduced_frames.hpp"
#include "tests/support/bodies/second_order_known_answers.hpp"
#include "tests/support/bodies/superelement_cases.hpp"

namespace tisserand::mechanism::superelement_allocation_test {
namespace {

/// Residual, tangent and elimination of two steps of different length.
std::size_t allocations(const SuperelementBody& body, const test_support::BodyState& state) {
  const Eigen::Vector3d gravity(0.7, -9.1, 2.0);
  SuperelementScratch scratch = make_scratch(body);
  SuperelementWork work = make_work(body);
  const Eigen::VectorXd dq_B = Eigen::VectorXd::Ones(body.boundary_size);
  Eigen::VectorXd dy_I(body.modes);
  double sum = 0.0;
  const std::size_t before = test_support::allocation_count();
  for (const double h : {0.01, 0.02}) {
    test_support::evaluate(body, state, gravity, scratch);
    tangent(body, {1.0 / (h * h), 1.0 / h, 1.0}, scratch, work);
    condense(body, scratch, work);
    expand(body, scratch, dq_B.data(), dy_I.data(), work);
    sum += energy(body, scratch, gravity).kinetic;
  }
  const std::size_t taken = test_support::allocation_count() - before;
  EXPECT_GT(sum, 0.0);
  return taken;
}

// All sizes of boundary (fixed-size and general kernels), three options, with and without damping, many modes included.
TEST(SuperelementStep, AllocatesNothing) {
  for (const std::string name : {"beam", "frame", "guyan", "mixed", "network"})
    for (const formats::InertiaOption inertia :
         {formats::InertiaOption::A, formats::InertiaOption::B, formats::InertiaOption::M})
      for (const double damping : {0.0, 0.2}) {
        const formats::Superelement element = test_support::test_superelement(name);
        SuperelementOptions options;
        options.inertia = inertia;
        options.damping = {.mass = damping, .stiffness = damping, .ratio = damping, .ratios = {}};
        const SuperelementBody body = build_superelement_body(element, formats::rigid_properties(element), options);
        EXPECT_EQ(allocations(body, test_support::random_state(body, 7, 0.1)), 0u) << name;
      }
}

// The same with terms of second order: stiffening on the inertia of M̄, and the inertia of all the mass.
TEST(SuperelementStep, AllocatesNothingWithTermsOfSecondOrder) {
  for (const std::string name : {"beam2", "lframe3"})
    for (const formats::InertiaOption inertia :
         {formats::InertiaOption::B, formats::InertiaOption::M, formats::InertiaOption::F}) {
      const test_support::SecondOrderAnswer answer = test_support::second_order_answer(name);
      const SuperelementBody body = test_support::second_order_body(answer, inertia, formats::StiffeningOption::full);
      EXPECT_EQ(allocations(body, test_support::second_order_state(answer, body)), 0u) << name;
    }
}

}  // namespace
}  // namespace tisserand::mechanism::superelement_allocation_test
