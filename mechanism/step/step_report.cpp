// SPDX-License-Identifier: GPL-3.0-or-later
// Text of a step report.
#include "mechanism/step/step_report.hpp"

#include <fmt/format.h>

namespace tisserand::mechanism {

std::string explain(const Model& model, const StepReport& report) {
  std::string place;
  if (report.outcome == StepOutcome::singular && report.singular_column >= 0)
    place = report.singular_column < model.sizes.boundary
                ? coordinate_name(model, report.singular_column)
                : constraint_name(model, report.singular_column - model.sizes.boundary);
  else if (report.worst_constraint >= 0)
    place = constraint_name(model, report.worst_constraint);
  else if (report.worst_coordinate >= 0)
    place = coordinate_name(model, report.worst_coordinate);
  switch (report.outcome) {
    case StepOutcome::accepted:
      return "accepted";
    case StepOutcome::inaccurate:
      return fmt::format("the local error is {:.2g} times the tolerance, worst at {}", report.error_ratio, place);
    case StepOutcome::singular:
      return fmt::format("the iteration matrix is singular{}{}", place.empty() ? "" : " at ", place);
    case StepOutcome::diverged:
      return fmt::format(
          "the iteration gives numbers that are not finite, first at {}: the step is too long for the motion, or a "
          "load is not finite",
          place);
    case StepOutcome::too_many_iterations:
      return fmt::format(
          "Newton's iteration does not converge, worst at {} (residual {:.1e} times the tolerance, constraint {:.1e} "
          "times): the step is too long, or the elements are too large for the rotation of their parts",
          place, report.force_ratio, report.constraint_ratio);
  }
  return {};
}

}  // namespace tisserand::mechanism
