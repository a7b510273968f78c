// SPDX-License-Identifier: Apache-2.0
#include "sublimit/limit/limit_integrals.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>
#include <tuple>

#include "sublimit/base/error.h"
#include "sublimit/base/parallel_for.h"
#include "sublimit/limit/closed_surface.h"
#include "sublimit/limit/limit_patches.h"
#include "sublimit/limit/piece_hull.h"
#include "sublimit/limit/quadrature.h"

namespace sublimit {
namespace {

/// A piece whose points are so near to each other, relative to those that the descent began with, is left out: the
/// square, its area, is below the rounding of the whole.
constexpr double negligible = 0x1p-30;
/// Children that a piece may have been cut into before it is said that there will be more on every level: along a line.
constexpr int most_pieces = 1 << 12;
/// Of the area of a piece that squares may differ by when they are halved, and how often they are.
constexpr double area_tolerance = 2e-13;
constexpr int most_halvings = 16;

/// What is summed over pieces.
struct Sums {
  double area = 0, area_error = 0;
  Eigen::Vector3d of_area = Eigen::Vector3d::Zero();  ///< the position over the area
  double volume = 0;
  Eigen::Vector3d first = Eigen::Vector3d::Zero();
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();

  Sums& operator+=(const Sums& other) {
    area += other.area;
    area_error += other.area_error;
    of_area += other.of_area;
    volume += other.volume;
    first += other.first;
    second += other.second;
    return *this;
  }
};

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
    const Eigen::MatrixXd to_basis = nets_.from_basis().fullPivLu().inverse();
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
    return ours.fullPivLu().solve(theirs);
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
    const std::lock_guard lock(mutex_);
    return rules_.try_emplace({p.basis.degree(), p.basis.total(), halves}, p.basis, halves).first->second;
  }

 private:
  std::mutex mutex_;
  std::map<std::tuple<int, bool, bool>, PieceRule> rules_;
};

class Integrator {
 public:
  explicit Integrator(PieceRules& rules) : rules_(rules) {}

  Sums piece(const PieceType& type, const Points& points) {
    visited_ = 0;
    const double size = extent(points);
    sums_ = {};
    add(type, points, negligible * size, area_tolerance * size * size);
    return sums_;
  }

 private:
  static double extent(const Points& points) { return (points.rowwise() - points.row(0)).cwiseAbs().maxCoeff(); }

  void add(const PieceType& type, const Points& points, double enough, double tolerance) {
    if (const PiecePolynomial* p = type.polynomial()) {
      const Points differences = points.bottomRows(points.rows() - 1).rowwise() - points.row(0);
      const PieceRule& rule = rules_.of(*p);
      for (size_t half = 0; half < p->coefficients.size(); ++half)
        add(rule, rule.halves()[half] * (p->coefficients[half] * differences), points.row(0), tolerance);
      return;
    }
    if (type.types().has_no_polynomials())
      throw InvalidOption(
          type.types().scheme().name +
          ": its limit has no polynomial pieces, and integrals are known of those alone; catmull-clark, "
          "loop, doo-sabin and averaging have them");
    if (extent(points) <= enough) {
      sums_.area_error += extent(points) * extent(points);
      return;
    }
    if (++visited_ > most_pieces)
      throw UnsupportedTopology(
          "along borders or creases of this mesh this scheme's limit has no polynomial pieces, and integrals are "
          "known of those alone; catmull-clark, loop and doo-sabin have them there");
    // Those that another child is as well have a line of this piece's square only.
    for (const PieceLink& link : type.children())
      if (!link.map.is_repeated()) add(*link.type, child_points(link, points), enough, tolerance);
  }

  /// @param net  less the origin
  void add(const PieceRule& rule, const Columns& net, const Eigen::RowVector3d& origin, double tolerance) {
    const PieceRule::Nodes nodes = rule.nodes(net);
    const Columns x = nodes.x.rowwise() + origin;
    const Eigen::VectorXd flux = rule.weights().cwiseProduct(x.cwiseProduct(nodes.N).rowwise().sum());
    sums_.volume += flux.sum() / 3;
    sums_.first += x.transpose() * flux / 4;
    sums_.second += x.transpose() * flux.asDiagonal() * x / 5;
    add_area(rule, net, origin, area(rule, nodes), tolerance, 0);
  }

  /// The area, and the position over it.
  static Eigen::Vector4d area(const PieceRule& rule, const PieceRule::Nodes& nodes) {
    const Eigen::VectorXd dA = rule.weights().cwiseProduct(nodes.N.rowwise().norm());
    Eigen::Vector4d sum;
    sum << dA.sum(), nodes.x.transpose() * dA;
    return sum;
  }

