// SPDX-License-Identifier: GPL-3.0-or-later
// First check of mesh and geometry files: kind, beginning and end.
#include "reducer/mesh/mesh_file.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "common/error.hpp"

namespace tisserand::reducer {
namespace {

struct Ending {
  const char* text;
  MeshFileKind kind;
};

constexpr std::array endings{
    Ending{".geo", MeshFileKind::geo},     Ending{".msh", MeshFileKind::msh},     Ending{".step", MeshFileKind::step},
    Ending{".stp", MeshFileKind::step},    Ending{".iges", MeshFileKind::iges},   Ending{".igs", MeshFileKind::iges},
    Ending{".brep", MeshFileKind::brep},   Ending{".bdf", MeshFileKind::nastran}, Ending{".nas", MeshFileKind::nastran},
    Ending{".dat", MeshFileKind::nastran}, Ending{".inp", MeshFileKind::abaqus}};

[[noreturn]] void refuse_format(const std::string& file, const std::string& what) {
  throw Error(what, file, "check that the ending of the file name fits its content, or write the file again");
}

[[noreturn]] void refuse_end(const std::string& file, const std::string& what) {
  throw Error("the file is truncated: " + what, file, "write or copy it again");
}

std::string content_of(const std::string& file, const std::string& where) {
  if (std::filesystem::is_fifo(file) || std::filesystem::is_socket(file) || std::filesystem::is_character_file(file))
    throw Error(fmt::format("mesh file '{}' is a pipe or a device, but it must be read twice", file), where,
                "write its output into a file");
  if (std::filesystem::is_directory(file)) throw Error(fmt::format("mesh file '{}' is a folder", file), where, "");
  std::ifstream stream(file, std::ios::binary);
  if (!stream)
    throw Error(fmt::format("cannot open mesh file '{}': {}", file, std::strerror(errno)), where,
                "relative names start from the folder of the part file");
  std::string text(std::istreambuf_iterator<char>(stream), {});
  if (text.empty()) refuse_end(file, "it is empty");
  return text;
}

/// Words of the line after `begin` of a section.
std::vector<std::string> words_after(const std::string& text, std::size_t begin) {
  const std::size_t line = text.find('\n', begin);
  if (line == std::string::npos) return {};
  const std::string words = text.substr(line + 1, std::min<std::size_t>(text.find('\n', line + 1) - line - 1, 200));
  std::vector<std::string> result;
  for (std::size_t at = 0; at < words.size();) {
    const std::size_t from = words.find_first_not_of(" \t\r", at);
    if (from == std::string::npos) break;
    at = std::min(words.find_first_of(" \t\r", from), words.size());
    result.push_back(words.substr(from, at - from));
  }
  return result;
}

/// Checks that every $Section has its $EndSection, that the version is supported, and that the counts fit the length.
void check_msh(const std::string& file, const std::string& text) {
  const std::size_t format = text.find("$MeshFormat");
  // gmsh would take a file with another beginning for a .geo file.
  if (format == std::string::npos || (format > 0 && !text.starts_with("$Comments")))
    refuse_format(file, "this is not a .msh file of gmsh: it has no $MeshFormat");
  const std::vector<std::string> words = words_after(text, format);
  if (words.size() < 3) refuse_end(file, "it ends in $MeshFormat");
  if (words[0] != "2.2" && words[0] != "4.1" && words[0] != "2" && words[0] != "4")
    throw Error(fmt::format("the .msh file has version {}", words[0]), file,
                "use version 2.2 or 4.1: gmsh -save -format msh41");
  for (const std::string_view section : {"Nodes", "Elements"}) {
    const std::size_t begin = text.find(fmt::format("${}", section));
    if (begin == std::string::npos) refuse_end(file, fmt::format("it has no ${}", section));
    if (text.find(fmt::format("$End{}", section), begin) == std::string::npos)
      refuse_end(file, fmt::format("$End{} is missing", section));
    if (words[1] != "0") continue;
    const std::vector<std::string> counts = words_after(text, begin);
    const std::size_t which = words[0].starts_with("4") ? 1 : 0;
    unsigned long long count = 0;
    if (which < counts.size())
      std::from_chars(counts[which].data(), counts[which].data() + counts[which].size(), count);
    if (count > text.size())
      refuse_end(file, fmt::format("{} {} do not fit into {} bytes", count, section, text.size()));
  }
}

void check_step(const std::string& file, const std::string& text) {
  const std::size_t begin = text.find("ISO-10303-21;");
  if (begin == std::string::npos || begin > 1000)
    refuse_format(file, "this is not a STEP file: it has no ISO-10303-21");
  if (text.find("END-ISO-10303-21") == std::string::npos) refuse_end(file, "END-ISO-10303-21 is missing");
}

/// Checks column 73 of an IGES file, which names the section: S, G, D, P, T.
void check_iges(const std::string& file, const std::string& text) {
  if (text.size() < 73 || (text[72] != 'S' && text[72] != 'C'))
    refuse_format(file, "this is not an IGES file: it has no S in column 73");
  const std::size_t end = text.find_last_not_of(" \r\n");
  const std::size_t line = text.rfind('\n', end) == std::string::npos ? 0 : text.rfind('\n', end) + 1;
  if (line + 72 > end || text[line + 72] != 'T') refuse_end(file, "the terminate section is missing");
}

void check_brep(const std::string& file, const std::string& text) {
  const std::size_t begin = text.find("CASCADE Topology");
  if (begin == std::string::npos || begin > 1000)
    refuse_format(file, "this is not a BREP file of OpenCASCADE: it has no CASCADE Topology");
  const std::size_t shapes = text.find("TShapes");
  if (shapes == std::string::npos) refuse_end(file, "TShapes is missing");
}

}  // namespace

std::optional<MeshFileKind> known_mesh_file(const std::string& file) {
  std::string ending = std::filesystem::path(file).extension().string();
  std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  for (const Ending& known : endings)
    if (ending == known.text) return known.kind;
  return std::nullopt;
}

bool is_geometry(MeshFileKind kind) {
  return kind != MeshFileKind::msh && kind != MeshFileKind::nastran && kind != MeshFileKind::abaqus;
}

MeshFileKind mesh_file_kind(const std::string& file, const std::string& where) {
  if (const auto kind = known_mesh_file(file)) return *kind;
  throw Error(
      fmt::format("mesh file '{}': the ending '{}' is unknown", file, std::filesystem::path(file).extension().string()),
      where, "known are .geo, .msh, .step, .stp, .iges, .igs, .brep, .bdf, .nas, .dat, .inp");
}

void check_mesh_file(const std::string& file, const std::string& where) {
  const MeshFileKind kind = mesh_file_kind(file, where);
  const std::string text = content_of(file, where);
  switch (kind) {
    case MeshFileKind::geo:
      if (text.find('\0') != std::string::npos) refuse_format(file, "this is not a .geo file: it holds binary data");
      return;  // a program: gmsh/door.hpp defines what it may do
    case MeshFileKind::msh:
      return check_msh(file, text);
    case MeshFileKind::step:
      return check_step(file, text);
    case MeshFileKind::iges:
      return check_iges(file, text);
    case MeshFileKind::brep:
      return check_brep(file, text);
    case MeshFileKind::nastran:
    case MeshFileKind::abaqus:
      return;  // their readers report faults line by line
  }
}

}  // namespace tisserand::reducer
