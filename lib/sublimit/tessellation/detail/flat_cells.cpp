// SPDX-License-Identifier: Apache-2.0
#include "sublimit/tessellation/detail/flat_cells.h"

#include <Eigen/Dense>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/detail/parallel_for.h"
#include "sublimit/base/error.h"
#include "sublimit/core/detail/bernstein.h"
#include "sublimit/core/detail/finite_points.h"
#include "sublimit/nets/net_derivatives.h"

namespace sublimit {
namespace {

double largest(const Eigen::Ref<const Points, 0, Eigen::OuterStride<>>& net) { return net.rowwise().norm().maxCoeff(); }

/// Bounds on the first and second derivatives of a part.
struct DerivativeBounds {
  double u = 0, v = 0, uu = 0, uv = 0, vv = 0;
  double chord() const { return (uu + 2 * uv + vv) / 8; }
};

/// N and w of a rational part x = N / w, about a point o in the middle of its control points: x - o = N / w.
Points about_middle(Points net) {
  Eigen::AlignedBox3d box;
  for (Eigen::Index i = 0; i < net.rows(); ++i) box.extend(net_point(net, i));
  net.leftCols(3) -= net.col(3) * box.center().transpose();
  return net;
}

/// By the quotient rule, term by term: w x_u = N_u - w_u x, and so on, with |x| <= r.
DerivativeBounds quick_bounds(const PolynomialBasis& basis, const Points& net) {
  double r = 0;
  for (Eigen::Index i = 0; i < net.rows(); ++i) r = std::max(r, net_point(net, i).norm());
  const double w = net.col(3).minCoeff();
  const NetDerivatives x(basis, net, 2);
  const auto numerator = [&](int du, int dv) { return largest(x.net(du, dv).leftCols(3)); };
  const auto weight = [&](int du, int dv) { return largest(x.net(du, dv).rightCols(1)); };
  const double wu = weight(1, 0), wv = weight(0, 1);
  DerivativeBounds bounds;
  bounds.u = (numerator(1, 0) + wu * r) / w;
  bounds.v = (numerator(0, 1) + wv * r) / w;
  bounds.uu = (numerator(2, 0) + weight(2, 0) * r + 2 * wu * bounds.u) / w;
  bounds.uv = (numerator(1, 1) + weight(1, 1) * r + wu * bounds.v + wv * bounds.u) / w;
  bounds.vv = (numerator(0, 2) + weight(0, 2) * r + 2 * wv * bounds.v) / w;
  return bounds;
}

/// By the numerators of derivatives as polynomials, whose terms cancel: with A = w N_u - N w_u, x_u = A / w^2,
/// x_uu = (w A_u - 2 A w_u) / w^3 and x_uv = (w A_v - 2 A w_v) / w^3. Smaller than `quick_bounds`, but they take
/// longer.
DerivativeBounds close_bounds(const PolynomialBasis& basis, const Points& net) {
  using Polynomial = Bernstein<double>;
  const int d = basis.degree();
  constexpr int most_degree = 20;  // products of three are of degree 60, up to which binomial coefficients are exact
  if (d > most_degree) return quick_bounds(basis, net);
  const auto column = [&](int k) {
    Polynomial p(net_shape(basis), d, d);
    for_each_net_row(basis, [&](int i, int j, Eigen::Index row) { p(i, j) = net(row, k); });
    return p;
  };
  const Polynomial w = column(3), wu = w.du(), wv = w.dv();
  const auto minus = [](Polynomial a, const Polynomial& b, double factor) {
    for (size_t k = 0; k < a.coefficients().size(); ++k) a.coefficients()[k] -= factor * b.coefficients()[k];
    return a;
  };
  const double least = net.col(3).minCoeff(), cube = least * least * least;
  std::array<Eigen::ArrayXd, 5> squares;  // of the norms of coefficients, summed over x, y, z
  const auto add = [&](size_t which, const Polynomial& p) {
    const Eigen::ArrayXd c =
        Eigen::Map<const Eigen::ArrayXd>(p.coefficients().data(), Eigen::Index(p.coefficients().size()));
    squares[which] = squares[which].size() == 0 ? c.square().eval() : (squares[which] + c.square()).eval();
  };
  for (int k = 0; k < 3; ++k) {
    const Polynomial N = column(k), A = minus(w * N.du(), N * wu, 1), B = minus(w * N.dv(), N * wv, 1);
    add(0, A);
    add(1, B);
    add(2, minus(w * A.du(), A * wu, 2));
    add(3, minus(w * A.dv(), A * wv, 2));
    add(4, minus(w * B.dv(), B * wv, 2));
  }
  const auto bound = [&](size_t which) { return std::sqrt(squares[which].maxCoeff()); };
  return {.u = bound(0) / (least * least),
          .v = bound(1) / (least * least),
          .uu = bound(2) / cube,
          .uv = bound(3) / cube,
          .vv = bound(4) / cube};
}

/// Filip's bound on all of a net.
/// @param enough  a bound below which no better one is looked for
double chord_bound(const PolynomialBasis& basis, const Points& net, double enough) {
  if (net.cols() == 4) {
    const Points centred = about_middle(net);
    const double quick = quick_bounds(basis, centred).chord();
    return quick <= enough ? quick : std::min(quick, close_bounds(basis, centred).chord());
  }
  const NetDerivatives x(basis, net, 2);
  const auto second = [&](int du, int dv) { return largest(x.net(du, dv).leftCols(3)); };
  return (second(2, 0) + 2 * second(1, 1) + second(0, 2)) / 8;
}

/// Whether normals of a rational part are nowhere farther apart: x_u and x_v leave what they are in the middle by no
/// more than second derivatives let them.
bool is_rational_within_angle(const PolynomialBasis& basis, const Points& net, double angle) {
  const DerivativeBounds bounds = close_bounds(basis, about_middle(net));
  const double middle = basis.total() ? 1. / 3 : 0.5;
  const NetDerivatives::Jet at = NetDerivatives(basis, net, 1).at(middle, middle);
  const double w = at.x[3], far = basis.total() ? 2. / 3 : 0.5;
  const Eigen::Vector3d x = at.x.head<3>() / w, u = (at.u.head<3>() - at.u[3] * x) / w,
                        v = (at.v.head<3>() - at.v[3] * x) / w;
  const double du = far * (bounds.uu + bounds.uv), dv = far * (bounds.uv + bounds.vv);
  return u.norm() * dv + v.norm() * du + du * dv <= std::sin(std::min(angle, std::numbers::pi) / 2) * u.cross(v).norm();
}

/// Whether normals are nowhere farther apart: they are in the cone of the cross products of derivatives' coefficients.
bool is_within_angle(const PolynomialBasis& basis, const std::vector<Points>& nets, double angle) {
  if (nets[0].cols() == 4) return is_rational_within_angle(basis, nets[0], angle);
  std::vector<Eigen::Vector3d> normals;
  for (const Points& net : nets) {
    const NetDerivatives x(basis, net, 1);
    const NetDerivatives::Coefficients in_u = x.net(1, 0), in_v = x.net(0, 1);
    for (Eigen::Index i = 0; i < in_u.rows(); ++i) {
      const Eigen::Vector3d u = in_u.row(i).head<3>();
      for (Eigen::Index j = 0; j < in_v.rows(); ++j) {
        const Eigen::Vector3d v = in_v.row(j).head<3>();
        normals.push_back(u.cross(v).normalized());
      }
    }
  }
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& n : normals) mean += n;
  mean.normalize();
  const double least = std::cos(angle / 2);
  return std::ranges::all_of(normals, [&](const Eigen::Vector3d& n) { return n.dot(mean) >= least; });
}

/// The surface at a corner of a part, or a point near it.
Eigen::RowVector3d corner_of(const PiecePart& part, size_t corner, bool triangle) {
  if (!part.basis) return part.points.colwise().mean();
  const CellCorner c = triangle ? triangle_corners[corner] : square_corners[corner];
  const int d = part.basis->degree();
  return part.nets[0].row(net_row(*part.basis, c.i * d, c.j * d));
}

/// Rows constant, u, v: a map that is near a piece of these parts.
Eigen::Matrix3d affine_map(const std::vector<PiecePart>& parts, const CellCorners& whole, bool triangle) {
  const size_t corners = triangle ? 3 : 4;
  std::array<Eigen::RowVector3d, 4> x;
  for (size_t k = 0; k < corners; ++k) {
    x[k].setZero();
    for (const PiecePart& part : parts)
      for (size_t m = 0; m < corners; ++m)
        if (part.corners[m] == whole[k]) x[k] = corner_of(part, m, triangle);
  }
  Eigen::Matrix3d A;
  if (triangle) {
    A << x[0], x[1] - x[0], x[2] - x[0];
  } else {
    const Eigen::RowVector3d u = (x[1] + x[2] - x[0] - x[3]) / 2, v = (x[2] + x[3] - x[0] - x[1]) / 2;
    A << (x[0] + x[1] + x[2] + x[3]) / 4 - (u + v) / 2, u, v;
  }
  return A;
}

/// True if a side of a part is one point, up to rounding.
/// @param size  of the part
bool has_pole(const PiecePart& part, double size) {
  const bool triangle = part.is_triangle();
  const int d = part.basis->degree();
  constexpr double rounding = 1e-12;  // of the size
  for (size_t side = 0; side < (triangle ? 3 : 4); ++side) {
    std::optional<Eigen::Vector3d> first;
    double length = 0;
    for_each_net_row(*part.basis, [&](int i, int j, Eigen::Index row) {
      const bool on_side = side == 0                ? j == 0
                           : side == 1              ? (triangle ? i + j : i) == d
                           : side == 2 && !triangle ? j == d
                                                    : i == 0;
      if (!on_side) return;
      const Eigen::Vector3d x = net_point(part.nets[0], row);
      if (!first) first = x;
      length = std::max(length, (x - *first).norm());
    });
    if (length <= rounding * size) return true;
  }
  return false;
}

class Cutter {
 public:
  /// @param count  of triangles that all cells become at least
  Cutter(const FlatCellOptions& options, bool triangles, std::atomic<std::int64_t>& count, std::vector<FlatCell>& out)
      : options_(options), triangle_(triangles), count_(count), out_(out) {}