  void add_area(const PieceRule& rule, const Columns& net, const Eigen::RowVector3d& origin,
                const Eigen::Vector4d& whole, double tolerance, int depth) {
    const auto accept = [&](const Eigen::Vector4d& sum, double error) {
      sums_.area += sum[0];
      sums_.of_area += sum.tail<3>() + sum[0] * origin.transpose();
      sums_.area_error += error;
    };
    if (whole[0] <= tolerance) return accept(whole, whole[0]);
    std::array<Columns, 4> nets;
    std::array<Eigen::Vector4d, 4> parts;
    Eigen::Vector4d sum = Eigen::Vector4d::Zero();
    for (int k = 0; k < 4; ++k) {
      nets[size_t(k)] = rule.quarter(k) * net;
      parts[size_t(k)] = area(rule, rule.nodes(nets[size_t(k)]));
      sum += parts[size_t(k)];
    }
    const double error = std::abs(sum[0] - whole[0]);
    if (error <= tolerance || depth == most_halvings) return accept(sum, error);
    for (int k = 0; k < 4; ++k) add_area(rule, nets[size_t(k)], origin, parts[size_t(k)], tolerance / 4, depth + 1);
  }

  Sums sums_;
  int visited_ = 0;
  PieceRules& rules_;
};

/// By a power of two, so that squares and fifth powers of coordinates neither overflow nor vanish.
double power_of_two(double size) { return size > 0 ? std::exp2(std::ilogb(size)) : 1; }

SolidIntegrals solid_of(const Sums& sums) {
  SolidIntegrals solid;
  solid.volume = sums.volume;
  solid.centroid = sums.first / sums.volume;
  const Eigen::Matrix3d central = sums.second - sums.volume * solid.centroid * solid.centroid.transpose();
  solid.inertia = central.trace() * Eigen::Matrix3d::Identity() - central;
  return solid;
}

/// @param points  about their middle, of a size near 1
Sums sums_over(const LimitSurface& surface, const Points& points) {
  const LimitSurface::Parts& parts = LimitPatches::parts_of(surface);
  const LimitSurface::Parts::Pieces& pieces = parts.pieces();
  const Points fine = parts.prepared ? Points(parts.prepared->S * points) : Points();
  const Points& x = parts.prepared ? fine : points;
  constexpr std::int64_t pieces_a_block = 32;
  PieceRules rules;
  std::vector<Sums> blocks(size_t(num_blocks(parts.num_pieces(), pieces_a_block)));
  parallel_for_blocks(
      parts.num_pieces(),
      [&](std::int64_t block, std::int64_t begin, std::int64_t end) {
        Integrator integrator(rules);
        for (std::int64_t i = begin; i < end; ++i) {
          if (parts.sides(parts.piece(Index(i))) & LimitSurface::Parts::hole) continue;
          const Points local = pieces.points_of(Index(i), x);
          blocks[size_t(block)] += integrator.piece(*pieces.types[size_t(i)], local);
        }
      },
      pieces_a_block);
  Sums sums;
  for (const Sums& block : blocks) sums += block;
  return sums;
}

}  // namespace

LimitIntegrals limit_integrals(const LimitSurface& surface, const Points& points) {
  const LimitSurface::Parts& parts = LimitPatches::parts_of(surface);
  if (points.cols() != 3 || points.rows() != parts.level.topology().num_vertices())
    throw InvalidParameter("integrals need a point of three coordinates for each vertex");
  if (!points.allFinite()) throw InvalidParameter("integrals need points that are finite");
  LimitIntegrals result;
  if (points.rows() == 0) {
    result.why_no_solid = "there are no faces";
    return result;
  }
  const Eigen::RowVector3d middle = points.colwise().minCoeff() / 2 + points.colwise().maxCoeff() / 2;
  const double scale = power_of_two((points.rowwise() - middle).cwiseAbs().maxCoeff());
  const Points centred = (points.rowwise() - middle) / scale;
  const Sums sums = sums_over(surface, centred);
  result.area = sums.area * scale * scale;
  result.area_error = sums.area_error * scale * scale;
  if (sums.area > 0) result.centroid = middle.transpose() + scale * sums.of_area / sums.area;
  result.why_no_solid = why_not_closed(surface);
  if (!result.why_no_solid.empty()) return result;
  if (std::abs(sums.volume) <= 1e-13 * sums.area) {
    result.why_no_solid = "the surface encloses no volume";
    return result;
  }
  SolidIntegrals solid = solid_of(sums);
  solid.volume *= scale * scale * scale;
  solid.centroid = middle.transpose() + scale * solid.centroid;
  solid.inertia *= std::pow(scale, 5);
  result.solid = solid;
  return result;
}

}  // namespace sublimit
