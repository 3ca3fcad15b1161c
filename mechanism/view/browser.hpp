// A page in headless Chromium: opened from a file, and asked for something.
#pragma once

#include <string>

namespace tisserand::mechanism {

/// Chromium's own sandbox, without which a faulty page has the rights of the user.
enum class Sandbox { on, off };

/// Opens `page`, a file of `mechanism view`, in a browser of its own without window, and evaluates `expression` there,
/// a promise or value of JavaScript that is a text. No request leaves the page (its policy). Throws Error: no browser
/// is installed, it does not start or answer, the page or the expression fails; root asks with its sandbox on.
std::string asked_of_page(const std::string& page, const std::string& expression, Sandbox sandbox);

}  // namespace tisserand::mechanism
