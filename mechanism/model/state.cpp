// SPDX-License-Identifier: GPL-3.0-or-later
// Layout of the state block.
#include "mechanism/model/state.hpp"

namespace tisserand::mechanism {

State::State(const Sizes& sizes) : sizes_(sizes) {
  scalars_ = add("scalars", 13);
  x_ = add("x", 3 * sizes.nodes);
  Q_ = add("Q", 4 * sizes.nodes);
  w_ = add("w", sizes.modal);
  y_ = add("y", sizes.internal);
  v_ = add("v", sizes.velocities());
  vdot_ = add("vdot", sizes.velocities());
  a_ = add("algorithmic", sizes.velocities());
  lambda_ = add("lambda", sizes.constraints);
  frames_ = add("frames", 4 * sizes.superelements);
  hinges_ = add("hinges", sizes.hinges);
  active_ = add("active", sizes.constraints);
  block_.assign(static_cast<std::size_t>(active_ + sizes.constraints), 0.0);
  active().setOnes();
  Q().row(0).setOnes();
  frames().row(0).setOnes();
}

int State::add(const std::string& name, int size) {
  const int offset = fields_.empty() ? 0 : fields_.back().offset + fields_.back().size;
  fields_.push_back({name, offset, size});
  return offset;
}

}  // namespace tisserand::mechanism
