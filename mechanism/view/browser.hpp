// SPDX-License-Identifier: GPL-3.0-or-later
// Evaluation of JavaScript in a page, opened in headless Chromium.
#pragma once

#include <string>

namespace tisserand::mechanism {

/// Whether Chromium's own sandbox is on. Without it a faulty page has the rights of the user.
enum class Sandbox { on, off };

/// Evaluates a JavaScript expression in a page of `mechanism view` and returns its value as text. `page`: path of the
/// page. `expression`: a value or a promise. The page opens in a separate browser without a window. Its policy allows
/// no network request. Throws Error if no browser is installed, it does not start or answer, the page or the expression
/// fails, or root uses the sandbox.
std::string asked_of_page(const std::string& page, const std::string& expression, Sandbox sandbox);

}  // namespace tisserand::mechanism
