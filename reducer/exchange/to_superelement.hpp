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

/// Names and units for a superelement that is made from imported matrices.
struct ImportOptions {
  std::string name;                        ///< name of the superelement
  Units units;                             ///< units of the file
  std::map<long, std::string> node_names;  ///< names of nodes by number, which replace NodePlace::name and n<number>
};

/// Superelement that was made from imported matrices, with its report and certificate.
struct Imported {
  formats::Superelement element;
  formats::SuperelementReport report;  ///< report of check() on the superelement
  ImportCertificate certificate;       ///< deviations that the matrices had before the import
};

/// Makes a superelement from foreign reduced matrices. It turns the rows of nodes to the part frame by u = A u_node,
/// with the axes A of the node. Boundary rows come first, in the order of the matrices. Matrices in canonical form
/// stay as they are, bit for bit. Others are brought to this form by the congruence y_I = −S_II⁻¹ S_IB y_B + Q η
/// (canonical_form()). Rigid motions are projected out of S (filter_rigid_motions()) if they strain the part by more
/// than 1e-12 and at most 1e-4 (check()). Throws Error for every inconsistency.
Imported to_superelement(const ReducedMatrices& matrices, const ImportOptions& options);

}  // namespace tisserand::reducer::exchange
