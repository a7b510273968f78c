// SPDX-License-Identifier: Apache-2.0
#include "sublimit/tessellation/detail/flat_cells.h"

#include <Eigen/Dense>

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <iterator>
#include <limits>
#include <span>
#include <string>
#include <utility>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/detail/parallel_for.h"
#include "sublimit/base/error.h"
#include "sublimit/core/detail/finite_points.h"
#include "sublimit/nets/net_derivatives.h"
#include "sublimit/surface/detail/limit_map_parts.h"
#include "sublimit/surface/detail/limit_patches.h"
#include "sublimit/tessellation/detail/edge_rates.h"

namespace sublimit {
namespace {

double largest(const Points& net) { return net.rows() > 0 ? net.rowwise().norm().maxCoeff() : 0; }

/// Filip's bound on all of a net.
double chord_bound(const PolynomialBasis& basis, const Points& net) {
  const NetDerivatives x(basis, net, 2);
  return (largest(x.net(2, 0)) + 2 * largest(x.net(1, 1)) + largest(x.net(0, 2))) / 8;
}

/// Whether normals are nowhere farther apart: they are in the cone of the cross products of derivatives' coefficients.
bool is_within_angle(const PolynomialBasis& basis, const std::vector<Points>& nets, double angle) {
  std::vector<Eigen::Vector3d> normals;
  for (const Points& net : nets) {
    const NetDerivatives x(basis, net, 1);
    for (Eigen::Index i = 0; i < x.net(1, 0).rows(); ++i)
      for (Eigen::Index j = 0; j < x.net(0, 1).rows(); ++j) {
        const Eigen::Vector3d u = x.net(1, 0).row(i), v = x.net(0, 1).row(j);
        normals.push_back(u.cross(v).normalized());
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

/// How long sides of cells may be along the sides of an address.
class LongestSides {
 public:
  /// @param rates  for each edge, or none
  LongestSides(const LimitMap::Parts& parts, std::span<const Index> rates) : parts_(parts), rates_(rates) {}
  void go_to(Index address) {
    if (rates_.empty()) return;
    const std::array<SideEdge, 4> edges = side_edges(parts_.level.topology(), parts_.addresses, address);
    for (size_t k = 0; k < edges.size(); ++k) {
      const auto [of, edge] = edges[k];
      const Index rate = of == SideEdge::Of::none ? 1 : rates_[size_t(index(edge))];
      const Index segments = of == SideEdge::Of::whole ? rate : (rate + 1) / 2;
      longest_[k] = static_cast<std::int32_t>(cell_steps / std::int64_t(std::bit_ceil(unsigned(segments))));
    }
  }
  /// A side of the cell is along one of the address, and too long there.
  bool are_exceeded(const CellCorners& corners) const {
    if (rates_.empty()) return false;
    const bool triangle = parts_.addresses.triangles();
    const size_t n = triangle ? 3 : 4;
    for (size_t k = 0; k < n; ++k) {
      const CellCorner &a = corners[k], &b = corners[(k + 1) % n];
      const std::int32_t length = std::max(std::abs(a.i - b.i), std::abs(a.j - b.j));
      for (size_t s = 0; s < n; ++s)
        if (length > longest_[s] && is_on_side(a, s, triangle) && is_on_side(b, s, triangle)) return true;
    }
    return false;
  }

 private:
  static bool is_on_side(const CellCorner& c, size_t side, bool triangle) {
    if (side == 0) return c.j == 0;
    if (side == 1) return (triangle ? c.i + c.j : c.i) == cell_steps;
    return side == 2 && !triangle ? c.j == cell_steps : c.i == 0;
  }

  const LimitMap::Parts& parts_;
  std::span<const Index> rates_;
  std::array<std::int32_t, 4> longest_{};
};

class Cutter {
 public:
  /// @param count  of triangles that all cells become at least
  Cutter(const FlatCellOptions& options, const LimitMap::Parts& parts, std::atomic<std::int64_t>& count,
         std::vector<FlatCell>& out)
      : options_(options),
        triangles_a_cell_(parts.addresses.triangles() ? 1 : 2),
        count_(count),
        out_(out),
        longest_(parts, options.rates) {}

  void go_to(Index address) { longest_.go_to(address); }

  void cut(Index address, const PieceType& type, const Points& points, const CellCorners& corners) {
    if (type.polynomial()) {
      std::vector<PiecePart> whole;
      parts_.find(type, points, corners, 0, whole);
      if (options_.whole_polynomials)
        return add(
            {address, corners, 0,
             std::make_unique<WholePolynomial>(WholePolynomial{std::move(whole[0].nets), type.polynomial()->basis})});
      cut(address, parts_.nets(type.polynomial()->basis), type.polynomial()->basis, whole[0].nets, corners);
      return;
    }
    const double bound = bound_by_parts(type, points);
    if ((bound <= options_.chord && !longest_.are_exceeded(corners)) || is_smallest(corners))
      return add({address, corners, bound, nullptr});
    for (const PieceLink& link : type.children()) {
      const auto child = child_of(corners, link.map, type.kind() == Piece::Kind::triangle);
      if (!child)
        throw UnsupportedTopology(
            "faces next to a border of a dual scheme, or with knot intervals, are not cut into "
            "quarters; `limit -l N` has points of the limit there");
      cut(address, *link.type, child_points(link, points), *child);
    }
  }

 private:
  void add(FlatCell cell) {
    if ((count_ += triangles_a_cell_) > options_.max_triangles)
      throw ResourceError("more than " + std::to_string(options_.max_triangles) +
                          " triangles are needed; allow a larger distance or more triangles");
    out_.push_back(std::move(cell));
  }

  void cut(Index address, const BernsteinNets& nets, const PolynomialBasis& basis,
           const std::vector<Points>& coefficients, const CellCorners& corners) {
    double bound = 0;
    for (const Points& net : coefficients) bound = std::max(bound, chord_bound(basis, net));
    const bool bent = options_.angle > 0 && !is_within_angle(basis, coefficients, options_.angle);
    if ((bound <= options_.chord && !bent && !longest_.are_exceeded(corners)) || is_smallest(corners))
      return add({address, corners, bound, nullptr});
    for (int k = 0; k < 4; ++k) {
      std::vector<Points> quarter;
      for (const Points& net : coefficients) quarter.push_back(nets.quarter(k) * net);
      cut(address, nets, basis, quarter, quarter_of(corners, basis.total(), k));
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
          by_derivatives = std::max(by_derivatives, std::ldexp(chord_bound(*part.basis, net), 2 * part.depth));
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
  int triangles_a_cell_;
  std::atomic<std::int64_t>& count_;
  std::vector<FlatCell>& out_;
  LongestSides longest_;
  PieceParts parts_;
};

/// Cells below rounding are cut for nothing, until there are too many of them.
/// @throws InvalidParameter  a chord or an angle that is smaller than what points or normals are rounded to
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

}  // namespace

std::vector<FlatCell> flat_cells(const LimitMap& surface, const Points& points, const FlatCellOptions& options) {
  check_measurable_control(points);
  check_above_rounding(points, options);
  const LimitMap::Parts& parts = LimitPatches::parts_of(surface);
  if (!options.rates.empty()) check_edge_rates(parts.level.topology(), options.rates);
  // Differences alone count: about one of the points they keep their digits far from the origin.
  const AddressPieces pieces(surface, points.rows() > 0 ? Points(points.rowwise() - points.row(0)) : points);
  if (pieces.has_no_polynomials())
    throw UnsupportedTopology(
        "no piece of this scheme's limits is a polynomial, and only polynomials have bounds on second derivatives; "
        "`limit -l N` has points of the limit");
  constexpr std::int64_t addresses_a_block = 32;
  const Index addresses = surface.addresses().size();
  std::vector<std::vector<FlatCell>> blocks(size_t(num_blocks(addresses, addresses_a_block)));
  std::atomic<std::int64_t> count = 0;
  parallel_for_blocks(
      addresses,
      [&](std::int64_t block, std::int64_t begin, std::int64_t end) {
        Cutter cutter(options, parts, count, blocks[size_t(block)]);
        for (std::int64_t a = begin; a < end; ++a) {
          cutter.go_to(static_cast<Index>(a));
          pieces.visit(static_cast<Index>(a), [&](const PieceType& type, const Points& local, const CellCorners& c) {
            cutter.cut(static_cast<Index>(a), type, local, c);
          });
        }
      },
      addresses_a_block);
  std::vector<FlatCell> cells;
  for (std::vector<FlatCell>& block : blocks) std::ranges::move(block, std::back_inserter(cells));
  for (const FlatCell& cell : cells) {
    if (!cell.whole) continue;
    for (Points& net : cell.whole->nets) net.rowwise() += points.row(0);
  }
  return cells;
}

}  // namespace sublimit
