// SPDX-License-Identifier: Apache-2.0
#include "sublimit/certificates/c1/all_valences.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "sublimit/base/error.h"
#include "sublimit/certificates/c1/turned_map.h"
#include "sublimit/certificates/c1/valence_family.h"
#include "sublimit/certificates/spectra/for_all.h"

namespace sublimit {
namespace {

using By = Hypothesis::By;

/// Digits of balls: intervals are far wider than roundings.
constexpr long bits = 64;
/// How often intervals are halved before a proof gives up.
constexpr int deepest_proof = 12;

/// Valences at which the family is compared: up to 20 each, and some more.
std::vector<int> checked_valences(int first) {
  std::vector<int> ns;
  for (int n = first; n <= 20; ++n) ns.push_back(n);
  ns.insert(ns.end(), {25, 32, 41, 50});
  return ns;
}

Ball interval(double low, double high) { return low == high ? Ball(low) : Ball::hull(Ball(low), Ball(high)); }

/// cos(pi x)
Ball cos_pi(const Ball& x) {
  Ball c;
  arb_cos_pi(c.get(), x.get(), PrecisionScope::bits());
  return c;
}

/// A polynomial in balls, by the mean value theorem: p(m) + p'(H) (H - m), tighter than Horner's rule on intervals.
class BallPolynomial {
 public:
  BallPolynomial() = default;
  explicit BallPolynomial(const Polynomial& p) {
    for (const Algebraic& c : p.coefficients()) c_.push_back(c.real_enclosure());
  }
  Ball at(const Ball& x) const {
    const Ball m(x.mid());
    return horner(m, false) + horner(x, true) * (x - m);
  }
  Ball slope(const Ball& x) const { return horner(x, true); }

 private:
  Ball horner(const Ball& x, bool derivative) const {
    Ball sum;
    for (size_t k = c_.size(); k-- > (derivative ? 1 : 0);)
      sum = sum * x + (derivative ? Ball(static_cast<long>(k)) * c_[k] : c_[k]);
    return sum;
  }
  std::vector<Ball> c_;
};

using BallBlock = MatrixRows<BallPolynomial>;

BallBlock in_balls(const MatrixRows<Polynomial>& R) {
  BallBlock result;
  for (const auto& row : R) result.emplace_back(row.begin(), row.end());
  return result;
}

DenseMatrix<ComplexBall> at(const BallBlock& R, const Ball& h) {
  const auto size = std::ssize(R);
  DenseMatrix<ComplexBall> A(size, size);
  for (std::ptrdiff_t i = 0; i < size; ++i)
    for (std::ptrdiff_t j = 0; j < size; ++j) A(i, j) = ComplexBall(R[i][j].at(h));
  return A;
}

Ball at(const RingPolynomial& p, const Ball& c, const Ball& t) {
  Ball sum;
  for (size_t a = 3; a-- > 0;) {
    Ball in_t;
    for (size_t b = 3; b-- > 0;) in_t = in_t * t + p[a][b].real_enclosure();
    sum = sum * c + in_t;
  }
  return sum;
}

bool is_zero(const RingPolynomial& p) {
  for (const auto& row : p)
    for (const Algebraic& x : row)
      if (!x.is_zero()) return false;
  return true;
}

/// Halves an interval until `holds` says yes on all parts.
bool covered(double low, double high, const std::function<bool(double, double)>& holds, int depth = 0) {
  if (holds(low, high)) return true;
  if (depth == deepest_proof) return false;
  const double middle = low + (high - low) / 2;
  return covered(low, middle, holds, depth + 1) && covered(middle, high, holds, depth + 1);
}

class Proof {
 public:
  Proof(const C1Prover& prover, const ValenceFamily& family, const MatrixRows<Polynomial>& first,
        const MatrixRows<Polynomial>& other, int n, int ring)
      : prover_(prover), family_(family), first_(in_balls(first)), other_(in_balls(other)), ring_(ring), from_(n) {
    same_ = first == other;
    low_ = Number<Ball>::cos_2pi(1, 2 * n).lower();
  }

  bool block_one() {
    return covered(low_, 1, [&](double a, double b) {
      auto part = spectrum(interval(a, b));
      if (!part) return false;
      parts.push_back(std::move(*part));
      return true;
    });
  }

