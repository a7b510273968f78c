// SPDX-License-Identifier: Apache-2.0
#include "truth/averaging_blocks.h"

#include <cmath>
#include <complex>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

namespace sublimit::testing {
namespace {

using Complex = std::complex<double>;
using LatticePoint = std::pair<int, int>;  ///< twice (x, y): even on primal meshes, odd on dual ones

/// Values in sector 0, linear in those of the mesh before: a row of weights each.
struct Values {
  std::map<LatticePoint, Eigen::RowVectorXcd> at;
  Complex w_k;  ///< what a turn by one sector does

  /// In sector 0 or beside it, where a sector beside is seen as (s; x, y) = (s + 1; y, -x).
  Eigen::RowVectorXcd operator()(int x, int y) const {
    Complex turn = 1;
    if (x == 0 && y == 0) return at.at({0, 0});
    if (x <= 0) {
      std::swap(x, y);
      y = -y;
      turn = w_k;
    } else if (y < 0) {
      std::swap(x, y);
      x = -x;
      turn = std::conj(w_k);
    }
    return turn * at.at({x, y});
  }
};

/// Every place of a mesh in sector 0, as far as twice (x, y) is within `reach`; primal sectors own their first side.
std::vector<LatticePoint> places(bool primal, int reach, bool centre) {
  std::vector<LatticePoint> result;
  if (primal && centre) result.push_back({0, 0});
  for (int x = primal ? 2 : 1; x <= reach; x += 2)
    for (int y = primal ? 0 : 1; y <= reach; y += 2) result.push_back({x, y});
  return result;
}

/// The mean of all corners, over all sectors, is that of one where functions do not turn, else it is none.
Values averaged(const Values& values, bool to_primal, int reach, bool turns) {
  Values result{{}, values.w_k};
  for (const LatticePoint& p : places(to_primal, reach, !turns)) {
    const auto [x, y] = p;
    result.at[p] =
        x == 0 && y == 0
            ? values(1, 1)
            : Eigen::RowVectorXcd(
                  (values(x - 1, y - 1) + values(x + 1, y - 1) + values(x - 1, y + 1) + values(x + 1, y + 1)) / 4.);
  }
  return result;
}

}  // namespace

Eigen::MatrixXcd averaging_block(int degree, int n, int k) {
  const bool primal = degree % 2 == 1, turns = k % n != 0;
  const int reach = degree - 1;  // (reach + degree - 1)/2: a step asks for no more than it makes
  const std::vector<LatticePoint> kept = places(primal, reach, !turns);
  Values values{{}, std::polar(1., 2 * std::numbers::pi * k / n)};
  const Eigen::Index size = Eigen::Index(kept.size());
  for (Eigen::Index i = 0; i < size; ++i)
    values.at[kept[size_t(i)]] = Eigen::RowVectorXcd(Eigen::MatrixXcd::Identity(size, size).row(i));
  if (turns && primal) values.at[{0, 0}] = Eigen::RowVectorXcd::Zero(size);

  // Bilinear: points of the finer mesh have twice the coordinates, those between are means.
  const int finer = reach + degree - 1;
  Values fine{{}, values.w_k};
  for (const LatticePoint& p : places(true, finer, true)) {
    const auto [x, y] = p;  // on the old mesh x/2, y/2
    const int r = primal ? 0 : 1;
    const auto below = [&](int c) { return c / 2 - (c / 2 % 2 != r); };
    const auto above = [&](int c) { return c / 2 + (c / 2 % 2 != r); };
    if (!primal && x == 0 && y == 0)
      fine.at[p] = turns ? Eigen::RowVectorXcd(Eigen::RowVectorXcd::Zero(size)) : values(1, 1);
    else
      fine.at[p] = (values(below(x), below(y)) + values(above(x), below(y)) + values(below(x), above(y)) +
                    values(above(x), above(y))) /
                   4.;
  }
  for (int d = 2; d <= degree; ++d) {
    fine = averaged(fine, d % 2 == 1, finer - (d - 1), turns);
    if (d % 2 == 1 && turns) fine.at[{0, 0}] = Eigen::RowVectorXcd::Zero(size);
  }
  Eigen::MatrixXcd block(size, size);
  for (Eigen::Index i = 0; i < size; ++i) block.row(i) = fine.at.at(kept[size_t(i)]);
  return block;
}

double averaging_limit(int degree, int n) {
  const Eigen::MatrixXcd block = averaging_block(degree, n, 0);
  Eigen::RowVectorXd row = Eigen::RowVectorXd::Unit(block.rows(), 0);
  for (int i = 0; i < 100; ++i) row = row * block.real();  // rows sum to 1, and the next eigenvalue is 1/4 about
  return degree % 2 == 1 ? row[0] : row[0] / n;
}

double averaging_lambda(int degree, int n) {
  const Eigen::MatrixXcd block = averaging_block(degree, n, 1);
  Eigen::VectorXcd x = Eigen::VectorXcd::Ones(block.rows());
  Complex lambda = 0;
  for (int i = 0; i < 200; ++i) {
    const Eigen::VectorXcd next = block * x;
    lambda = x.dot(next) / x.squaredNorm();
    x = next.normalized();
  }
  return std::abs(lambda);
}

}  // namespace sublimit::testing
