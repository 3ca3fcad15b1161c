// SPDX-License-Identifier: GPL-3.0-or-later
// List of temporary files, which an interrupt removes.
#pragma once

#include <mutex>
#include <string>

namespace tisserand {

/// Registers an incomplete file, for removal by remove_temporaries(). After remove_temporaries() it blocks forever.
void note_temporary(const std::string& name);

/// Removes a file from the list of incomplete files, after it was renamed or deleted.
void forget_temporary(const std::string& name);

/// Lock that the caller must hold while files are renamed; one lock covers files that belong together. The call marks
/// the process as having published.
std::unique_lock<std::recursive_mutex> publishing();

/// Removes all registered incomplete files, after renames in progress have ended, and blocks later renames. Returns
/// whether any file was published before.
bool remove_temporaries();

}  // namespace tisserand
