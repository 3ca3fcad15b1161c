// SPDX-License-Identifier: GPL-3.0-or-later
// Common numbering of all elements of a mesh (beams, shells, solids, springs).
#pragma once

#include "reducer/mesh/mesh.hpp"

namespace tisserand::reducer {

/// Calls work(element) for the element with the number `element`, and returns its result. Numbers count beams, then
/// shells, then solids, then springs of the mesh. The type of the result must not depend on the kind of element.
template <class Work>
auto with_element(const Mesh& mesh, int element, const Work& work) {
  auto k = static_cast<std::size_t>(element);
  if (k < mesh.beams.size()) return work(mesh.beams[k]);
  k -= mesh.beams.size();
  if (k < mesh.shells.size()) return work(mesh.shells[k]);
  k -= mesh.shells.size();
  if (k < mesh.solids.size()) return work(mesh.solids[k]);
  return work(mesh.springs[k - mesh.solids.size()]);
}

}  // namespace tisserand::reducer
