// Elementary functions rounded to the nearest double, hence the same on every machine and with every C library (MPFR
// with 53 bits; no result may be subnormal). A microsecond each: for drawing random numbers, not for inner loops.
#pragma once

#include "src/base/types.hpp"

namespace rockfold::correctly_rounded {

Real exp(Real x);
Real expm1(Real x);
Real log(Real x);
Real log1p(Real x);
Real sin(Real x);
Real cos(Real x);

}  // namespace rockfold::correctly_rounded
