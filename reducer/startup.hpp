// What must be right in the environment of the process before the libraries of the solver are loaded.
#pragma once

#include <string>

namespace tisserand::reducer {

/// The folder of the program that runs, with / at its end: other programs of ours are found from there.
std::string program_folder();

/// Whether a launcher of MPI (mpirun, srun) started this process beside another that leads: it says nothing, writes
/// nothing, and works where the leader asks it to.
bool is_follower();

/// OpenBLAS 0.3.21 takes processors that it does not know for the oldest (4-5 times slower) and reads OPENBLAS_CORETYPE
/// only while it is loaded; OpenMPI starts a daemon per process unless told otherwise; malloc takes small pages and gives
/// memory back at once. Sets the variables for this processor; those that the user has set stay. In a relocatable archive:
/// also where its Open MPI lies, which serves one process; throws Error if a launcher of MPI started this one.
void prepare_environment();

/// Whether a process whose files are closed and whose words are written may end by _exit: MPI and PETSc then end without
/// their clean-up, which takes 12 ms and has nothing to clean. Not if a launcher of MPI waits for it, if Open MPI made a
/// folder for its session, or in a build with sanitizers, which report at the end.
bool may_leave_at_once();

/// If OpenBLAS has chosen its oldest kernels on a better processor all the same: starts this program once more in place
/// of itself with the right choice.
void restart_if_blas_is_slow(char** argv);

}  // namespace tisserand::reducer
