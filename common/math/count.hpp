// SPDX-License-Identifier: GPL-3.0-or-later
// Size of a container as `int`, the type of all indices of nodes, elements and coordinates.
#pragma once

namespace tisserand {

/// Number of entries of a container or of an Eigen vector. It fits in `int`, since readers limit the sizes they accept.
template <class Container>
constexpr int count_of(const Container& things) {
  return static_cast<int>(things.size());
}

}  // namespace tisserand
