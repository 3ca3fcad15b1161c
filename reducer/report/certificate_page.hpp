// SPDX-License-Identifier: GPL-3.0-or-later
// `reducer show -o certificate.html`: the certificate as a page with pictures.
#pragma once

#include <optional>
#include <string>

#include "formats/superelement/superelement.hpp"
#include "reducer/report/certificate.hpp"

namespace tisserand::reducer {

/// Certificate as a self-contained HTML page. It has frequencies with their enclosures, discretisation and truncation
/// errors, effective masses, modal assurance, and the text of the certificate. gnuplot draws the pictures. If gnuplot
/// is missing, the page says so.
std::string certificate_page(const formats::Superelement& element, const FileCertificate& file,
                             const std::optional<ModelCertificate>& model);

}  // namespace tisserand::reducer
