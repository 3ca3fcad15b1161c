// SPDX-License-Identifier: GPL-3.0-or-later
// Second step of a Nastran deck: numbers from the fields of a card, with faults that name card, field and value.
#include "reducer/decks/nastran/fields.hpp"

#include <charconv>
#include <cmath>
#include <limits>

#include <fmt/format.h>

namespace tisserand::reducer {
namespace {

constexpr std::size_t longest_number = 40;
constexpr long largest_id = 2000000000;

std::string_view without_plus(std::string_view text) {
  if (text.size() > 1 && text[0] == '+' && text[1] != '-' && text[1] != '+') text.remove_prefix(1);
  return text;
}

/// Number of the whole text, as std::from_chars reads it.
std::optional<double> plain_real(std::string_view text) {
  double value = 0.0;
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (code != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

}  // namespace

std::optional<long> parse_integer(std::string_view text) {
  text = without_plus(text);
  if (text.empty() || text.size() > 18) return std::nullopt;
  long value = 0;
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (code != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

std::optional<double> parse_real(std::string_view text) {
  text = without_plus(text);
  if (text.empty() || text.size() > longest_number) return std::nullopt;
  if (const std::size_t blank = text.find(' '); blank != std::string_view::npos) {
    std::string without(text.substr(0, blank));
    const std::string_view exponent = text.substr(text.find_first_not_of(' ', blank));
    if (std::string_view("EeDd+-").find(exponent[0]) == std::string_view::npos) return std::nullopt;
    for (const char c : exponent)
      if (c != ' ') without += c;
    return parse_real(without);
  }
  const std::size_t mantissa_end = text.find_first_not_of("0123456789.", text[0] == '-' ? 1 : 0);
  if (mantissa_end == std::string_view::npos || text[mantissa_end] == 'E' || text[mantissa_end] == 'e')
    return plain_real(text);
  std::string_view exponent = text.substr(mantissa_end);
  if (mantissa_end == 0 || (exponent[0] != 'D' && exponent[0] != 'd' && exponent[0] != '+' && exponent[0] != '-'))
    return std::nullopt;
  if (exponent[0] == 'D' || exponent[0] == 'd') exponent.remove_prefix(1);
  std::string standard(text.substr(0, mantissa_end));
  standard += 'e';
  standard += exponent;
  return plain_real(standard);
}

bool is_real(std::string_view text) { return parse_real(text) && !parse_integer(text); }

std::optional<Components> parse_components(std::string_view text) {
  if (text == "0") return Components{0};
  Components result = 0;
  for (const char c : text) {
    if (c == ' ') continue;
    if (c < '1' || c > '6') return std::nullopt;
    const auto bit = static_cast<Components>(1u << (c - '1'));
    if ((result & bit) != 0) return std::nullopt;
    result = static_cast<Components>(result | bit);
  }
  return result;
}

void CardFields::fault(const std::string& what, const std::string& remedy) {
  ok_ = false;
  faults_->add(label() + ": " + what, where(), remedy);
}

void CardFields::field_fault(int index, std::string_view name, std::string_view what, std::string_view remedy) {
  if (!ok_) return;
  if (blank(index))
    fault(fmt::format("{} is blank", name), std::string(remedy));
  else
    fault(fmt::format("{} '{}' {}", name, text(index), what), std::string(remedy));
}

std::string CardFields::label() const {
  const std::string_view first = text(0);
  return first.empty() ? capitals(card_->name) : fmt::format("{} {}", capitals(card_->name), first);
}

long CardFields::id(int index, std::string_view name) {
  const std::optional<long> value = parse_integer(text(index));
  if (value && *value > 0 && *value <= largest_id) return *value;
  field_fault(index, name, value ? "is out of range" : "is not a whole number", "give a number from 1 to 2000000000");
  return 0;
}

long CardFields::id_or_none(int index, std::string_view name) {
  const long value = integer(index, name, 0);
  if (value >= 0) return value;
  field_fault(index, name, "must not be negative", "give a number >= 1 or leave the field blank");
  return 0;
}

long CardFields::integer(int index, std::string_view name, long if_blank) {
  if (blank(index)) return if_blank;
  const std::optional<long> value = parse_integer(text(index));
  if (value) return *value;
  field_fault(index, name, "is not a whole number", "give a number without decimal point and exponent");
  return if_blank;
}

double CardFields::real(int index, std::string_view name) {
  const std::optional<double> value = parse_real(text(index));
  if (value) return *value;
  field_fault(index, name, "is not a finite number", "give a number");
  return std::numeric_limits<double>::quiet_NaN();
}

double CardFields::real(int index, std::string_view name, double if_blank) {
  return blank(index) ? if_blank : real(index, name);
}

Components CardFields::components(int index, std::string_view name, Components if_blank) {
  if (blank(index)) return if_blank;
  const std::optional<Components> value = parse_components(text(index));
  if (value) return *value;
  field_fault(index, name, "does not name components", "give digits from 1 to 6, each once");
  return if_blank;
}

Eigen::Vector3d CardFields::vector(int index, std::string_view name) {
  Eigen::Vector3d result = Eigen::Vector3d::Zero();
  for (int i = 0; i < 3; ++i) {
    if (blank(index + i)) continue;
    const std::optional<double> value = parse_real(text(index + i));
    if (value)
      result(i) = *value;
    else
      field_fault(index + i, fmt::format("{}{}", name, i + 1), "is not a finite number", "give a number");
  }
  return result;
}

bool CardFields::thru(int index, std::string_view name, long& first, long& last) {
  first = id(index, name);
  last = id(index + 2, name);
  if (ok_ && last < first)
    fault(fmt::format("{} {} THRU {} counts down", name, first, last), "give the smaller number first");
  return ok_;
}

}  // namespace tisserand::reducer
