// SPDX-License-Identifier: GPL-3.0-or-later
// For the sanitizers' build: libraries that were loaded stay, so that leaks of theirs carry their names at the end of
// the program, where cmake/leaks.supp suppresses them. Open MPI and PMIx unload their components before that.
extern "C" __attribute__((visibility("default"))) int dlclose(void* /*library*/) { return 0; }
