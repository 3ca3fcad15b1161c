// Reduced matrices of another program become a superelement: axes, names, checks, canonical form, rigid-motion filter.
#pragma once

#include <map>
#include <string>

#include "common/units.hpp"
#include "formats/superelement/superelement.hpp"
#include "reducer/exchange/reduced_matrices.hpp"
#include "reducer/report/certificate.hpp"

namespace tisserand::reducer::exchange {

struct ImportOptions {
  std::string name;                        ///< of the superelement
  Units units;                             ///< of the file
  std::map<long, std::string> node_names;  ///< wish over NodePlace::name and n<number>
};

struct Imported {
  formats::Superelement element;
  formats::SuperelementReport report;  ///< of the result
  ImportCertificate certificate;       ///< of what was found
};

/// Rows of nodes are turned into the part frame, u = A u_node; boundary rows come first, in the order of the matrices.
/// What is in canonical form already stays as it is, bit for bit; all else is brought there by the congruence
/// y_I = −S_II⁻¹ S_IB y_B + Q η (canonical_form()). Rigid motions are projected out of S (filter_rigid_motions()) if
/// they strain the part by more than 1e-12, and by at most 1e-4 (check()). Throws Error for every inconsistency.
Imported to_superelement(const ReducedMatrices& matrices, const ImportOptions& options);

}  // namespace tisserand::reducer::exchange
