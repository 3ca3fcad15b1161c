// SPDX-License-Identifier: GPL-3.0-or-later
// Reads coefficients of the Magic Formula from the lines of a tyre property file.
#include "formats/tyres/tyre_property_file.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <optional>
#include <set>

#include "common/error.hpp"
#include "common/text.hpp"
#include "formats/tables/text_cells.hpp"
#include "formats/tyres/coefficients.hpp"

namespace tisserand::formats {
namespace {

/// Limit of the size of a file. Real property files are much smaller.
constexpr std::uintmax_t largest_file = 1 << 20;

/// Keys that describe the file.
constexpr std::string_view descriptions[] = {"FILE_TYPE",    "FILE_VERSION", "FILE_FORMAT", "PROPERTY_FILE_FORMAT",
                                             "FITTYP",       "USE_MODE",     "TYRESIDE",    "USER_SUB_ID",
                                             "N_TIRE_STATES"};

/// A line `KEY = value`.
struct Entry {
  std::string text;
  int line = 0;
};

struct PropertyLines {
  std::string path;
  std::map<std::string, Entry> entries;  ///< keys in capitals; those of [UNITS], where MASS is a unit, as "UNITS.MASS"
  std::vector<std::string> tables;       ///< sections with rows of numbers, for example [SHAPE]

  std::string at(const std::string& key) const {
    const auto entry = entries.find(key);
    return entry == entries.end() ? path : fmt::format("{}:{}", path, entry->second.line);
  }
  const Entry* find(const std::string& key) const {
    const auto entry = entries.find(key);
    return entry == entries.end() ? nullptr : &entry->second;
  }
  std::string word(const std::string& key) const {
    const Entry* entry = find(key);
    return entry == nullptr ? std::string() : entry->text;
  }
};

std::string capitals(std::string_view given) {
  std::string text(given);
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return text;
}

/// The line without its comment, which begins with $ or ! outside quotes.
std::string_view without_comment(std::string_view line) {
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '\'') quoted = !quoted;
    if (!quoted && (line[i] == '$' || line[i] == '!')) return line.substr(0, i);
  }
  return line;
}

std::optional<double> number_of(const std::string& text) {
  double value = 0.0;
  return read_finite(text, value) ? std::optional(value) : std::nullopt;
}

/// Whether an earlier line names the format or a unit.
bool is_tyre_file(const PropertyLines& file) {
  return file.entries.contains("PROPERTY_FILE_FORMAT") || file.entries.contains("FITTYP") ||
         std::ranges::any_of(file.entries, [](const auto& entry) { return entry.first.starts_with("UNITS."); });
}

void read_line(std::string_view text, int number, std::string& section, PropertyLines& file) {
  const std::string where = fmt::format("{}:{}", file.path, number);
  if (text.front() == '[') {
    if (text.back() != ']')
      throw Error(fmt::format("the name of the section '{}' does not end with ]", printable_line(text, 60)), where,
                  "write, for example, [MODEL]");
    section = capitals(trimmed(text.substr(1, text.size() - 2)));
    return;
  }
  if (text.front() == '{' || text.front() == '(') {  // heading of a table or of an Adams text block
    file.tables.push_back(section);
    return;
  }
  if (!file.tables.empty() && file.tables.back() == section) return;  // rows of the table
  const std::size_t equals = text.find('=');
  if (equals == std::string_view::npos) {
    const std::string quoted = is_tyre_file(file) ? fmt::format("'{}'", printable_line(text, 60)) : "the line";
    throw Error(fmt::format("{} does not have the form `KEY = value`", quoted), where,
                "give a tyre property file (.tir)");
  }
  const std::string key = (section == "UNITS" ? "UNITS." : "") + capitals(trimmed(text.substr(0, equals)));
  std::string_view value = trimmed(text.substr(equals + 1));
  if (value.size() >= 2 && value.front() == '\'' && value.back() == '\'') value = value.substr(1, value.size() - 2);
  if (!file.entries.emplace(key, Entry{std::string(trimmed(value)), number}).second)
    throw Error(fmt::format("{} is given twice (first in line {})", printable_line(key, 40), file.entries.at(key).line),
                where, "remove one");
}

PropertyLines read_lines(const std::string& path) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored))
    throw Error("there is no such tyre property file", path,
                "check the path, which is relative to the folder of the scene");
  if (std::filesystem::file_size(path, ignored) > largest_file)
    throw Error(fmt::format("has more than {} bytes, the limit of a tyre property file", largest_file), path,
                "give a .tir file of the Magic Formula");
  std::ifstream stream = open_table(path, "give a .tir file of the Magic Formula");
  PropertyLines file{path, {}, {}};
  std::string line, section;
  for (int number = 1; std::getline(stream, line); ++number)
    if (const std::string_view text = trimmed(without_comment(line)); !text.empty())
      read_line(text, number, section, file);
  return file;
}

