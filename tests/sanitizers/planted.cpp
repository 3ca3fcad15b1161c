// SPDX-License-Identifier: GPL-3.0-or-later
// planted <fault>: commits one fault of a kind that only assertions and sanitizers see. Exit status 0: nobody has seen
// it.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include "common/parallel.hpp"
#include "tests/support/scenes/scenes.hpp"

namespace {

using namespace tisserand;

/// Sizes and places that the compiler cannot know.
volatile int three = 3;

/// Eigen compares sizes only where assertions are on.
void eigen_assertion() {
  Eigen::VectorXd sum = Eigen::VectorXd::Ones(three);
  sum += Eigen::VectorXd::Ones(three + 1);
  std::printf("%g\n", sum.sum());
}

/// Forces of one state, read after only the motion of another was evaluated.
void stale_result() {
  test_support::Simulation run(test_support::pendulum_scene(0.01, 1.0), {});
  mechanism::Evaluation now(run.model());
  mechanism::evaluate(run.model(), run.state(), now);
  mechanism::evaluate_motion(run.model(), run.state(), now);
  if (!std::isnan(now.residual.sum())) return;
  std::printf("the stale result is NaN\n");
  std::exit(1);
}

void heap_overrun() {
  std::vector<double> values(static_cast<std::size_t>(three));
  values.data()[three] = 1.0;
  std::printf("%g\n", values.data()[three]);
}

void misaligned_access() {
  std::vector<char> bytes(32);
  double* const place = reinterpret_cast<double*>(bytes.data() + three);
  *place = 1.0;
  std::printf("%g\n", *place);
}

/// The suppressions of cmake/leaks.supp are for other libraries and must not hide this.
void leak() {
  char* volatile lost = static_cast<char*>(std::malloc(1000));
  std::printf("%p\n", static_cast<void*>(lost));
  lost = nullptr;
}

/// Two threads add to one number.
void race() {
  int sum = 0;
  on_threads(2, [&](int) {
    for (int i = 0; i < 1000 * three; ++i) sum += i;
  });
  std::printf("%d\n", sum);
}

}  // namespace

int main(int count, char** arguments) {
  const std::string fault = count == 2 ? arguments[1] : "";
  if (fault == "eigen_assertion") eigen_assertion();
  if (fault == "stale_result") stale_result();
  if (fault == "heap_overrun") heap_overrun();
  if (fault == "misaligned_access") misaligned_access();
  if (fault == "leak") leak();
  if (fault == "race") race();
  return 0;
}
