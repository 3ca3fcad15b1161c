// SPDX-License-Identifier: GPL-3.0-or-later
// Environment variables for OpenBLAS and Open MPI, and the folder of the program.
#include "reducer/startup.hpp"

#include <dlfcn.h>
#include <unistd.h>

#include <array>
#include <climits>
#include <cstdlib>
#include <string_view>

#include "common/error.hpp"

namespace tisserand::reducer {
namespace {

constexpr int keep = 0;  ///< argument of setenv: values of the user stay
constexpr int replace = 1;
constexpr const char* core_type = "OPENBLAS_CORETYPE";
constexpr const char* session_folders = "OMPI_MCA_orte_create_session_dirs";
constexpr const char* restarted = "TISSERAND_REDUCER_RESTARTED";

/// OpenBLAS kernels for this processor's instructions; null: OpenBLAS chooses.
const char* core_of_processor() {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512bw"))
    return "SkylakeX";
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return "Haswell";
#endif
  return nullptr;
}

bool is_intel() {
#if defined(__x86_64__)
  return __builtin_cpu_is("intel") != 0;
#else
  return false;
#endif
}

/// Kernels that OpenBLAS runs with; empty for another BLAS.
std::string_view loaded_core() {
  using CoreName = char* (*)();
  void* const symbol = dlsym(RTLD_DEFAULT, "openblas_get_corename");
  return symbol == nullptr ? std::string_view() : reinterpret_cast<CoreName>(symbol)();
}

/// Rank that an MPI launcher gave this process; null without a launcher.
const char* rank_of_launcher() {
  for (const char* const variable : {"OMPI_COMM_WORLD_RANK", "PMIX_RANK", "PMI_RANK"})
    if (const char* const rank = std::getenv(variable)) return rank;
  return nullptr;
}

/// Sets the folders of Open MPI and hwloc in a relocatable archive (scripts/archive), where they lie next to the
/// programs. Otherwise both search the folders of a Debian system, which may hold another version. The user's
/// OPAL_PREFIX is replaced, because it belongs to another Open MPI.
void use_parts_of_archive() {
  const std::string root = program_folder() + "..", libraries = root + "/lib/tisserand";
  if (access((libraries + "/openmpi3").c_str(), X_OK) != 0) return;
  if (rank_of_launcher() != nullptr)
    throw Error("mpirun or srun started this process, but the archive of Tisserand runs with one process only",
                program_folder() + "reducer",
                "start it without a launcher; for several processes install the Debian packages or build the sources");
  setenv("OPAL_PREFIX", root.c_str(), replace);
  setenv("OPAL_LIBDIR", libraries.c_str(), replace);
  setenv("OPAL_SYSCONFDIR", libraries.c_str(), replace);
  setenv("HWLOC_PLUGINS_PATH", (libraries + "/hwloc").c_str(), replace);
}

}  // namespace

bool is_follower() {
  const char* const rank = rank_of_launcher();
  return rank != nullptr && std::string_view(rank) != "0";
}

std::string program_folder() {
  std::array<char, PATH_MAX> buffer{};
  const ssize_t length = readlink("/proc/self/exe", buffer.data(), buffer.size() - 1);
  const std::string self(buffer.data(), length > 0 ? static_cast<std::size_t>(length) : 0);
  return self.substr(0, self.rfind('/') + 1);
}

void prepare_environment() {
  use_parts_of_archive();
  setenv("OPENBLAS_NUM_THREADS", "1", replace);  // more threads change the order of sums, and so the bits of files
  // Pages of 2 MB for matrices and reuse of freed memory save a third of the time of 100 000 coordinates.
  setenv("GLIBC_TUNABLES", "glibc.malloc.hugetlb=1:glibc.malloc.trim_threshold=268435456", keep);
  if (rank_of_launcher() == nullptr) {
    setenv("OMPI_MCA_ess_singleton_isolated", "1", keep);
    // Programs that start and end together would compete for one session folder.
    setenv(session_folders, "0", keep);
    setenv("OMPI_MCA_pml", "ob1", keep);
    setenv("OMPI_MCA_btl", "self", keep);
    setenv("OMPI_MCA_opal_signal", "", keep);
    setenv("HWLOC_COMPONENTS", "-pci,-linuxio,-opencl,-gl", keep);
  }
  if (const char* const core = core_of_processor(); core != nullptr && is_intel()) setenv(core_type, core, keep);
}

bool may_leave_at_once() {
#if defined(TISSERAND_SANITIZED)
  return false;
#endif
  const char* const folders = std::getenv(session_folders);
  return rank_of_launcher() == nullptr && folders != nullptr && std::string_view(folders) == "0";
}

void restart_if_blas_is_slow(char** argv) {
  const char* const core = core_of_processor();
  if (core == nullptr || loaded_core() != "Prescott" || std::getenv(restarted) != nullptr ||
      std::getenv(core_type) != nullptr)
    return;
  setenv(core_type, core, keep);
  setenv(restarted, "1", keep);
  execv("/proc/self/exe", argv);  // returns only if it failed; then the program goes on with slow kernels
}

}  // namespace tisserand::reducer