/// Factor to SI of a unit that the file names, or 1 if it names none.
double unit_of(const PropertyLines& file, const std::string& name,
               const std::vector<std::pair<const char*, double>>& known) {
  const std::string key = "UNITS." + name;
  const Entry* entry = file.find(key);
  if (entry == nullptr) return 1.0;
  std::string word = capitals(entry->text);
  std::vector<std::string> words;
  for (const auto& [label, factor] : known) {
    if (word == label) return factor;
    words.emplace_back(label);
  }
  throw Error(fmt::format("unit '{}' of {} is not known", printable_line(entry->text, 40), name), file.at(key),
              "use one of " + join(words, ", "));
}

/// Factors that convert units of the file to units of the scene.
struct Conversion {
  double length = 1.0, force = 1.0, time = 1.0, pressure = 1.0;

  double of(Quantity dimension) const {
    switch (dimension) {
      case Quantity::number:
        return 1.0;
      case Quantity::length:
        return length;
      case Quantity::force:
        return force;
      case Quantity::stiffness:
        return force / length;
      case Quantity::damping:
        return force * time / length;
      case Quantity::speed:
        return length / time;
      case Quantity::pressure:
        return pressure;
    }
    return 1.0;
  }
};

Conversion conversion_of(const PropertyLines& file, const Units& units) {
  if (const Entry* angle = file.find("UNITS.ANGLE"); angle != nullptr && !capitals(angle->text).starts_with("RAD"))
    throw Error(fmt::format("angles are in '{}'", printable_line(angle->text, 40)), file.at("UNITS.ANGLE"),
                "give a file whose coefficients are per radian: ANGLE = 'radians'");
  Conversion to;
  to.length = unit_of(file, "LENGTH",
                      {{"METER", 1.0},
                       {"METRE", 1.0},
                       {"M", 1.0},
                       {"MM", 1e-3},
                       {"MILLIMETER", 1e-3},
                       {"CM", 1e-2},
                       {"KM", 1e3},
                       {"INCH", 0.0254},
                       {"IN", 0.0254},
                       {"FOOT", 0.3048},
                       {"FT", 0.3048}});
  to.force = unit_of(file, "FORCE",
                     {{"NEWTON", 1.0},
                      {"N", 1.0},
                      {"KN", 1e3},
                      {"KILONEWTON", 1e3},
                      {"POUND_FORCE", 4.4482216152605},
                      {"LBF", 4.4482216152605},
                      {"KG_FORCE", 9.80665}});
  to.time = unit_of(file, "TIME", {{"SECOND", 1.0}, {"SEC", 1.0}, {"S", 1.0}, {"MILLISECOND", 1e-3}, {"MS", 1e-3}});
  to.pressure =
      unit_of(file, "PRESSURE", {{"PASCAL", 1.0}, {"PA", 1.0}, {"KPA", 1e3}, {"BAR", 1e5}, {"PSI", 6894.757293168}});
  if (!units.named()) return to;
  const double length = units.length.factor, time = units.time.factor, mass = units.mass.factor;
  const double force = mass * length / (time * time);
  to.length /= length;
  to.time /= time;
  to.force /= force;
  to.pressure /= force / (length * length);
  return to;
}

/// Name of the version, from FITTYP or the name of the format. Sets it in `p`.
std::string find_version(const PropertyLines& file, MagicFormula& p) {
  const std::string format = capitals(file.word("PROPERTY_FILE_FORMAT"));
  const Entry* kind = file.find("FITTYP");
  const std::string fit = kind == nullptr ? std::string() : kind->text;
  if (fit == "61" || fit == "62") {
    p.version = MagicFormulaVersion::mf_6_1;
    return fmt::format("MF-Tyre 6.{}", fit[1]);
  }
  p.version = MagicFormulaVersion::mf_5_2;
  if (fit == "6" || fit == "21" || fit == "52") return "MF-Tyre 5.2";
  if (fit.empty() && format == "PAC2002") return "PAC2002";
  const std::string said = !fit.empty()     ? "FITTYP = " + fit
                           : format.empty() ? "no FITTYP and no PROPERTY_FILE_FORMAT"
                                            : "PROPERTY_FILE_FORMAT = " + format;
  throw Error(fmt::format("describes a kind of tyre that is not supported: {}", printable_line(said, 60)),
              kind != nullptr ? file.at("FITTYP") : file.at("PROPERTY_FILE_FORMAT"),
              "give a file of MF-Tyre 5.2 (PAC2002; FITTYP 6, 21, 52), 6.1 or 6.2 (FITTYP 61, 62)");
}

