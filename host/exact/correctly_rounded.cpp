#include "host/exact/correctly_rounded.hpp"

#include <mpfr.h>

namespace rockfold::correctly_rounded {

namespace {

template <class Function>
Real call(Function function, Real x) {
  mpfr_t value;
  mpfr_init2(value, 53);
  mpfr_set_d(value, x, MPFR_RNDN);
  function(value, value, MPFR_RNDN);
  const Real result = mpfr_get_d(value, MPFR_RNDN);
  mpfr_clear(value);
  return result;
}

}  // namespace

Real exp(Real x) {
  return call(mpfr_exp, x);
}
Real expm1(Real x) {
  return call(mpfr_expm1, x);
}
Real log(Real x) {
  return call(mpfr_log, x);
}
Real log1p(Real x) {
  return call(mpfr_log1p, x);
}
Real sin(Real x) {
  return call(mpfr_sin, x);
}
Real cos(Real x) {
  return call(mpfr_cos, x);
}

}  // namespace rockfold::correctly_rounded
