// SPDX-License-Identifier: GPL-3.0-or-later
// What an action throws, as text.
#pragma once

#include <functional>
#include <string>

#include "common/error.hpp"

namespace tisserand::test_support {

/// The text of the Error that `action` throws, or "no error".
inline std::string error_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

}  // namespace tisserand::test_support