  void cut_face(Index address, const FindParts& find_parts) {
    address_ = address;
    if (options_.longest_sides) longest_ = options_.longest_sides(address);
    std::vector<PiecePart> parts;
    find_parts(address, parts_, parts);
    for (PiecePart& part : parts) cut(std::move(part));
  }

 private:
  void add(FlatCell cell) {
    if ((count_ += triangle_ ? 1 : 2) > options_.max_triangles)
      throw ResourceError("more than " + std::to_string(options_.max_triangles) +
                          " triangles are needed; allow a larger distance or more triangles");
    out_.push_back(std::move(cell));
  }

  /// A side of the cell is along one of the address, and too long there.
  bool is_too_long(const CellCorners& corners) const {
    if (!options_.longest_sides) return false;
    const size_t n = triangle_ ? 3 : 4;
    for (size_t k = 0; k < n; ++k) {
      const CellCorner &a = corners[k], &b = corners[(k + 1) % n];
      const std::int32_t length = std::max(std::abs(a.i - b.i), std::abs(a.j - b.j));
      for (size_t s = 0; s < n; ++s)
        if (length > longest_[s] && is_on_side(a, s, triangle_) && is_on_side(b, s, triangle_)) return true;
    }
    return false;
  }

  /// Around a pole normals turn however small the cell is: below the chord it has whatever normals it has.
  bool is_bent(const PiecePart& part) const {
    if (!(options_.angle > 0) || is_within_angle(*part.basis, part.nets, options_.angle)) return false;
    Eigen::AlignedBox3d box;
    for (Eigen::Index i = 0; i < part.nets[0].rows(); ++i) box.extend(net_point(part.nets[0], i));
    return !has_pole(part, box.diagonal().norm()) || box.diagonal().norm() > options_.chord;
  }

