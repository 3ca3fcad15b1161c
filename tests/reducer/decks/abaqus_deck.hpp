// SPDX-License-Identifier: GPL-3.0-or-later
// Decks written by hand beside a test: text in, Deck or the text of the error out.
#pragma once

#include <fstream>
#include <string>

#include <gtest/gtest.h>

#include "common/error.hpp"
#include "reducer/decks/deck.hpp"
#include "tests/support/temporary_folder.hpp"

namespace tisserand::reducer {

/// A folder with deck.inp in it.
class AbaqusDeckFile {
 public:
  explicit AbaqusDeckFile(const std::string& text) { add("deck.inp", text); }
  void add(const std::string& name, const std::string& text) const { std::ofstream(folder_.file(name)) << text; }
  std::string path() const { return folder_.file("deck.inp"); }

 private:
  test_support::TemporaryFolder folder_;
};

inline Deck abaqus_deck(const std::string& text) {
  const AbaqusDeckFile file(text);
  return read_abaqus(file.path(), {UnknownCards::refuse});
}

/// "" if the deck is read.
inline std::string abaqus_error(const std::string& text) {
  try {
    abaqus_deck(text);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

inline const std::string abaqus_steel =
    "*MATERIAL, NAME=Steel\n"
    "*ELASTIC\n"
    "2.1e5, 0.3\n"
    "*DENSITY\n"
    "7.85e-9\n";

/// A unit square shell, nodes 1-4, element 1 in the set plate, thickness 0.5.
inline const std::string abaqus_plate =
    "*NODE, NSET=All\n"
    "1, 0., 0., 0.\n"
    "2, 1., 0., 0.\n"
    "3, 1., 1., 0.\n"
    "4, 0., 1., 0.\n"
    "*ELEMENT, TYPE=S4R, ELSET=Plate\n"
    "1, 1, 2, 3, 4\n" +
    abaqus_steel + "*SHELL SECTION, ELSET=Plate, MATERIAL=Steel\n0.5, 5\n";

/// A beam along x, nodes 1-2, element 1 in the set bar; its section comes from `section`.
inline std::string abaqus_bar(const std::string& section) {
  return "*NODE\n1, 0., 0., 0.\n2, 2., 0., 0.\n*ELEMENT, TYPE=B31, ELSET=Bar\n1, 1, 2\n" + abaqus_steel + section;
}

}  // namespace tisserand::reducer
