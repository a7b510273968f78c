// SPDX-License-Identifier: Apache-2.0
#include "sublimit/certificates/numbers/complex_ball.h"

#include "sublimit/base/error.h"
#include "sublimit/certificates/numbers/detail/flint_value.h"

namespace sublimit {

ComplexBall ComplexBall::root_of_unity(long k, long n) {
  FlintRatio turns;  // exp(pi i x)
  fmpq_set_si(turns, 2 * (k % n), static_cast<ulong>(n));
  ComplexBall r;
  arb_sin_cos_pi_fmpq(acb_imagref(r.z_), acb_realref(r.z_), turns, PrecisionScope::bits());
  return r;
}

ComplexBall ComplexBall::parse(std::string_view text) {
  const size_t bar = text.find(" | ");
  if (bar == text.npos) throw FormatError("\"" + std::string(text) + "\" is no complex ball: two balls were expected");
  return {Ball::parse(text.substr(0, bar)), Ball::parse(text.substr(bar + 3))};
}

std::string ComplexBall::text(int digits) const {
  return acb_is_real(z_) ? re().text(digits) : re().text(digits) + "+" + im().text(digits) + "*i";
}

std::string ComplexBall::exact_text() const { return re().exact_text() + " | " + im().exact_text(); }

ComplexBall conj(const ComplexBall& z) {
  ComplexBall r;
  acb_conj(r.get(), z.get());
  return r;
}

Ball abs(const ComplexBall& z) {
  Ball r;
  acb_abs(r.get(), z.get(), PrecisionScope::bits());
  return r;
}

Ball norm(const ComplexBall& z) {
  // Squares by arb_sqr never reach below zero.
  Ball re = z.re(), im = z.im();
  arb_sqr(re.get(), re.get(), PrecisionScope::bits());
  arb_sqr(im.get(), im.get(), PrecisionScope::bits());
  return re + im;
}

}  // namespace sublimit
