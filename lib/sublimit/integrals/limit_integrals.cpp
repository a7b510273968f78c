// SPDX-License-Identifier: Apache-2.0
#include "sublimit/integrals/limit_integrals.h"

#include <Eigen/Dense>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "sublimit/base/detail/found_once.h"
#include "sublimit/base/detail/parallel_for.h"
#include "sublimit/base/error.h"
#include "sublimit/core/detail/dense_decompositions.h"
#include "sublimit/core/detail/finite_points.h"
#include "sublimit/integrals/detail/quadrature.h"
#include "sublimit/integrals/detail/refined_sums.h"
#include "sublimit/integrals/detail/unit_box.h"
#include "sublimit/nets/piece_hull.h"
#include "sublimit/parts/closed_surface.h"
#include "sublimit/surface/detail/limit_patches.h"

namespace sublimit {
namespace {

/// A piece whose points are so near to each other, relative to those that the descent began with, is left out: the
/// square, its area, is below the rounding of the whole.
constexpr double negligible = 0x1p-30;
/// Children that a piece may be cut into before it is taken for one that has more on every level: along a line.
constexpr int most_pieces = 1 << 12;
/// Of the area of a piece that squares may differ by when they are quartered.
constexpr double area_tolerance = 2e-13;
/// Squares that all pieces together, and a single one at least, may be quartered into for their area. Smooth pieces
/// take some dozens; where a surface folds, its area has a kink along a line, which no number of squares resolves to
/// the last digit: what is left is told as the error.
constexpr std::int64_t most_squares = 1 << 15, least_squares = 1 << 10;

/// x, y and z of coefficients or nodes.
using Columns = Eigen::Matrix<double, Eigen::Dynamic, 3>;

/// Gauss quadrature of all polynomial pieces of one basis, by Bernstein coefficients on a square or triangle. A piece
/// that is cut along u = v has two triangles.
class PieceRule {
 public:
  PieceRule(const PolynomialBasis& basis, bool halves)
      : own_(halves && !basis.total() ? 2 * basis.degree() : basis.degree(), halves || basis.total()), nets_(own_) {
    const int d = own_.degree();
    if (halves) {
      halves_.push_back(nets_.from_basis() * on_triangle(basis, false));
      halves_.push_back(nets_.from_basis() * on_triangle(basis, true));
    } else {
      halves_.push_back(nets_.from_basis());
    }
    // Of X X^T (X.N), by u and by v: 5 d - 2, since the leading terms of X and X_u are parallel; of triangles less one.
    // Areas, which are no polynomials, are halved less often with some nodes more.
    const int n = std::max(4, 5 * d / 2);
    const std::vector<QuadraturePoint> rule = own_.total() ? triangle_rule(n) : square_rule(n);
    const Eigen::MatrixXd to_basis = PivotedLu(nets_.from_basis()).inverse();
    const auto count = Eigen::Index(rule.size());
    x_.resize(count, own_.size());
    u_.resize(count, own_.size());
    v_.resize(count, own_.size());
    weights_.resize(count);
    for (Eigen::Index q = 0; q < count; ++q) {
      const QuadraturePoint& p = rule[size_t(q)];
      const Eigen::MatrixXd rows = own_.at(p.u, p.v, 1) * to_basis;
      x_.row(q) = rows.row(0);
      u_.row(q) = rows.row(1);
      v_.row(q) = rows.row(2);
      weights_[q] = p.weight;
    }
  }

  const std::vector<Eigen::MatrixXd>& halves() const { return halves_; }
  const Eigen::MatrixXd& quarter(int k) const { return nets_.quarter(k); }

  /// Points and X_u x X_v of the nodes.
  struct Nodes {
    Columns x, N;
  };
  Nodes nodes(const Columns& net) const {
    const Columns u = u_ * net, v = v_ * net;
    Nodes result{x_ * net, Columns(u.rows(), 3)};
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      result.N.col(i) = u.col(j).cwiseProduct(v.col(k)) - u.col(k).cwiseProduct(v.col(j));
    }
    return result;
  }
  const Eigen::VectorXd& weights() const { return weights_; }

