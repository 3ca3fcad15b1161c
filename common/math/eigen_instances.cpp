// SPDX-License-Identifier: GPL-3.0-or-later
// The instances that eigen_instances.hpp declares.
#define TISSERAND_INSTANCE template
#include "common/math/eigen_instances.hpp"
