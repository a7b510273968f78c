// SPDX-License-Identifier: Apache-2.0
#include "sublimit/certificates/numbers/ball.h"

#include <memory>

#include "sublimit/base/error.h"
#include "sublimit/certificates/numbers/detail/flint_value.h"

namespace sublimit {

thread_local long PrecisionScope::bits_ = 128;

namespace {

struct FlintFree {
  void operator()(char* text) const { flint_free(text); }
};
using FlintText = std::unique_ptr<char, FlintFree>;

/// The end of a ball as a double, rounded outwards.
double end_of(const arb_t x, bool upper) {
  FlintValue<arf_struct, arf_init, arf_clear> end;
  (upper ? arb_get_ubound_arf : arb_get_lbound_arf)(end, x, 64);
  return arf_get_d(end, upper ? ARF_RND_CEIL : ARF_RND_FLOOR);
}

}  // namespace

Ball Ball::hull(const Ball& low, const Ball& high) {
  Ball r;
  arb_union(r.x_, low.x_, high.x_, PrecisionScope::bits());
  return r;
}

Ball Ball::parse(std::string_view text) {
  Ball r;
  if (arb_load_str(r.x_, std::string(text).c_str()))
    throw FormatError("\"" + std::string(text) + "\" is no ball: four hexadecimal numbers were expected");
  return r;
}

double Ball::lower() const { return end_of(x_, false); }
double Ball::upper() const { return end_of(x_, true); }

std::string Ball::text(int digits) const { return FlintText(arb_get_str(x_, digits, 0)).get(); }
std::string Ball::exact_text() const { return FlintText(arb_dump_str(x_)).get(); }

Ball abs(const Ball& x) {
  Ball r;
  arb_abs(r.get(), x.get());
  return r;
}

Ball max(const Ball& a, const Ball& b) {
  Ball r;
  arb_max(r.get(), a.get(), b.get(), PrecisionScope::bits());
  return r;
}

Ball sqrt(const Ball& x) {
  Ball r;
  arb_sqrt(r.get(), x.get(), PrecisionScope::bits());
  return r;
}

Ball log(const Ball& x) {
  Ball r;
  arb_log(r.get(), x.get(), PrecisionScope::bits());
  return r;
}

Ball intersection(const Ball& a, const Ball& b) {
  Ball r;
  if (!arb_intersection(r.get(), a.get(), b.get(), PrecisionScope::bits()))
    throw AnalysisError("two enclosures of one number do not meet: " + a.text() + " and " + b.text());
  return r;
}

Ball Number<Ball>::ratio(int p, int q) { return Ball(p) / Ball(q); }

Ball Number<Ball>::cos_2pi(int k, int n) {
  FlintRatio turns;  // cos(pi x)
  fmpq_set_si(turns, 2L * k, n);
  Ball r;
  arb_cos_pi_fmpq(r.get(), turns, PrecisionScope::bits());
  return r;
}

}  // namespace sublimit