 private:
  /// Coefficients of `own_` on the half below or above u = v by those on the square.
  Eigen::MatrixXd on_triangle(const PolynomialBasis& basis, bool above) const {
    const int d = own_.degree();
    Eigen::MatrixXd ours(own_.size(), own_.size()), theirs(own_.size(), basis.size());
    int row = 0;
    for (int i = 0; i <= d; ++i)
      for (int j = 0; j <= d - i; ++j, ++row) {
        const double s = double(i) / d, t = double(j) / d;
        ours.row(row) = own_.at(s, t, 0);
        theirs.row(row) = above ? basis.at(s, s + t, 0) : basis.at(s + t, t, 0);
      }
    return PivotedLu(ours).solve(theirs);
  }

  PolynomialBasis own_;
  BernsteinNets nets_;
  std::vector<Eigen::MatrixXd> halves_;
  Eigen::MatrixXd x_, u_, v_;
  Eigen::VectorXd weights_;
};

/// The rules of all bases of a surface, shared between threads.
class PieceRules {
 public:
  const PieceRule& of(const PiecePolynomial& p) {
    const bool halves = p.coefficients.size() > 1;
    return rules_.get({p.basis.degree(), p.basis.total(), halves}, [&] { return PieceRule(p.basis, halves); });
  }

 private:
  FoundByKey<std::tuple<int, bool, bool>, PieceRule> rules_;
};

class Integrator {
 public:
  /// @param squares  that a piece may be quartered into
  Integrator(PieceRules& rules, std::int64_t squares) : rules_(rules), most_squares_(squares) {}

  /// Nothing of a piece that is not made of polynomials but for a point.
  std::optional<EstimatedSums> piece(const PieceType& type, const Points& points) {
    visited_ = 0;
    squares_ = most_squares_;
    const double size = extent(points);
    sums_ = {};
    if (!add(type, points, negligible * size, area_tolerance * size * size)) return std::nullopt;
    return sums_;
  }

 private:
  static double extent(const Points& points) { return (points.rowwise() - points.row(0)).cwiseAbs().maxCoeff(); }

  bool add(const PieceType& type, const Points& points, double enough, double tolerance) {
    if (const PiecePolynomial* p = type.polynomial()) {
      const Points differences = points.bottomRows(points.rows() - 1).rowwise() - points.row(0);
      const PieceRule& rule = rules_.of(*p);
      for (size_t half = 0; half < p->coefficients.size(); ++half)
        add(rule, rule.halves()[half] * (p->coefficients[half] * differences), points.row(0), tolerance);
      return true;
    }
    if (type.types().has_no_polynomials()) return false;
    if (extent(points) <= enough) {
      sums_.error.area += extent(points) * extent(points);
      return true;
    }
    if (++visited_ > most_pieces) return false;
    // Those that another child is as well have a line of this piece's square only.
    for (const PieceLink& link : type.children())
      if (!link.map.is_repeated() && !add(*link.type, child_points(link, points), enough, tolerance)) return false;
    return true;
  }

  /// @param net  less the origin
  void add(const PieceRule& rule, const Columns& net, const Eigen::RowVector3d& origin, double tolerance) {
    const PieceRule::Nodes nodes = rule.nodes(net);
    const Columns x = nodes.x.rowwise() + origin;
    const Eigen::VectorXd flux = rule.weights().cwiseProduct(x.cwiseProduct(nodes.N).rowwise().sum());
    sums_.value.volume += flux.sum() / 3;
    sums_.value.first += x.transpose() * flux / 4;
    sums_.value.second += x.transpose() * flux.asDiagonal() * x / 5;
    add_area(rule, net, origin, area(rule, nodes), tolerance);
  }

  /// The area, and the position over it.
  static Eigen::Vector4d area(const PieceRule& rule, const PieceRule::Nodes& nodes) {
    const Eigen::VectorXd dA = rule.weights().cwiseProduct(nodes.N.rowwise().norm());
    Eigen::Vector4d sum;
    sum << dA.sum(), nodes.x.transpose() * dA;
    return sum;
  }

