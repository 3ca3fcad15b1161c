// SPDX-License-Identifier: GPL-3.0-or-later
// Loop of a follower over the calls of the leader.
#include "reducer/follow.hpp"

#include <optional>

#include "reducer/algebra/shared_factor.hpp"
#include "reducer/modes/search.hpp"
#include "reducer/system/assembly.hpp"

namespace tisserand::reducer {

void follow_leader(std::future<Mesh> made) {
  all_or_none([&] {
    std::optional<Mesh> mesh;
    FactorParts parts;
    for (Call call = next_call(); call.task != Task::end; call = next_call()) {
      switch (call.task) {
        case Task::assemble:
          if (!mesh) mesh = made.get();
          help_to_assemble(*mesh, call.count);
          break;
        case Task::search:
          help_to_search(*parts.at(call.factor).mumps);
          break;
        default:
          take_part(call, parts);
      }
    }
  });
}

}  // namespace tisserand::reducer
