// The instances that eigen_instances.hpp declares.
#define TISSERAND_INSTANCE template
#include "common/math/eigen_instances.hpp"