  /// A lower bound of lambda on [h, 1]; 0 where no interval tells.
  Ball lambda_from(double h) const {
    std::optional<double> least;
    for (const ValenceInterval& part : parts)
      if (part.h.upper() >= h) least = std::min(least.value_or(1), part.lambda.lower());
    return Ball(least.value_or(0));
  }

  bool increases() const {
    return holds_for_all(parts, [](const ValenceInterval& p) { return certainly_positive(p.slope); }) == true;
  }

  bool other_blocks() const {
    if (same_ && !increases()) return false;
    return covered(0, same_ ? low_ : 1, [&](double a, double b) {
      // h' <= 2 h^2 - 1
      const double h = std::max(low_, sqrt((Ball(1) + Ball(a)) / Ball(2)).lower());
      return power_below(at(other_, interval(a, b)), lambda_from(h), 8).has_value();
    });
  }

  bool block_zero() const {
    if (!rows_sum_to_one()) return false;
    if (family_.has_centre && centre_fades()) return fading_centre();
    return covered(0, 1.0 / from_ + 1e-12, [&](double a, double b) {
      const Ball t = interval(a, b), c = cos_pi(Ball(2) * t);
      const auto size = std::ssize(family_.zero);
      DenseMatrix<ComplexBall> B(size, size);
      for (std::ptrdiff_t i = 0; i < size; ++i)
        for (std::ptrdiff_t j = 0; j < size; ++j) B(i, j) = ComplexBall(at(family_.zero[i][j], c, t));
      B = deflated(B, std::vector<ComplexBall>(family_.zero.size(), ComplexBall(1)), 0);
      return power_below(std::move(B), lambda_from(low_), 8).has_value();
    });
  }

  /// The map needs narrower intervals than the spectrum: halves of those.
  bool map() {
    std::vector<ValenceInterval> halves;
    for (const ValenceInterval& part : parts)
      if (!covered(part.h.lower(), std::min(1.0, part.h.upper()), [&](double a, double b) {
            auto own = spectrum(interval(a, b));
            if (!own || !map_holds(*own)) return false;
            halves.push_back(std::move(*own));
            return true;
          }))
        return false;
    parts = std::move(halves);
    return true;
  }

  std::vector<ValenceInterval> parts;
  bool same() const { return same_; }

 private:
  std::optional<ValenceInterval> spectrum(const Ball& h) const {
    const DenseMatrix<ComplexBall> R = at(first_, h), transposed = R.transpose();
    const auto right = leading_pair(R), left = leading_pair(transposed);
    if (!right || !left) return std::nullopt;
    // All others are smaller than both, so both are the same, simple and real, and so are the vectors.
    const Ball lambda = right->value.re();
    for (const Ball& value : {lambda, left->value.re()})
      if (!certainly_positive(value) || !certainly_less(value, Ball(1)) ||
          !power_below(deflated(R, right->vector, right->unit), value, 8))
        return std::nullopt;
    ValenceInterval part{.h = h, .lambda = intersection(lambda, left->value.re()), .slope = {}, .net = {}, .least = {}};
    Ball change, product;
    for (size_t i = 0; i < first_.size(); ++i) {
      const Ball y = left->vector[i].re();
      product += y * right->vector[i].re();
      for (size_t j = 0; j < first_.size(); ++j) change += y * first_[i][j].slope(h) * right->vector[j].re();
    }
    part.slope = change / product;
    for (const ComplexBall& x : right->vector) part.net.push_back(x.re());
    return part;
  }

  bool map_holds(ValenceInterval& part) const {
    TurnedMap map(part.h, part.lambda, prover_.mask(), family_.labels, part.net);
    const auto least = map.least_jacobian(*prover_.pieces(), prover_.functions(), ring_);
    if (!least) return false;
    part.least = *least;
    return map.winds_once(*prover_.pieces(), prover_.functions(), ring_);
  }

  bool rows_sum_to_one() const {
    for (const auto& row : family_.zero)
      for (size_t a = 0; a < 3; ++a)
        for (size_t b = 0; b < 3; ++b) {
          Algebraic sum;
          for (const RingPolynomial& p : row) sum += p[a][b];
          if (!(sum == Algebraic(a == 0 && b == 0 ? 1 : 0))) return false;
        }
    return true;
  }

