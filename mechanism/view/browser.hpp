// SPDX-License-Identifier: GPL-3.0-or-later
// Evaluation of JavaScript in a page, opened in headless Chromium.
#pragma once

#include <string>

namespace tisserand::mechanism {

/// Chromium's own sandbox. Without it a faulty page has the rights of the user.
enum class Sandbox { on, off };

/// Text to which `expression`, a promise or value of JavaScript, evaluates in `page`, a file of `mechanism view`. The
/// page opens in a separate browser without a window. Its policy allows no network request. Throws Error: no browser is
/// installed, it does not start or answer, the page or the expression fails, or root uses the sandbox.
std::string asked_of_page(const std::string& page, const std::string& expression, Sandbox sandbox);

}  // namespace tisserand::mechanism