void read_use_mode(const PropertyLines& file, TyreProperties& tyre) {
  const Entry* entry = file.find("USE_MODE");
  if (entry == nullptr) return;
  const std::optional<double> mode = number_of(entry->text);
  const int digits = mode && *mode >= 0.0 && *mode < 1000.0 ? static_cast<int>(*mode) : -1;
  if (digits < 0 || digits != *mode || digits % 10 > 5)
    throw Error(fmt::format("USE_MODE = {} is not a mode of the Magic Formula", printable_line(entry->text, 40)),
                file.at("USE_MODE"), "use 4 (all forces, steady), or 14 (with relaxation)");
  constexpr std::array forces{MagicFormulaForces::none,     MagicFormulaForces::longitudinal,
                              MagicFormulaForces::lateral,  MagicFormulaForces::uncombined,
                              MagicFormulaForces::combined, MagicFormulaForces::combined};
  tyre.coefficients.forces = forces[static_cast<std::size_t>(digits % 10)];
  tyre.coefficients.transient = digits / 10 % 10 > 0;
  if (digits % 10 == 5) tyre.unused.emplace_back("USE_MODE (turn slip)");
  if (digits / 10 % 10 > 1) tyre.unused.emplace_back("USE_MODE (dynamics of the belt)");
}

void read_coefficients(const PropertyLines& file, const Conversion& to, TyreProperties& tyre) {
  MagicFormula& p = tyre.coefficients;
  const std::span<const Coefficient> known_coefficients = tyre_coefficients();
  for (const auto& [key, entry] : file.entries) {
    if (key.starts_with("UNITS.") || std::ranges::find(descriptions, key) != std::end(descriptions)) continue;
    const std::optional<double> value = number_of(entry.text);
    const auto known = std::ranges::find_if(known_coefficients, [&](const Coefficient& c) { return key == c.name; });
    const bool used = known != known_coefficients.end() && holds(known->versions, p.version);
    if (used && !value)
      throw Error(fmt::format("{} = '{}' is not a finite number", key, printable_line(entry.text, 40)), file.at(key),
                  "give a number");
    if (used)
      p.*(known->value) = *value * to.of(known->dimension);
    else if (!value || *value != 0.0)
      tyre.unused.push_back(printable_line(key, 40));
  }
  for (const std::string& table : std::set(file.tables.begin(), file.tables.end()))
    tyre.unused.push_back(fmt::format("[{}]", printable_line(table, 40)));
}

/// Scaling factors with keys in capitals.
std::map<std::string, double> scaling(const std::map<std::string, double>& scale) {
  std::map<std::string, double> all;
  for (const auto& [key, value] : scale) all[capitals(key)] = value;
  return all;
}

void apply_scale(const PropertyLines& file, const std::map<std::string, double>& scale, MagicFormula& p) {
  const std::span<const Coefficient> known_coefficients = tyre_coefficients();
  for (const auto& [key, value] : scale) {
    const auto known = std::ranges::find_if(known_coefficients,
                                            [&](const Coefficient& c) { return c.name[0] == 'L' && key == c.name; });
    if (known == known_coefficients.end() || known->dimension != Quantity::number || !holds(known->versions, p.version))
      throw Error(fmt::format("'{}' is not a scaling factor of this tyre", printable_line(key, 40)), file.path,
                  "use factors of section [SCALING_COEFFICIENTS], such as LMUX, LMUY, LKX or LKY");
    if (!std::isfinite(value)) throw Error(fmt::format("scale {} must be finite", key), file.path, "");
    p.*(known->value) = value;
  }
}

void require_coefficients(const PropertyLines& file, const MagicFormula& p) {
  std::vector<std::string> needed{"UNLOADED_RADIUS", "FNOMIN", "VERTICAL_STIFFNESS"};
  const auto need = [&](std::initializer_list<const char*> keys) {
    needed.insert(needed.end(), keys.begin(), keys.end());
  };
  if (p.along()) need({"PCX1", "PDX1", "PKX1"});
  if (p.across()) need({"PCY1", "PDY1", "PKY1", "PKY2", "QBZ1", "QCZ1", "QDZ1"});
  if (p.forces == MagicFormulaForces::combined) need({"RBX1", "RCX1", "RBY1", "RCY1"});
  std::vector<std::string> missing;
  for (const std::string& key : needed)
    if (file.find(key) == nullptr) missing.push_back(key);
  if (!missing.empty())
    throw Error("lacks the coefficients " + join(missing, ", "), file.path,
                "give a complete file, or a USE_MODE that needs fewer (1: longitudinal, 2: lateral, 3: both forces, "
                "uncombined)");
}