  void cut(PiecePart part) {
    if (!part.basis) return cut(*part.type, part.points, part.corners);
    if (options_.whole_polynomials)
      return add({address_, part.corners, 0,
                  std::make_unique<WholePolynomial>(WholePolynomial{std::move(part.nets), *part.basis})});
    double bound = 0;
    for (const Points& net : part.nets) bound = std::max(bound, chord_bound(*part.basis, net, options_.chord));
    if ((bound <= options_.chord && !is_bent(part) && !is_too_long(part.corners)) || is_smallest(part.corners))
      return add({address_, part.corners, bound, nullptr});
    for (int k = 0; k < 4; ++k) cut(parts_.quarter(part, k));
  }

  void cut(const PieceType& type, const Points& points, const CellCorners& corners) {
    const double bound = bound_by_parts(type, points);
    if ((bound <= options_.chord && !is_too_long(corners)) || is_smallest(corners))
      return add({address_, corners, bound, nullptr});
    for (const PieceLink& link : type.children()) {
      const auto child = child_of(corners, link.map, type.kind() == Piece::Kind::triangle);
      if (!child)
        throw UnsupportedTopology(
            "faces next to a border of a dual scheme, or with knot intervals, are not cut into "
            "quarters; `limit -l N` has points of the limit there");
      std::vector<PiecePart> parts;
      parts_.find(*link.type, child_points(link, points), *child, 0, parts);
      for (PiecePart& part : parts) cut(std::move(part));
    }
  }

