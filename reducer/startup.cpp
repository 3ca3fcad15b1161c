// Environment variables for OpenBLAS and OpenMPI, and the one re-execution that OpenBLAS needs.
#include "reducer/startup.hpp"

#include <dlfcn.h>
#include <unistd.h>

#include <cstdlib>
#include <string_view>

namespace tisserand::reducer {
namespace {

constexpr const char* restarted = "TISSERAND_REDUCER_RESTARTED";

/// The kernel family that OpenBLAS runs with; empty if the BLAS is another one.
std::string_view openblas_core() {
  using CoreName = char* (*)();
  void* const symbol = dlsym(RTLD_DEFAULT, "openblas_get_corename");
  return symbol == nullptr ? std::string_view() : reinterpret_cast<CoreName>(symbol)();
}

/// The right OPENBLAS_CORETYPE for this processor if OpenBLAS fell back to its oldest kernels; else null.
const char* better_core() {
#if defined(__x86_64__)
  if (openblas_core() != "Prescott" || !__builtin_cpu_supports("avx2")) return nullptr;
  return __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl") ? "SkylakeX" : "Haswell";
#else
  return nullptr;
#endif
}

}  // namespace

void prepare_environment(char** argv) {
  constexpr int keep = 0;
  setenv("OPENBLAS_NUM_THREADS", "1", keep);
  if (std::getenv("OMPI_COMM_WORLD_SIZE") == nullptr) {
    setenv("OMPI_MCA_ess_singleton_isolated", "1", keep);
    setenv("OMPI_MCA_pml", "ob1", keep);
    setenv("OMPI_MCA_btl", "self", keep);
    setenv("OMPI_MCA_opal_signal", "", keep);
  }
  if (std::getenv("OPENBLAS_CORETYPE") != nullptr || std::getenv(restarted) != nullptr) return;
  const char* const core = better_core();
  if (core == nullptr) return;
  setenv("OPENBLAS_CORETYPE", core, keep);
  setenv(restarted, "1", keep);
  execv("/proc/self/exe", argv);  // returns only if it failed: then go on with slow kernels
}

}  // namespace tisserand::reducer
