// Files under temporary names, of which an interrupt leaves none.
#pragma once

#include <mutex>
#include <string>

namespace tisserand {

/// Remembers the name of a file that is not complete. Does not return once remove_temporaries() was called.
void note_temporary(const std::string& name);

/// Forgets a file that took its name or was removed.
void forget_temporary(const std::string& name);

/// Held while files take their names: several that belong together under one lock. Counts as published from then on.
std::unique_lock<std::recursive_mutex> publishing();

/// Waits for files that are taking their names, and removes all others; none can be noted or published afterwards.
/// Whether any was published before.
bool remove_temporaries();

}  // namespace tisserand
