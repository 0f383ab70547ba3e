#include "tests/kernels/device_environment.hpp"
