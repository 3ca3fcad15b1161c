// The story of stage 1: from a part to its superelement and certificate.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <utility>

#include "formats/companion/companion.hpp"
#include "formats/modal_body/modal_body.hpp"
#include "formats/part/part.hpp"
#include "formats/superelement/superelement.hpp"
#include "reducer/mesh/mesh.hpp"
#include "reducer/recovery/fields.hpp"
#include "reducer/report/certificate.hpp"

namespace tisserand::reducer {

struct Reduction {
  formats::Superelement superelement;
  FileCertificate file;
  ModelCertificate model;
  std::optional<formats::Companion> companion;   ///< of the superelement, if the part asks for it
  std::optional<formats::ModalBody> modal_body;  ///< the same part as a floating-frame body, if it asks for it
};

/// Hears when a phase begins, by its name, how much of it is done, and when substitutions with the factor of the inside
/// begin and end: the caller measures time and shows progress.
struct PhaseListener {
  template <class Begin>
  PhaseListener(Begin heard) : begin(std::move(heard)) {}
  template <class Begin, class Share>
  PhaseListener(Begin heard, Share done) : begin(std::move(heard)), share(std::move(done)) {}
  template <class Begin, class Share, class Solve>
  PhaseListener(Begin heard, Share done, Solve columns)
      : begin(std::move(heard)), share(std::move(done)), solve(std::move(columns)) {}
  void operator()(const std::string& phase) const { begin(phase); }

  std::function<void(const std::string& phase)> begin;
  std::function<void(double)> share = [](double /*done*/) {};  ///< 0 to 1, about
  std::function<void(int)> solve;                              ///< Factor::tell_solutions
};

/// `recover` hears what recovery files are made from, of the superelement and of the modal body, where the part asks
/// for them. Needs a SolverSession. Throws Error for whatever is wrong with the part.
Reduction reduce(const formats::Part& part, const PhaseListener& begin, const RecoveryListener& recover);
inline Reduction reduce(const formats::Part& part, const PhaseListener& begin) { return reduce(part, begin, nullptr); }

/// The same from a mesh on; `part` gives name, units and the choice of modes.
Reduction reduce_mesh(const Mesh& mesh, const formats::Part& part, const PhaseListener& begin,
                      const RecoveryListener& recover);
inline Reduction reduce_mesh(const Mesh& mesh, const formats::Part& part, const PhaseListener& begin) {
  return reduce_mesh(mesh, part, begin, nullptr);
}

}  // namespace tisserand::reducer