  /// Chord of a piece that is no polynomial, by its parts: by second derivatives where all of them are polynomials and
  /// it is C^1; else by how far it is from some affine map A of its parameters. Triangles leave x as they leave x - A,
  /// whose values are no farther apart than the box of its coefficients is large. A may be any, near the surface.
  double bound_by_parts(const PieceType& type, const Points& points) {
    constexpr int levels = 6;
    const bool triangle = type.kind() == Piece::Kind::triangle;
    const CellCorners whole = whole_cell(triangle);
    std::vector<PiecePart> parts;
    parts_.find(type, points, whole, levels, parts);
    double by_derivatives = HUGE_VAL;
    if (type.types().regular_smoothness() >= 1 &&
        std::ranges::all_of(parts, [](const PiecePart& part) { return part.basis.has_value(); })) {
      by_derivatives = 0;
      for (const PiecePart& part : parts)
        for (const Points& net : part.nets)
          by_derivatives = std::max(by_derivatives, std::ldexp(chord_bound(*part.basis, net, 0), 2 * part.depth));
      if (by_derivatives <= options_.chord) return by_derivatives;
    }
    const Eigen::Matrix3d A = affine_map(parts, whole, triangle);
    Eigen::AlignedBox3d box;
    const auto extend = [&](const PiecePart& part, const Eigen::RowVector3d& x, double u, double v) {
      const auto [s, t] = at_place(part.corners, triangle, u, v);
      box.extend(Eigen::Vector3d(x - Eigen::RowVector3d(1, s, t) * A));
    };
    for (const PiecePart& part : parts) {
      for (const Points& net : part.nets) {
        const double d = part.basis->degree();
        for_each_net_row(*part.basis,
                         [&](int i, int j, Eigen::Index row) { extend(part, net.row(row), i / d, j / d); });
      }
      if (part.basis) continue;
      if (part.type->reach() > 0)
        throw UnsupportedTopology(
            "this scheme has negative weights where its limit is no polynomial, so what holds the limit there is an "
            "estimate, and no distance is proved; `limit -l N` has points of it");
      for (const CellCorner& c : triangle ? std::span<const CellCorner>(triangle_corners) : square_corners) {
        extend(part, part.points.colwise().minCoeff(), c.i, c.j);
        extend(part, part.points.colwise().maxCoeff(), c.i, c.j);
      }
    }
    return std::min(by_derivatives, box.isEmpty() ? 0 : box.diagonal().norm());
  }

  const FlatCellOptions& options_;
  bool triangle_;
  std::atomic<std::int64_t>& count_;
  std::vector<FlatCell>& out_;
  std::array<std::int32_t, 4> longest_{};
  Index address_ = 0;
  PieceParts parts_;
};

}  // namespace

void check_above_rounding(const Points& points, const FlatCellOptions& options) {
  constexpr double eps = std::numeric_limits<double>::epsilon();
  const double rounding = points.size() > 0 ? eps * points.cwiseAbs().maxCoeff() : 0;
  if (options.chord < rounding)
    throw InvalidParameter("the chord is " + format_number(options.chord) + ", and control points are rounded to " +
                           format_number(rounding) + "; a larger distance is right");
  if (options.angle > 0 && options.angle < eps)
    throw InvalidParameter("the angle is " + format_number(options.angle) + " radians, and normals are rounded to " +
                           format_number(eps) + "; a larger one is right, or 0 for any");
}

std::vector<FlatCell> flat_cells(FaceCount faces, const FindParts& find_parts, const FlatCellOptions& options) {
  constexpr std::int64_t faces_a_block = 32;
  std::vector<std::vector<FlatCell>> blocks(size_t(num_blocks(faces.size, faces_a_block)));
  std::atomic<std::int64_t> count = 0;
  parallel_for_blocks(
      faces.size,
      [&](std::int64_t block, std::int64_t begin, std::int64_t end) {
        Cutter cutter(options, faces.triangles, count, blocks[size_t(block)]);
        for (std::int64_t a = begin; a < end; ++a) cutter.cut_face(static_cast<Index>(a), find_parts);
      },
      faces_a_block);
  std::vector<FlatCell> cells;
  for (std::vector<FlatCell>& block : blocks) std::ranges::move(block, std::back_inserter(cells));
  return cells;
}

std::vector<FlatCell> flat_cells(const LimitMap& surface, const Points& points, const FlatCellOptions& options) {
  check_measurable_control(points);
  check_above_rounding(points, options);
  // Differences alone count: about one of the points they keep their digits far from the origin.
  const AddressPieces pieces(surface, points.rows() > 0 ? Points(points.rowwise() - points.row(0)) : points);
  if (pieces.has_no_polynomials())
    throw UnsupportedTopology(
        "no piece of this scheme's limits is a polynomial, and only polynomials have bounds on second derivatives; "
        "`limit -l N` has points of the limit");
  std::vector<FlatCell> cells = flat_cells(
      surface.faces(),
      [&](Index face, PieceParts& cutter, std::vector<PiecePart>& out) {
        pieces.visit(face, [&](const PieceType& type, const Points& local, const CellCorners& corners) {
          cutter.find(type, local, corners, 0, out);
        });
      },
      options);
  for (const FlatCell& cell : cells) {
    if (!cell.whole) continue;
    for (Points& net : cell.whole->nets) net.rowwise() += points.row(0);
  }
  return cells;
}

}  // namespace sublimit
