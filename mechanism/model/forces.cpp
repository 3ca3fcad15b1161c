// SPDX-License-Identifier: GPL-3.0-or-later
// Maps of forces that have more rows than those of their nodes.
#include "mechanism/model/forces.hpp"

namespace tisserand::mechanism {

ElementMap force_map(const Model& model, const Tyre& tyre) {
  ElementMap map = carrier_map(model, {tyre.wheel.node});
  for (int k = 0; tyre.relaxes() && k < 2; ++k) map.coordinates.push_back(model.sizes.first_modal() + tyre.lag + k);
  return map;
}

ElementMap force_map(const Model& model, const PartLoad& load) {
  if (load.superelement < 0) return carrier_map(model, {load.node});
  return {model.superelements.maps[load.superelement].coordinates, {}, {}};
}

}  // namespace tisserand::mechanism
