// SPDX-License-Identifier: GPL-3.0-or-later
// Norms of the difference of two histories.
#pragma once

namespace tisserand::formats {

enum class ErrorNorm { max, rms, final, peak, peak_time };

}  // namespace tisserand::formats
