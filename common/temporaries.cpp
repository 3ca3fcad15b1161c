// SPDX-License-Identifier: GPL-3.0-or-later
// The set of temporary files of this process.
#include "common/temporaries.hpp"

#include <unistd.h>

#include <set>

namespace tisserand {
namespace {

struct Temporaries {
  std::recursive_mutex mutex;
  std::set<std::string> names;
  bool published = false;
};

Temporaries& temporaries() {
  static auto* const all = new Temporaries;  // never destroyed: threads may still use it at exit
  return *all;
}

}  // namespace

void note_temporary(const std::string& name) {
  const std::lock_guard lock(temporaries().mutex);
  temporaries().names.insert(name);
}

void forget_temporary(const std::string& name) {
  const std::lock_guard lock(temporaries().mutex);
  temporaries().names.erase(name);
}

std::unique_lock<std::recursive_mutex> publishing() {
  std::unique_lock lock(temporaries().mutex);
  temporaries().published = true;
  return lock;
}

bool remove_temporaries() {
  temporaries().mutex.lock();  // never unlocked
  for (const std::string& name : temporaries().names) ::unlink(name.c_str());
  return temporaries().published;
}

}  // namespace tisserand