/// Checks values by which formulas divide, and ranges that must include zero.
void check_values(const PropertyLines& file, const std::map<std::string, double>& scale, const MagicFormula& p) {
  const auto where = [&](const char* key) { return scale.contains(key) ? file.path + ": scale" : file.at(key); };
  const auto positive = [&](double value, const char* key) {
    if (!(value > 0.0)) throw Error(fmt::format("{} = {:g} must be positive", key, value), where(key), "correct it");
  };
  for (const auto& [value, key] : {std::pair{p.UNLOADED_RADIUS, "UNLOADED_RADIUS"}, std::pair{p.FNOMIN, "FNOMIN"},
                                   std::pair{p.VERTICAL_STIFFNESS, "VERTICAL_STIFFNESS"}, std::pair{p.LFZO, "LFZO"},
                                   std::pair{p.LMUX, "LMUX"}, std::pair{p.LMUY, "LMUY"}, std::pair{p.LCX, "LCX"},
                                   std::pair{p.LCY, "LCY"}, std::pair{p.LKX, "LKX"}, std::pair{p.LKY, "LKY"}})
    positive(value, key);
  const bool along = file.find("PCX1") != nullptr, across = file.find("PCY1") != nullptr;
  for (const auto& [value, key] : {std::pair{p.PCX1, "PCX1"}, std::pair{p.PDX1, "PDX1"}, std::pair{p.PKX1, "PKX1"}})
    if (along) positive(value, key);
  if (across) positive(p.PCY1, "PCY1");
  for (const auto& [value, key] : {std::pair{p.PDY1, "PDY1"}, std::pair{p.PKY1, "PKY1"}, std::pair{p.PKY2, "PKY2"}})
    if (across && value == 0.0)
      throw Error(fmt::format("{} is zero: the tyre has no cornering stiffness", key), file.at(key),
                  "correct the coefficient");
  if (const double slope = p.PKY1 * std::sin(p.PKY4 * std::atan(1.0 / p.PKY2)); across && !(slope < 0.0))
    throw Error(fmt::format("the cornering stiffness PKY1 sin(PKY4 atan(1/PKY2)) = {:.4g} is not negative", slope),
                file.at("PKY1"),
                "give a file in the axes ISO-W, in which a positive slip angle gives a negative force");
  if (p.VERTICAL_DAMPING < 0.0)
    throw Error(fmt::format("VERTICAL_DAMPING = {:g} is negative", p.VERTICAL_DAMPING), file.at("VERTICAL_DAMPING"),
                "correct it");
  const auto encloses = [&](double low, double high, const char* key) {
    if ((low != 0.0 || high != 0.0) && !(low < 0.0 && high > 0.0))
      throw Error(fmt::format("the range from {:g} to {:g} does not enclose zero", low, high), file.at(key),
                  "correct the range, or remove both of its keys");
  };
  encloses(p.KPUMIN, p.KPUMAX, "KPUMAX");
  encloses(p.ALPMIN, p.ALPMAX, "ALPMAX");
  encloses(p.CAMMIN, p.CAMMAX, "CAMMAX");
  if ((p.FZMIN != 0.0 || p.FZMAX != 0.0) && !(p.FZMIN >= 0.0 && p.FZMAX > p.FZMIN))
    throw Error(fmt::format("the range of loads FZMIN = {:g}, FZMAX = {:g} is not valid", p.FZMIN, p.FZMAX),
                file.at("FZMAX"), "give 0 <= FZMIN < FZMAX, or remove both keys");
  if (std::max(std::abs(p.ALPMIN), p.ALPMAX) > 1.6)
    throw Error(
        fmt::format("the slip angles ALPMIN = {:g} rad, ALPMAX = {:g} rad exceed a right angle", p.ALPMIN, p.ALPMAX),
        file.at("ALPMAX"), "give ALPMIN and ALPMAX in radians");
}

}  // namespace

TyreProperties read_tyre_property_file(const std::string& path, const Units& units,
                                       const std::map<std::string, double>& scale) {
  const PropertyLines file = read_lines(path);
  TyreProperties tyre;
  tyre.version = fmt::format("{} ({})", printable_line(std::filesystem::path(path).filename().string(), 60),
                             find_version(file, tyre.coefficients));
  read_use_mode(file, tyre);
  read_coefficients(file, conversion_of(file, units), tyre);
  require_coefficients(file, tyre.coefficients);
  const std::map<std::string, double> scaled = scaling(scale);
  apply_scale(file, scaled, tyre.coefficients);
  check_values(file, scaled, tyre.coefficients);
  return tyre;
}

}  // namespace tisserand::formats
