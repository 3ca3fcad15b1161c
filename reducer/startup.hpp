// What must be right in the environment of the process before solvers start.
#pragma once

namespace tisserand::reducer {

/// Debian's OpenBLAS takes unknown processors for the oldest (4-5 times slower) and reads OPENBLAS_CORETYPE only when it
/// is loaded; OpenMPI starts a daemon per process unless told otherwise. Sets the variables, and starts this program once
/// more in place of itself if OpenBLAS has chosen wrongly. Variables that the user has set stay. Call it before
/// SolverSession, in commands that solve only.
void prepare_environment(char** argv);

}  // namespace tisserand::reducer
