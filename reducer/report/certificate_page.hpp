// `reducer show -o certificate.html`: the certificate as one page with pictures.
#pragma once

#include <optional>
#include <string>

#include "formats/superelement/superelement.hpp"
#include "reducer/report/certificate.hpp"

namespace tisserand::reducer {

/// Self-contained HTML: frequencies with their enclosures, errors of the mesh and of dropped modes, effective masses,
/// modal assurance, and the text of the certificate. Pictures are drawn by gnuplot; without it the page says so.
std::string certificate_page(const formats::Superelement& element, const FileCertificate& file,
                             const std::optional<ModelCertificate>& model);

}  // namespace tisserand::reducer