  /// The row of the centre is that of the centre alone but for O(1/n), exactly.
  bool centre_fades() const {
    for (size_t j = 1; j < family_.zero.size(); ++j)
      for (size_t a = 0; a < 3; ++a)
        if (!family_.zero[0][j][a][0].is_zero()) return false;
    return true;
  }

  bool fading_centre() const {
    const MatrixRows<RingPolynomial>& Z = family_.zero;
    if (!same_ || !increases()) return false;
    // The other rows are those of L(1), exactly.
    DenseMatrix<ComplexBall> L(std::ssize(Z) - 1, std::ssize(Z) - 1);
    for (size_t i = 1; i < Z.size(); ++i)
      for (size_t j = 1; j < Z.size(); ++j) {
        Algebraic sum;
        for (const Algebraic& x : family_.other[i - 1][j - 1]) sum += x;
        RingPolynomial rest = Z[i][j];
        rest[0][0] -= sum;
        if (!is_zero(rest)) return false;
        L(static_cast<Eigen::Index>(i) - 1, static_cast<Eigen::Index>(j) - 1) = ComplexBall(sum.real_enclosure());
      }
    // Those that the centre depends on, directly or not, are a block on the diagonal; the others are another one.
    std::vector<bool> inside(Z.size(), false);
    std::vector<size_t> open{0}, in, out;
    while (!open.empty()) {
      const size_t i = open.back();
      open.pop_back();
      if (inside[i]) continue;
      inside[i] = true;
      for (size_t j = 0; j < Z.size(); ++j)
        if (!is_zero(Z[i][j])) open.push_back(j);
    }
    for (size_t i = 1; i < Z.size(); ++i) (inside[i] ? in : out).push_back(i - 1);
    const auto among = [&](const std::vector<size_t>& rows) {
      DenseMatrix<ComplexBall> part(std::ssize(rows), std::ssize(rows));
      for (size_t i = 0; i < rows.size(); ++i)
        for (size_t j = 0; j < rows.size(); ++j)
          part(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) =
              L(static_cast<Eigen::Index>(rows[i]), static_cast<Eigen::Index>(rows[j]));
      return part;
    };
    if (!out.empty() && !power_below(among(out), lambda_from(low_), 8)) return false;
    const DenseMatrix<ComplexBall> inner = among(in);
    // Leading, so real: then so is the vector.
    const auto pair = leading_pair(inner);
    if (!pair || !power_below(deflated(inner, pair->vector, pair->unit), pair->value.re(), 8)) return false;
    const Ball t = interval(0, 1.0 / from_ + 1e-12), c = cos_pi(Ball(2) * t);
    Ball drop;  // r x/t
    double greatest = 0;
    for (size_t j = 0; j < in.size(); ++j) {
      const Ball x = pair->vector[j].re();
      if (!certainly_positive(x)) return false;
      greatest = std::max(greatest, x.upper());
      RingPolynomial r = Z[0][in[j] + 1], over_t;
      for (size_t a = 0; a < 3; ++a) over_t[a] = {r[a][1], r[a][2], Algebraic()};
      drop += at(over_t, c, t) * x;
      const Ball weight = at(over_t, c, t) * t;
      for (size_t i = 0; i < in.size(); ++i) {
        const Ball entry = inner(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)).re() - weight;
        if (entry.lower() < 0) return false;
      }
    }
    // lambda(1) - t drop/greatest < lambda(h), as 1 - h = 1 - cos(pi t) <= (pi t)^2/2.
    double steepest = 0;
    for (const ValenceInterval& part : parts) steepest = std::max(steepest, part.slope.upper());
    Ball pi;
    arb_const_pi(pi.get(), PrecisionScope::bits());
    return certainly_less(Ball(steepest) * pi * pi * Ball(t.upper()) * Ball(greatest), Ball(2) * drop);
  }