  /// A square and its quarters, whose sum is taken for its area.
  struct Square {
    std::array<Columns, 4> nets;
    std::array<Eigen::Vector4d, 4> parts;
    Eigen::Vector4d sum = Eigen::Vector4d::Zero();
    double error = 0;  ///< difference to the area by the square itself
    bool operator<(const Square& other) const { return error < other.error; }
  };
  Square quartered(const PieceRule& rule, const Columns& net, const Eigen::Vector4d& whole) {
    --squares_;
    Square square;
    for (int k = 0; k < 4; ++k) {
      square.nets[size_t(k)] = rule.quarter(k) * net;
      square.parts[size_t(k)] = area(rule, rule.nodes(square.nets[size_t(k)]));
      square.sum += square.parts[size_t(k)];
    }
    square.error = std::abs(square.sum[0] - whole[0]);
    return square;
  }

  /// Quarters the square of the largest error until all errors together are small, or there are enough squares.
  void add_area(const PieceRule& rule, const Columns& net, const Eigen::RowVector3d& origin,
                const Eigen::Vector4d& whole, double tolerance) {
    const auto accept = [&](const Eigen::Vector4d& sum, double error) {
      sums_.value.area += sum[0];
      sums_.value.of_area += sum.tail<3>() + sum[0] * origin.transpose();
      sums_.error.area += error;
    };
    if (whole[0] <= tolerance) return accept(whole, whole[0]);
    std::vector<Square> squares{quartered(rule, net, whole)};  // a heap
    double error = squares[0].error;
    while (error > tolerance && squares_ >= 4) {
      std::pop_heap(squares.begin(), squares.end());
      const Square largest = std::move(squares.back());
      squares.pop_back();
      error -= largest.error;
      for (size_t k = 0; k < 4; ++k) {
        squares.push_back(quartered(rule, largest.nets[k], largest.parts[k]));
        error += squares.back().error;
        std::push_heap(squares.begin(), squares.end());
      }
    }
    for (const Square& square : squares) accept(square.sum, square.error);
  }

  EstimatedSums sums_;
  int visited_ = 0;
  std::int64_t squares_ = 0;  // that are left to the piece
  PieceRules& rules_;
  std::int64_t most_squares_;
};

/// Of all pieces; nothing if some are not made of polynomials.
/// @param x  points of the level that has the pieces
std::optional<EstimatedSums> polynomial_sums(const LimitMap::Parts& parts, const Points& x) {
  const LimitMap::Parts::Pieces& pieces = parts.pieces();
  constexpr std::int64_t pieces_a_block = 32;
  PieceRules rules;
  const std::int64_t squares = std::max(least_squares, most_squares / std::max<std::int64_t>(parts.num_pieces(), 1));
  std::vector<EstimatedSums> blocks(size_t(num_blocks(parts.num_pieces(), pieces_a_block)));
  std::atomic<bool> is_complete{true};
  parallel_for_blocks(
      parts.num_pieces(),
      [&](std::int64_t block, std::int64_t begin, std::int64_t end) {
        Integrator integrator(rules, squares);
        for (std::int64_t i = begin; i < end && is_complete; ++i) {
          if (parts.sides(parts.piece(Index(i))) & LimitMap::Parts::hole) continue;
          const std::optional<EstimatedSums> sums =
              integrator.piece(*pieces.types[size_t(i)], pieces.points_of(Index(i), x));
          if (sums)
            blocks[size_t(block)] += *sums;
          else
            is_complete = false;
        }
      },
      pieces_a_block);
  if (!is_complete) return std::nullopt;
  EstimatedSums sums;
  for (const EstimatedSums& block : blocks) sums += block;
  return sums;
}

/// @param points  about their middle, of a size near 1
EstimatedSums sums_over(const LimitMap& surface, const Points& points) {
  const LimitMap::Parts& parts = surface.parts();
  const Points x = parts.points_of_pieces(points, "integrals");
  if (const std::optional<EstimatedSums> sums = polynomial_sums(parts, x)) return *sums;
  return refined_sums(parts.base(), x, parts.scheme);
}

}  // namespace

LimitIntegrals limit_integrals(const LimitMap& surface, const Points& points) {
  surface.parts().check_points(points, "integrals");
  check_finite_control(points);
  if (points.rows() == 0) return no_faces();
  const UnitBox box(points);
  return box.integrals(sums_over(surface, box.to_unit(points)), why_not_closed(surface), points);
}

}  // namespace sublimit
