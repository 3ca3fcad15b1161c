// SPDX-License-Identifier: GPL-3.0-or-later
// List of temporary files, which an interrupt removes.
#pragma once

#include <mutex>
#include <string>

namespace tisserand {

/// Registers an incomplete file. Blocks forever after remove_temporaries().
void note_temporary(const std::string& name);

/// Removes a file from the list after it was renamed or deleted.
void forget_temporary(const std::string& name);

/// Lock to hold while files are renamed; one lock covers files that belong together. Marks the process as published.
std::unique_lock<std::recursive_mutex> publishing();

/// Removes all temporary files, after renames in progress have ended, and blocks later ones. Returns whether any file
/// was published before.
bool remove_temporaries();

}  // namespace tisserand
