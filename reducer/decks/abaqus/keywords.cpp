// The table of keywords (data).
#include "reducer/decks/abaqus/keywords.hpp"

#include <algorithm>
#include <array>

namespace tisserand::reducer::abaqus {
namespace {

constexpr std::array<std::string_view, 32> kDefines = {"ASSEMBLY",
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

constexpr std::array<std::string_view, 7> kFollows = {
    "DENSITY", "ELASTIC", "DISTRIBUTING", "KINEMATIC", "CENTROID", "SHEARCENTER", "TRANSVERSESHEARSTIFFNESS"};

constexpr std::array<std::string_view, 16> kSilent = {"HEADING",       "PREPRINT",     "RESTART",       "NODEPRINT",
                                                      "NODEFILE",      "NODEOUTPUT",   "ELPRINT",       "ELFILE",
                                                      "ELEMENTOUTPUT", "OUTPUT",       "FILEFORMAT",    "PRINT",
                                                      "CONTACTOUTPUT", "ENERGYOUTPUT", "SECTIONPOINTS", "SECTIONPRINT"};

constexpr std::array<std::string_view, 18> kSkipped = {"AMPLITUDE",
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

template <std::size_t n>
bool contains(const std::array<std::string_view, n>& words, std::string_view word) {
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
