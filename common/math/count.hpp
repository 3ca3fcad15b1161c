// Sizes as `int`, by which nodes, elements and coordinates are numbered.
#pragma once

namespace tisserand {

/// Number of entries of a container or of a vector of Eigen. Readers of files bound what they read.
template <class Container>
constexpr int count_of(const Container& things) {
  return static_cast<int>(things.size());
}

}  // namespace tisserand
