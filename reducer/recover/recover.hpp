// SPDX-License-Identifier: GPL-3.0-or-later
// `reducer recover`: displacement and stress of a part from the results of a run.
#pragma once

#include <string>

#include "reducer/recover/request.hpp"

namespace tisserand::reducer {

/// Writes the files that `request` asks for: the series of VTU files with its index, the envelope and the histories.
/// Returns the text to print. Throws Error.
std::string recover(const RecoverRequest& request);

}  // namespace tisserand::reducer
