// SPDX-License-Identifier: GPL-3.0-or-later
// Table of keywords.
#include "reducer/decks/abaqus/keywords.hpp"

#include <algorithm>
#include <span>

namespace tisserand::reducer::abaqus {
namespace {

constexpr std::string_view kDefines[] = {"ASSEMBLY",
                                         "BEAMGENERALSECTION",
                                         "BEAMSECTION",
                                         "BOUNDARY",
                                         "COUPLING",
                                         "ELEMENT",
                                         "ELSET",
                                         "ENDASSEMBLY",
                                         "ENDINSTANCE",
                                         "ENDPART",
                                         "ENDSTEP",
                                         "EQUATION",
                                         "INSTANCE",
                                         "KINEMATICCOUPLING",
                                         "MASS",
                                         "MATERIAL",
                                         "MPC",
                                         "NODE",
                                         "NSET",
                                         "ORIENTATION",
                                         "PART",
                                         "RETAINEDNODALDOFS",
                                         "RIGIDBODY",
                                         "ROTARYINERTIA",
                                         "SHELLSECTION",
                                         "SOLIDSECTION",
                                         "SPRING",
                                         "STEP",
                                         "SUBSTRUCTUREGENERATE",
                                         "SURFACE",
                                         "SYSTEM",
                                         "TRANSFORM"};

constexpr std::string_view kFollows[] = {
    "DENSITY", "ELASTIC", "DISTRIBUTING", "KINEMATIC", "CENTROID", "SHEARCENTER", "TRANSVERSESHEARSTIFFNESS"};

constexpr std::string_view kSilent[] = {"HEADING",       "PREPRINT",     "RESTART",       "NODEPRINT",
                                        "NODEFILE",      "NODEOUTPUT",   "ELPRINT",       "ELFILE",
                                        "ELEMENTOUTPUT", "OUTPUT",       "FILEFORMAT",    "PRINT",
                                        "CONTACTOUTPUT", "ENERGYOUTPUT", "SECTIONPOINTS", "SECTIONPRINT"};

constexpr std::string_view kSkipped[] = {"AMPLITUDE",
                                         "CONDUCTIVITY",
                                         "DAMPING",
                                         "EXPANSION",
                                         "FILTER",
                                         "FRICTION",
                                         "HOURGLASSSTIFFNESS",
                                         "INITIALCONDITIONS",
                                         "PHYSICALCONSTANTS",
                                         "PLASTIC",
                                         "SECTIONCONTROLS",
                                         "SPECIFICHEAT",
                                         "SURFACEBEHAVIOR",
                                         "SURFACEINTERACTION",
                                         "TIMEPOINTS",
                                         "CYCLICHARDENING",
                                         "CREEP",
                                         "DAMAGEINITIATION"};

bool contains(std::span<const std::string_view> words, std::string_view word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

}  // namespace

std::optional<KeywordRole> keyword_role(std::string_view keyword) {
  if (contains(kFollows, keyword)) return KeywordRole::follows;
  if (contains(kDefines, keyword)) return KeywordRole::defines;
  if (contains(kSilent, keyword)) return KeywordRole::silent;
  if (contains(kSkipped, keyword)) return KeywordRole::skipped;
  return std::nullopt;
}

}  // namespace tisserand::reducer::abaqus
