// SPDX-License-Identifier: GPL-3.0-or-later
// Progress lines for terminals and log files.
#include "common/progress.hpp"

#include <unistd.h>

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "common/clock.hpp"

namespace tisserand {
namespace {

constexpr double first_after = 1.0;  // seconds
constexpr double on_terminal = 0.1;
constexpr double elsewhere = 10.0;

std::string duration(double seconds) {
  if (seconds < 100.0) return fmt::format("{:.0f} s", seconds);
  if (seconds < 6000.0) return fmt::format("{:.0f} min", seconds / 60.0);
  return fmt::format("{:.1f} h", seconds / 3600.0);
}

}  // namespace

ProgressOutput standard_progress() { return {stderr, ::isatty(::fileno(stderr)) == 1, wall_clock}; }

Progress::Progress(std::string name, double total) : Progress(std::move(name), total, standard_progress()) {}

Progress::Progress(std::string name, double total, ProgressOutput output)
    : name_(std::move(name)),
      total_(total),
      output_(std::move(output)),
      start_(output_.clock()),
      next_(start_ + first_after) {}

Progress::~Progress() {
  if (shown_ && !finished_ && output_.terminal) std::fputs("\r\x1b[K", output_.stream);
}

std::string Progress::line(double done, const std::string& text, double elapsed) const {
  const double part = total_ > 0.0 ? std::clamp(done / total_, 0.0, 1.0) : 0.0;
  std::string line = name_ + ": ";
  if (total_ > 0.0) line += fmt::format("{:.0f} %, ", 100.0 * part);
  if (!text.empty()) line += text + ", ";
  line += duration(elapsed) + " elapsed";
  if (part > 0.0) line += fmt::format(", {} to go", duration(elapsed * (1.0 - part) / part));
  return line;
}

void Progress::update(double done, const std::string& text) {
  const double now = output_.clock();
  if (finished_ || now < next_) return;
  next_ = now + (output_.terminal ? on_terminal : elsewhere);
  shown_ = true;
  const std::string reported = line(done, text, now - start_);
  if (output_.terminal) {
    std::fprintf(output_.stream, "\r%s\x1b[K", reported.c_str());
  } else {
    std::fprintf(output_.stream, "%s\n", reported.c_str());
  }
  std::fflush(output_.stream);
}

void Progress::finish() {
  if (finished_) return;
  finished_ = true;
  if (!shown_) return;
  if (output_.terminal) {
    std::fputs("\r\x1b[K", output_.stream);
  } else {
    std::fprintf(output_.stream, "%s: done in %s\n", name_.c_str(), duration(output_.clock() - start_).c_str());
  }
  std::fflush(output_.stream);
}

}  // namespace tisserand
