// From the uses of superelement files to bodies: one for all uses of a file with the same options.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "formats/companion/companion.hpp"
#include "formats/scene/scene.hpp"
#include "formats/superelement/superelement.hpp"
#include "mechanism/bodies/superelement/constants/body.hpp"

namespace tisserand::mechanism {

/// Bodies that are there already, by file and options.
struct BuiltSuperelements {
  struct Entry {
    SuperelementOptions options;
    int body = 0;
  };
  std::map<const formats::LoadedSuperelement*, std::vector<Entry>> of_file;
};

/// Whether the second-order terms of a companion are on, or would be if there is one: false of a body that is rigid,
/// says second_order: off, or names an inertia other than F and no stiffening.
bool may_use_companion(const formats::SuperelementBodySpec& spec);

/// Inertia and stiffening of a body whose companion is given, or null where there is none.
struct SecondOrderChoice {
  formats::InertiaOption inertia = formats::InertiaOption::B;
  formats::StiffeningOption stiffening = formats::StiffeningOption::off;
  bool double_curvature = false;  ///< the companion's Λ
  bool any() const { return inertia == formats::InertiaOption::F || stiffening != formats::StiffeningOption::off; }
};

/// What `inertia`, `stiffening` and `second_order` say together. Throws Error for combinations that were measured to be
/// wrong, and for terms of a companion that is not there.
SecondOrderChoice choose_second_order(const formats::SuperelementBodySpec& spec, const formats::Companion* companion);

/// "inertia F, stiffening full, double curvature".
std::string describe(const SecondOrderChoice& choice);

/// What a body has of the companion of its file.
struct CompanionUse {
  const formats::Companion* file = nullptr;   ///< null: there is none, or the body does without
  const formats::Companion* terms = nullptr;  ///< the same, or null: the body does without second-order terms
  std::vector<std::string> load_cases;        ///< that loads name for any body of the file, ascending
};

/// Index among `bodies` of the body that `spec` makes from the file; built and appended if there is none. units: file
/// -> scene. Throws Error.
int find_or_build(const formats::SuperelementBodySpec& spec, const formats::LoadedSuperelement& file,
                  const CompanionUse& companion, const UnitConversion& units, BuiltSuperelements& built,
                  std::vector<SuperelementBody>& bodies);

}  // namespace tisserand::mechanism
