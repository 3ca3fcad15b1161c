// SPDX-License-Identifier: GPL-3.0-or-later
// Superelement from reduced matrices of another program: axes, names, checks, canonical form, rigid-motion filter.
#pragma once

#include <map>
#include <string>

#include "common/units.hpp"
#include "formats/superelement/superelement.hpp"
#include "reducer/exchange/reduced_matrices.hpp"
#include "reducer/report/certificate.hpp"

namespace tisserand::reducer::exchange {

struct ImportOptions {
  std::string name;                        ///< name of the superelement
  Units units;                             ///< units of the file
  std::map<long, std::string> node_names;  ///< override NodePlace::name and n<number>
};

struct Imported {
  formats::Superelement element;
  formats::SuperelementReport report;  ///< report on the result
  ImportCertificate certificate;       ///< deviations found in the input
};

/// Turns rows of nodes into the part frame, u = A u_node. Boundary rows come first, in the order of the matrices.
/// Matrices in canonical form stay as they are, bit for bit. Others are brought there by the congruence y_I = −S_II⁻¹
/// S_IB y_B + Q η (canonical_form()). Rigid motions are projected out of S (filter_rigid_motions()) if they strain the
/// part by more than 1e-12 and at most 1e-4 (check()). Throws Error for every inconsistency.
Imported to_superelement(const ReducedMatrices& matrices, const ImportOptions& options);

}  // namespace tisserand::reducer::exchange
