// SPDX-License-Identifier: GPL-3.0-or-later
// Decks written in a test: their meshes, their faults, and files beside them for INCLUDE.
#pragma once

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <string>

#include "common/error.hpp"
#include "reducer/decks/deck.hpp"

namespace tisserand::testing {

/// A folder of files that goes away with it; the deck is "main.bdf".
class DeckFolder {
 public:
  explicit DeckFolder(const std::map<std::string, std::string>& files) {
    static int count = 0;
    folder_ = std::filesystem::temp_directory_path() /
              ("tisserand-nastran-" + std::to_string(::getpid()) + "-" + std::to_string(count++));
    for (const auto& [name, text] : files) {
      std::filesystem::create_directories((folder_ / name).parent_path());
      std::ofstream(folder_ / name) << text;
    }
  }
  ~DeckFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }
  DeckFolder(const DeckFolder&) = delete;
  DeckFolder& operator=(const DeckFolder&) = delete;

  std::string main() const { return (folder_ / "main.bdf").string(); }

 private:
  std::filesystem::path folder_;
};

inline reducer::Deck read_deck(const std::string& text) {
  return reducer::read_nastran(DeckFolder({{"main.bdf", text}}).main(), {});
}

/// The text of the Error that the deck gives, without the folder; empty if it is read.
inline std::string fault_of_files(const std::map<std::string, std::string>& files) {
  const DeckFolder folder(files);
  try {
    reducer::read_nastran(folder.main(), {});
  } catch (const Error& error) {
    std::string text = error.what();
    const std::string prefix = std::filesystem::path(folder.main()).parent_path().string() + "/";
    for (std::size_t at = text.find(prefix); at != std::string::npos; at = text.find(prefix))
      text.erase(at, prefix.size());
    return text;
  }
  return "";
}

inline std::string fault_of(const std::string& text) { return fault_of_files({{"main.bdf", text}}); }

/// Whether one of the warnings of the mesh contains the text.
inline bool warns(const reducer::Deck& deck, const std::string& text) {
  for (const std::string& warning : deck.mesh.warnings)
    if (warning.find(text) != std::string::npos) return true;
  return false;
}

/// Two bars along x of length 2 with a property in SI units: for tests that need any sound deck.
inline std::string bar_deck() {
  return "GRID,1,,0.,0.,0.\nGRID,2,,2.,0.,0.\nGRID,3,,4.,0.,0.\n"
         "CBAR,11,5,1,2,0.,1.,0.\nCBAR,12,5,2,3,0.,1.,0.\n"
         "PBAR,5,7,.02,3.-4,4.-4,5.-4\nMAT1,7,2.1+11,,.3,7800.\n";
}

}  // namespace tisserand::testing
