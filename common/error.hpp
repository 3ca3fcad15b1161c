// The one exception of Tisserand: a fault of the input or of the world, told to the user once in main().
#pragma once

#include <exception>
#include <string>
#include <vector>

#include <fmt/format.h>

namespace tisserand {

/// The user's fault or the world's: what is wrong (quantity and value), where (file:line:column, dataset, node) and
/// what to do about it. Text form: "where: what; remedy".
class Error : public std::exception {
 public:
  Error(std::string what, std::string where, std::string remedy);

  const char* what() const noexcept override { return text_.c_str(); }
  const std::string& message() const noexcept { return message_; }
  const std::string& where() const noexcept { return where_; }
  const std::string& remedy() const noexcept { return remedy_; }

 private:
  std::string message_;
  std::string where_;
  std::string remedy_;
  std::string text_;
};

/// Several errors of one input, reported in one go: the text is one line per error.
Error merge_errors(const std::vector<Error>& errors);

/// Our fault: prints the text with file and line and aborts. Use through TISSERAND_ENSURE.
[[noreturn]] void ensure_failed(const char* condition, const char* file, int line, const std::string& values);

}  // namespace tisserand

/// An invariant of the program itself; `...` is a fmt format string with the values to print. On in every build.
#define TISSERAND_ENSURE(condition, ...)                                                      \
  do {                                                                                        \
    if (!(condition)) [[unlikely]]                                                            \
      ::tisserand::ensure_failed(#condition, __FILE__, __LINE__, ::fmt::format(__VA_ARGS__)); \
  } while (false)
