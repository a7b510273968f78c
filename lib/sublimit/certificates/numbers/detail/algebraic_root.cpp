// SPDX-License-Identifier: Apache-2.0
#include "sublimit/certificates/numbers/detail/algebraic_root.h"

#include <algorithm>

#include "sublimit/base/error.h"
#include "sublimit/certificates/numbers/detail/flint_value.h"

namespace sublimit {
namespace {

constexpr long usual_bits = 128;

ComplexBall enclosed(const Algebraic& value, long bits) {
  const PrecisionScope scope(bits);
  ComplexBall ball = value.enclosure();
  if (value.is_real()) arb_zero(acb_imagref(ball.get()));
  return ball;
}

/// The simplest fraction in a real ball: what a rational root must be, once the ball is small.
Algebraic simplest_fraction(const Ball& ball) {
  FlintInteger low, high, exponent;
  arb_get_interval_fmpz_2exp(low, high, exponent, ball.get());
  FlintRatio a, b, middle;
  const auto set = [&](fmpq_t q, const fmpz_t mantissa) {
    fmpq_set_fmpz(q, mantissa);
    const long shift = fmpz_get_si(exponent);
    if (shift >= 0)
      fmpq_mul_2exp(q, q, static_cast<ulong>(shift));
    else
      fmpq_div_2exp(q, q, static_cast<ulong>(-shift));
  };
  set(a, low);
  set(b, high);
  fmpq_simplest_between(middle, a, b);
  return Algebraic(middle);
}

Polynomial linear(const Algebraic& root) { return Polynomial({-root, 1}); }

}  // namespace

AlgebraicRoot::AlgebraicRoot(Algebraic value)
    : polynomial_(std::make_shared<Polynomial>(linear(value))),
      enclosure_(enclosed(value, usual_bits)),
      exact_(std::move(value)) {}

std::vector<AlgebraicRoot> AlgebraicRoot::all(const Polynomial& squarefree) {
  std::vector<AlgebraicRoot> roots;
  Polynomial rest = squarefree.monic();
  if (rest.degree() == 1) return {AlgebraicRoot(-rest.coefficients()[0])};
  if (rest.degree() < 1) return {};
  for (const ComplexBall& ball : isolated_roots(rest, usual_bits)) {
    if (!ball.im().contains_zero()) continue;
    const Algebraic value = simplest_fraction(ball.re());
    if (!rest.at(value).is_zero()) continue;
    roots.emplace_back(value);
    rest = divide(rest, linear(value)).quotient;
  }
  if (rest.degree() == 1) {
    roots.emplace_back(-rest.coefficients()[0]);
  } else if (rest.degree() > 1) {
    const auto shared = std::make_shared<Polynomial>(rest);
    for (const ComplexBall& ball : isolated_roots(rest, usual_bits)) {
      AlgebraicRoot root;
      root.polynomial_ = shared;
      root.enclosure_ = ball;
      root.exact_ = std::nullopt;
      roots.push_back(std::move(root));
    }
  }
  return roots;
}

AlgebraicRoot AlgebraicRoot::nearest(const Polynomial& squarefree, const ComplexBall& enclosure) {
  std::vector<AlgebraicRoot> roots = all(squarefree);
  std::erase_if(roots, [&](const AlgebraicRoot& root) { return !root.enclosure().overlaps(enclosure); });
  if (roots.size() != 1)
    throw AnalysisError(std::to_string(roots.size()) + " roots of " + squarefree.text() + " may lie in " +
                        enclosure.text() + " where one was expected");
  return roots[0];
}

ComplexBall AlgebraicRoot::enclosure(long bits) const {
  if (bits <= usual_bits) return enclosure_;
  if (exact_) return enclosed(*exact_, bits);
  std::vector<ComplexBall> roots = isolated_roots(*polynomial_, bits);
  // The known enclosure holds no other root, but a new one's may stick out of its own: precise enough, one is left.
  std::erase_if(roots, [&](const ComplexBall& root) { return !root.overlaps(enclosure_); });
  return roots.size() == 1 ? roots[0] : enclosure(2 * bits);
}

bool AlgebraicRoot::is_real() const {
  if (exact_) return exact_->is_real();
  if (polynomial_->is_real()) return acb_is_real(enclosure_.get());
  return enclosure_.im().contains_zero() && *this == conj();
}

bool AlgebraicRoot::is_root_of(const Polynomial& p) const {
  if (p.is_zero()) return true;
  if (exact_) return p.at(*exact_).is_zero();
  {
    const PrecisionScope scope(usual_bits);
    if (!p.at(enclosure_).contains_zero()) return false;
  }
  const Polynomial common = gcd(*polynomial_, p);
  if (common.degree() == 0) return false;
  const Polynomial others = divide(*polynomial_, common).quotient;
  // Squarefree: just one of the two vanishes.
  for (long bits = usual_bits;; bits *= 2) {
    const PrecisionScope scope(bits);
    const ComplexBall x = enclosure(bits);
    if (!others.at(x).contains_zero()) return true;
    if (!common.at(x).contains_zero()) return false;
  }
}

AlgebraicRoot AlgebraicRoot::conj() const {
  if (exact_) return AlgebraicRoot(exact_->conj());
  AlgebraicRoot r;
  r.polynomial_ = std::make_shared<Polynomial>(polynomial_->conj());
  r.enclosure_ = sublimit::conj(enclosure_);
  r.exact_ = std::nullopt;
  return r;
}

AlgebraicRoot AlgebraicRoot::negated() const {
  if (exact_) return AlgebraicRoot(-*exact_);
  AlgebraicRoot r;
  r.polynomial_ = std::make_shared<Polynomial>(polynomial_->negated());
  r.enclosure_ = -enclosure_;
  r.exact_ = std::nullopt;
  return r;
}

namespace {

/// The root, among those of p, that a sequence of enclosures closes in on.
template <class Enclosure>
AlgebraicRoot chosen(const Polynomial& p, const Enclosure& enclosure) {
  std::vector<AlgebraicRoot> roots;
  for (const PolynomialFactor& factor : squarefree_factors(p))
    for (AlgebraicRoot& root : AlgebraicRoot::all(factor.factor)) roots.push_back(std::move(root));
  for (long bits = usual_bits; roots.size() > 1; bits *= 2) {
    const PrecisionScope scope(bits);
    const ComplexBall there = enclosure(bits);
    std::erase_if(roots, [&](const AlgebraicRoot& root) { return !root.enclosure(bits).overlaps(there); });
  }
  return roots.at(0);
}

}  // namespace

AlgebraicRoot AlgebraicRoot::squared() const {
  if (exact_) return AlgebraicRoot(*exact_ * *exact_);
  return chosen(squares_of_roots(*polynomial_), [&](long bits) {
    const ComplexBall x = enclosure(bits);
    return x * x;
  });
}

AlgebraicRoot operator*(const AlgebraicRoot& a, const AlgebraicRoot& b) {
  if (a.exact() && b.exact()) return AlgebraicRoot(*a.exact() * *b.exact());
  return chosen(products_of_roots(a.polynomial(), b.polynomial()),
                [&](long bits) { return a.enclosure(bits) * b.enclosure(bits); });
}

bool operator==(const AlgebraicRoot& a, const AlgebraicRoot& b) {
  if (!a.enclosure().overlaps(b.enclosure())) return false;
  if (a.exact() && b.exact()) return *a.exact() == *b.exact();
  if (a.exact()) return b == a;
  if (b.exact())
    return a.polynomial().at(*b.exact()).is_zero() && [&] {
      // b is a root of a's polynomial: is it this one?
      for (long bits = usual_bits;; bits *= 2) {
        const PrecisionScope scope(bits);
        const ComplexBall x = a.enclosure(bits), y = b.enclosure(bits);
        if (!x.overlaps(y)) return false;
        long meets = 0;
        for (const ComplexBall& root : isolated_roots(a.polynomial(), bits)) meets += root.overlaps(y);
        if (meets == 1) return true;
      }
    }();
  const Polynomial common = a.polynomial() == b.polynomial() ? a.polynomial() : gcd(a.polynomial(), b.polynomial());
  if (common.degree() == 0 || !a.is_root_of(common) || !b.is_root_of(common)) return false;
  // Both are roots of `common`: the same one if they meet the same enclosure and no other.
  for (long bits = usual_bits;; bits *= 2) {
    const ComplexBall x = a.enclosure(bits), y = b.enclosure(bits);
    long both = 0, any = 0;
    for (const ComplexBall& root : isolated_roots(common, bits)) {
      both += root.overlaps(x) && root.overlaps(y);
      any += root.overlaps(x) || root.overlaps(y);
    }
    if (both == 0) return false;
    if (any == 1) return true;
  }
}

int compare(const AlgebraicRoot& a, const AlgebraicRoot& b) {
  if (a == b) return 0;
  for (long bits = usual_bits;; bits *= 2) {
    const Ball x = a.real_enclosure(bits), y = b.real_enclosure(bits);
    if (certainly_less(x, y)) return -1;
    if (certainly_less(y, x)) return 1;
  }
}

int compare_moduli(const AlgebraicRoot& a, const AlgebraicRoot& b) {
  const auto sign = [&](long bits) {
    const PrecisionScope scope(bits);
    const Ball x = norm(a.enclosure(bits)), y = norm(b.enclosure(bits));
    return certainly_less(x, y) ? -1 : certainly_less(y, x) ? 1 : 0;
  };
  if (const int s = sign(usual_bits)) return s;
  if (a == b || a == b.negated() || a == b.conj()) return 0;
  if (!(a.is_real() && b.is_real()) && a * a.conj() == b * b.conj()) return 0;
  for (long bits = 2 * usual_bits;; bits *= 2)
    if (const int s = sign(bits)) return s;
}

std::string AlgebraicRoot::text() const {
  if (exact_) return exact_->text();
  const std::vector<Algebraic>& c = polynomial_->coefficients();
  if (polynomial_->degree() == 2 && polynomial_->is_real() && is_real()) {
    const Algebraic middle = c[1] * Algebraic::ratio(-1, 2);
    const bool upper = compare(*this, AlgebraicRoot(middle)) > 0;
    return (middle.is_zero() ? "" : middle.text()) + (upper ? middle.is_zero() ? "" : "+" : "-") + "sqrt(" +
           (middle * middle - c[0]).text() + ")";
  }
  return enclosure_.text(15) + ", root of " + polynomial_->text();
}

}  // namespace sublimit
