// Tests of the block Lanczos type, which a program has only where SLEPc's header for new solvers was found.
#pragma once

#include <gtest/gtest.h>

#include "reducer/modes/eps_block_lanczos.hpp"

#define NEEDS_BLOCK_LANCZOS()                                                       \
  if (!reducer::has_block_lanczos()) {                                              \
    GTEST_SKIP() << "slepc/private/epsimpl.h was missing when this was configured"; \
  }                                                                                 \
  static_assert(true)
