// The instances that eigen_instances.hpp declares.
#define TISSERAND_INSTANCE template
#include "common/eigen_instances.hpp"
