// SPDX-License-Identifier: Apache-2.0
#include "sublimit/report/statements/splines.h"

#include "sublimit/certificates/regularity/rational.h"

namespace sublimit::report {
namespace {

using Knots = std::vector<Rational>;

/// Limits from the right, or from the left.
enum class Side { right, left };

/// x in [a, b), or (a, b] from the left.
bool within(const Rational& a, const Rational& b, const Rational& x, Side side) {
  return side == Side::right ? a <= x && x < b : a < x && x <= b;
}

/// Derivative of some order of the basis function of this degree that begins at knot i.
Rational basis(const Knots& t, size_t i, int degree, const Rational& x, int order = 0, Side side = Side::right) {
  if (degree == 0) return order == 0 && within(t[i], t[i + 1], x, side) ? 1 : 0;
  const auto d = static_cast<size_t>(degree);
  Rational sum = 0;
  const Rational first = t[i + d] - t[i], second = t[i + d + 1] - t[i + 1];
  if (order > 0) {  // a difference of functions of degree - 1
    if (!first.is_zero()) sum += Rational(degree) / first * basis(t, i, degree - 1, x, order - 1, side);
    if (!second.is_zero()) sum -= Rational(degree) / second * basis(t, i + 1, degree - 1, x, order - 1, side);
    return sum;
  }
  if (!first.is_zero()) sum += (x - t[i]) / first * basis(t, i, degree - 1, x, 0, side);
  if (!second.is_zero()) sum += (t[i + d + 1] - x) / second * basis(t, i + 1, degree - 1, x, 0, side);
  return sum;
}

Knots uniform(int count) {
  Knots t;
  for (int i = 0; i < count; ++i) t.emplace_back(i);
  return t;
}

constexpr int degrees = 4;

}  // namespace

Finding pieces_have_degree(int more) {
  std::vector<bool> is_so;
  std::vector<int> found;
  for (int n = 1; n <= degrees; ++n) {
    int degree = n + 1;
    const Rational inside(Ratio{1, 3});
    while (degree > 0 && basis(uniform(n + 2), 0, n, inside, degree).is_zero()) --degree;
    found.push_back(degree);
    is_so.push_back(degree == n + more);
  }
  Finding f{fate(is_so), "the highest derivative of a B-spline's first piece that is not zero"};
  f.numbers["degree of the pieces, n = 1 ... 4"] = found;
  return f;
}

Finding first_factor(bool rises) {
  const Knots t = uniform(5);  // cubic: factors (x - t0)/(t3 - t0) and (t4 - x)/(t4 - t1)
  const auto first = [&](const Rational& x) { return (x - t[0]) / (t[3] - t[0]); };
  const auto second = [&](const Rational& x) { return (t[4] - x) / (t[4] - t[1]); };
  const bool first_rises = first(t[0]) < first(t[3]), second_falls = second(t[4]) < second(t[1]);
  Finding f{first_rises != second_falls ? Fate::depends : fate(first_rises == rises),
            "both factors of the recurrence, degree 3, at the ends of the support of the function they belong to"};
  f.numbers["first factor"] = {to_string(first(t[0])), to_string(first(t[3]))};
  f.numbers["second factor"] = {to_string(second(t[1])), to_string(second(t[4]))};
  return f;
}

Finding one_function_has_knots(int more) {
  std::vector<bool> is_so;
  std::vector<int> found;
  for (int n = 1; n <= degrees; ++n) {
    const int many = 3 * n + 6;
    const auto i = static_cast<size_t>(n + 2);  // some function in the middle
    int count = 0;
    for (int k = 0; k < many; ++k) {
      Knots moved = uniform(many);
      moved[static_cast<size_t>(k)] += Ratio{1, 3};
      bool changed = false;
      for (int x = 0; x < 4 * many && !changed; ++x) {
        const Rational at(Ratio{x, 4});
        changed = !(basis(moved, i, n, at) == basis(uniform(many), i, n, at));
      }
      count += changed;
    }
    found.push_back(count);
    is_so.push_back(count == n + more);
  }
  Finding f{fate(is_so), "each knot of a long row is moved: does one basis function change?"};
  f.numbers["knots that matter, n = 1 ... 4"] = found;
  return f;
}

Finding functions_sum_to_one(bool everywhere) {
  constexpr int degree = 3, many = 9;
  const Knots t = uniform(many);
  std::vector<bool> is_so;
  Finding f;
  f.numbers["sums at 1/2, 3/2 ..."] = Json::array();
  for (int k = 0; k + 1 < many; ++k) {
    Rational sum = 0;
    int zero = 0;
    for (int i = 0; i + degree + 1 < many; ++i) sum += basis(t, static_cast<size_t>(i), degree, Ratio{2 * k + 1, 2});
    for (int i = 0; i + degree + 1 < many; ++i)
      zero += basis(t, static_cast<size_t>(i), degree, Ratio{2 * k + 1, 2}).is_zero();
    const int there = many - degree - 1 - zero;
    if (everywhere || there == degree + 1) is_so.push_back(sum == Rational(1));
    f.numbers["sums at 1/2, 3/2 ..."].push_back(to_string(sum));
  }
  f.fate = fate(is_so);
  f.computed = "all cubic basis functions of knots 0, 1, ... 8, summed exactly";
  return f;
}

Finding continuous_at_knots(const std::vector<int>& multiplicities, int minus) {
  constexpr int degree = 3;
  std::vector<bool> is_so;
  Finding f;
  for (const int r : multiplicities) {
    Knots t{0, 1, 2, 3};
    for (int i = 0; i < r; ++i) t.emplace_back(4);
    for (int i = 5; i < 9; ++i) t.emplace_back(i);
    int continuity = degree;
    for (size_t i = 0; i + degree + 1 < t.size(); ++i) {
      int order = 0;
      while (order < continuity + 1 && basis(t, i, degree, 4, order, Side::left) == basis(t, i, degree, 4, order))
        ++order;
      continuity = std::min(continuity, order - 1);
    }
    is_so.push_back(continuity >= degree - minus);
    f.numbers["multiplicity " + std::to_string(r)] = "C^" + std::to_string(continuity);
  }
  f.fate = fate(is_so);
  f.computed = "derivatives of all cubic basis functions from both sides of a knot, exactly";
  return f;
}

Finding coons_cubic_interpolates() {
  // Blends by powers of t, each over 6.
  constexpr int blends[4][4] = {{1, -3, 3, -1}, {4, 0, -6, 3}, {1, 3, 3, -3}, {0, 0, 0, 1}};
  const auto blend = [&](int i, const Rational& x) {
    Rational sum = 0, power(Ratio{1, 6});
    for (const int c : blends[i]) {
      sum += Rational(c) * power;
      power *= x;
    }
    return sum;
  };
  bool spline = true;
  for (int k = 0; k < 4; ++k)  // four places decide on cubics
    for (int i = 0; i < 4; ++i)
      spline = spline && blend(i, Ratio{k, 4}) ==
                             basis(uniform(8), static_cast<size_t>(i), 3, Rational(3) + Rational(Ratio{k, 4}));
  Finding f{fate(blend(1, 0) == Rational(1) && blend(2, 1) == Rational(1)),
            "the blends at the start of a segment, and beside uniform cubic B-splines"};
  f.numbers["weights at the start"] = {to_string(blend(0, 0)), to_string(blend(1, 0)), to_string(blend(2, 0)),
                                       to_string(blend(3, 0))};
  f.numbers["blends are the uniform cubic B-spline's"] = spline;
  return f;
}

}  // namespace sublimit::report
