// SPDX-License-Identifier: GPL-3.0-or-later
// method: bdf in a build without CVODE: reports an error.
#include "common/error.hpp"
#include "mechanism/bdf/bdf.hpp"

namespace tisserand::mechanism {

struct Bdf::Data {};

bool bdf_available() { return false; }

Bdf::Bdf(const formats::Scene& scene, const Model&, State&, Workspace&) {
  throw Error("integrator: method: bdf needs CVODE, which this build does not have", scene.file,
              "install libsundials-dev and configure with -DTISSERAND_CVODE=ON, or use method: generalised_alpha with "
              "error_control");
}

Bdf::~Bdf() = default;
std::string Bdf::step(const StepEnd&) { return {}; }
void Bdf::go_to(double) {}
void Bdf::restart(double) {}
double Bdf::violation() const { return 0.0; }
BdfCounts Bdf::counts() const { return {}; }

}  // namespace tisserand::mechanism
