// SPDX-License-Identifier: GPL-3.0-or-later
// Environment of the process, prepared before the solver's libraries are loaded.
#pragma once

#include <string>

namespace tisserand::reducer {

/// Folder of the running program, with / at its end. The other programs of the project are found from it.
std::string program_folder();

/// Whether an MPI launcher (mpirun, srun) started this process as a follower. A follower prints and writes nothing and
/// does the work that the leader requests.
bool is_follower();

/// Sets environment variables for this processor; those that the user has set stay. OpenBLAS 0.3.21 treats unknown
/// processors as the oldest (4-5 times slower) and reads OPENBLAS_CORETYPE only while it is loaded. Open MPI starts a
/// daemon per process by default. malloc uses small pages and returns memory at once. In a relocatable archive the
/// function also sets the folder of its Open MPI, which serves one process. It then throws Error under an MPI
/// launcher.
void prepare_environment();

/// Whether a process that has closed its files and printed everything may end by _exit, which saves the clean-up of
/// MPI and PETSc (12 ms). It may not under an MPI launcher, if Open MPI made a session folder, or in a build with
/// sanitizers, which report at the end.
bool may_leave_at_once();

/// Restarts this program with the right kernels if OpenBLAS has chosen its oldest kernels on a better processor.
void restart_if_blas_is_slow(char** argv);

}  // namespace tisserand::reducer
