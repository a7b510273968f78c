// SPDX-License-Identifier: Apache-2.0
#include "sublimit/search/net_jet.h"

#include <array>
#include <cmath>
#include <span>

namespace sublimit {
namespace {

/// B_i^d(t) for i = 0 ... d.
void bernstein(int d, double t, std::span<double> out) {
  out[0] = 1;
  for (int n = 1; n <= d; ++n) {
    double carry = 0;
    for (int i = 0; i < n; ++i) {
      const double value = out[size_t(i)];
      out[size_t(i)] = carry + (1 - t) * value;
      carry = t * value;
    }
    out[size_t(n)] = carry;
  }
}

constexpr int most_degree = 16;

}  // namespace

NetJet net_jet(const PolynomialBasis& basis, const Points& net, double u, double v) {
  const int d = basis.degree();
  NetJet jet;
  for (Eigen::Vector3d* x : {&jet.x, &jet.u, &jet.v, &jet.uu, &jet.uv, &jet.vv}) x->setZero();
  std::array<double, most_degree + 1> bu{}, bv{};
  const auto sum = [&](int degree, Eigen::Vector3d& out, const auto& coefficient) {
    if (degree < 0) return;
    // B = d!/(i! j! k!) u^i v^j w^k
    const double w = 1 - u - v;
    std::array<double, most_degree + 1> factorial{1};
    for (int n = 1; n <= degree; ++n) factorial[size_t(n)] = factorial[size_t(n - 1)] * n;
    for (int i = 0; i <= degree; ++i)
      for (int j = 0; i + j <= degree; ++j) {
        const int k = degree - i - j;
        out += factorial[size_t(degree)] / (factorial[size_t(i)] * factorial[size_t(j)] * factorial[size_t(k)]) *
               std::pow(u, i) * std::pow(v, j) * std::pow(w, k) * coefficient(i, j);
      }
  };
  const auto b = [&](int i, int j) { return Eigen::Vector3d(net.row(net_row(basis, i, j))); };
  if (basis.total()) {
    sum(d, jet.x, b);
    sum(d - 1, jet.u, [&](int i, int j) { return Eigen::Vector3d(d * (b(i + 1, j) - b(i, j))); });
    sum(d - 1, jet.v, [&](int i, int j) { return Eigen::Vector3d(d * (b(i, j + 1) - b(i, j))); });
    const double dd = d * (d - 1);
    sum(d - 2, jet.uu, [&](int i, int j) { return Eigen::Vector3d(dd * (b(i + 2, j) - 2 * b(i + 1, j) + b(i, j))); });
    sum(d - 2, jet.vv, [&](int i, int j) { return Eigen::Vector3d(dd * (b(i, j + 2) - 2 * b(i, j + 1) + b(i, j))); });
    sum(d - 2, jet.uv,
        [&](int i, int j) { return Eigen::Vector3d(dd * (b(i + 1, j + 1) - b(i + 1, j) - b(i, j + 1) + b(i, j))); });
    return jet;
  }
  const auto tensor = [&](int du, int dv, Eigen::Vector3d& out, double factor, const auto& coefficient) {
    if (du < 0 || dv < 0) return;
    bernstein(du, u, bu);
    bernstein(dv, v, bv);
    for (int i = 0; i <= du; ++i)
      for (int j = 0; j <= dv; ++j) out += factor * bu[size_t(i)] * bv[size_t(j)] * coefficient(i, j);
  };
  tensor(d, d, jet.x, 1, b);
  tensor(d - 1, d, jet.u, d, [&](int i, int j) { return Eigen::Vector3d(b(i + 1, j) - b(i, j)); });
  tensor(d, d - 1, jet.v, d, [&](int i, int j) { return Eigen::Vector3d(b(i, j + 1) - b(i, j)); });
  tensor(d - 2, d, jet.uu, d * (d - 1),
         [&](int i, int j) { return Eigen::Vector3d(b(i + 2, j) - 2 * b(i + 1, j) + b(i, j)); });
  tensor(d, d - 2, jet.vv, d * (d - 1),
         [&](int i, int j) { return Eigen::Vector3d(b(i, j + 2) - 2 * b(i, j + 1) + b(i, j)); });
  tensor(d - 1, d - 1, jet.uv, d * d,
         [&](int i, int j) { return Eigen::Vector3d(b(i + 1, j + 1) - b(i + 1, j) - b(i, j + 1) + b(i, j)); });
  return jet;
}

}  // namespace sublimit