  const C1Prover& prover_;
  const ValenceFamily& family_;
  BallBlock first_, other_;
  int ring_, from_;
  bool same_ = false;
  double low_ = 0;
};

std::string range_text(const std::vector<int>& ns) {
  std::string text;
  for (const int n : ns) text += (text.empty() ? "" : ", ") + std::to_string(n);
  return text;
}

}  // namespace

AllValences all_valences(const C1Prover& prover, int first) {
  if (first < 7)
    throw InvalidParameter("all valences at once: first is " + std::to_string(first) + ", it should be 7 or more");
  const PrecisionScope precision(bits);
  AllValences result{.verdict = {.property = "c1-all-valences",
                                 .says = "C^1 at extraordinary points of all valences n >= 3, for masks that go on as "
                                         "at the valences compared"},
                     .first = first,
                     .intervals = {}};
  Verdict& v = result.verdict;
  v.theorem =
      "Reif 1995, as for one valence, with the angle of a sector as a parameter: balls hold all h = cos(pi/n) of an "
      "interval, up to the limit h = 1";
  const auto add = [&](std::string says, std::optional<bool> holds, By by, std::string value = {}) {
    v.hypotheses.push_back({std::move(says), holds, by, std::move(value)});
    return holds == true;
  };
  const auto shown = [](bool yes) { return yes ? std::optional(true) : std::nullopt; };
  const std::string beyond = "n >= " + std::to_string(first) + ": ";
  // The regular part is in each of these.
  for (int n = 3; n < first; ++n) {
    const Verdict own = prover.certify(n).verdict;
    const bool proved = own.answer == Verdict::Answer::proved;
    if (add("n = " + std::to_string(n) + ": certified by itself",
            own.answer == Verdict::Answer::disproved ? std::optional(false) : shown(proved), By::enclosure))
      continue;
    v.answer = own.answer == Verdict::Answer::disproved ? Verdict::Answer::disproved : Verdict::Answer::unknown;
    return result;
  }
  if (!add("the regular limit consists of polynomials", shown(prover.pieces().has_value()), By::exact)) return result;
  const std::vector<int> compared = checked_valences(first);
  const auto family = valence_family(prover, compared);
  if (!add("blocks are polynomials in exp(2 pi i k/n) and 1/n: the same ones at all valences compared",
           shown(family.has_value()), By::exact, "n = " + range_text(compared)))
    return result;
  const auto one = real_block(family->labels, family->first), other = real_block(family->labels, family->other);
  if (!add(beyond + "blocks are symmetric in a mirror", shown(one && other), By::exact)) return result;
  const std::optional<int>& ring = family->ring;
  if (!add("from some ring on the neighbourhood is regular, at all valences compared", shown(ring.has_value()),
           By::exact, ring ? "ring " + std::to_string(*ring) : ""))
    return result;
  Proof proof(prover, *family, *one, *other, first, *ring);
  bool goes_on = proof.block_one();
  add(beyond + "block 1 has an isolated leading eigenvalue, 0 < lambda < 1, and its others are smaller", shown(goes_on),
      By::enclosure, std::to_string(proof.parts.size()) + " intervals of h");
  if (goes_on) {
    goes_on = proof.other_blocks();
    add(beyond + "eigenvalues of blocks 2 to n - 2 are smaller", shown(goes_on), By::enclosure,
        proof.same() ? "lambda increases with h" : "on intervals of cos(pi k/n)");
  }
  if (goes_on) {
    goes_on = proof.block_zero();
    add(beyond + "those of block 0 are smaller, but for a simple 1", shown(goes_on), By::enclosure);
  }
  if (goes_on) {
    const bool map = proof.map();
    goes_on = add(beyond +
                      "the Jacobian determinant of the characteristic map, divided by sin(pi/n), is positive, and the "
                      "boundary curve winds once around the centre",
                  shown(map), By::enclosure, map ? "on " + std::to_string(proof.parts.size()) + " intervals of h" : "");
  }
  result.intervals = std::move(proof.parts);
  if (goes_on)
    v.because =
        "proved of the family of matrices that the masks give at the valences compared; that the scheme's file goes on "
        "in "
        "the same way at others is a condition of the statement, as no number of valences can show it";
  v.answer = goes_on ? Verdict::Answer::proved : Verdict::Answer::unknown;
  return result;
}

}  // namespace sublimit
