// SPDX-License-Identifier: Apache-2.0
#include "sublimit/tessellation/flat_cells.h"

#include <Eigen/Dense>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <span>
#include <string>
#include <utility>

#include "sublimit/base/error.h"
#include "sublimit/base/parallel_for.h"

namespace sublimit {
namespace {

/// Filip's bound on all of a net.
double chord_bound(const PolynomialBasis& basis, const Points& net) {
  const int d = basis.degree();
  const auto at = [&](int i, int j) { return net.row(net_row(basis, i, j)); };
  const bool total = basis.total();
  double uu = 0, uv = 0, vv = 0;
  for_each_net_row(basis, [&](int i, int j, Eigen::Index) {
    const int room_u = total ? d - i - j : d - i, room_v = total ? d - i - j : d - j;
    if (room_u >= 2) uu = std::max(uu, (at(i + 2, j) - 2 * at(i + 1, j) + at(i, j)).norm());
    if (room_v >= 2) vv = std::max(vv, (at(i, j + 2) - 2 * at(i, j + 1) + at(i, j)).norm());
    if (total ? room_u >= 2 : room_u >= 1 && room_v >= 1)
      uv = std::max(uv, (at(i + 1, j + 1) - at(i + 1, j) - at(i, j + 1) + at(i, j)).norm());
  });
  return (d * (d - 1) * (uu + vv) + 2 * (total ? d * (d - 1) : d * d) * uv) / 8;
}

/// Whether normals are nowhere farther apart: they are in the cone of the cross products of derivatives' coefficients.
bool is_within_angle(const PolynomialBasis& basis, const std::vector<Points>& nets, double angle) {
  const int d = basis.degree();
  std::vector<Eigen::Vector3d> normals;
  for (const Points& net : nets) {
    std::vector<Eigen::Vector3d> along_u, along_v;
    for_each_net_row(basis, [&](int i, int j, Eigen::Index row) {
      const bool total = basis.total();
      if (total ? i + j < d : i < d) along_u.push_back(net.row(net_row(basis, i + 1, j)) - net.row(row));
      if (total ? i + j < d : j < d) along_v.push_back(net.row(net_row(basis, i, j + 1)) - net.row(row));
    });
    for (const Eigen::Vector3d& a : along_u)
      for (const Eigen::Vector3d& b : along_v) normals.push_back(a.cross(b).normalized());
  }
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& n : normals) mean += n;
  mean.normalize();
  const double least = std::cos(angle / 2);
  return std::ranges::all_of(normals, [&](const Eigen::Vector3d& n) { return n.dot(mean) >= least; });
}

/// The surface at a corner of a part, or a point near it.
Eigen::RowVector3d corner_of(const PiecePart& part, size_t corner, bool triangle) {
  if (!part.polynomial) return part.points.colwise().mean();
  const CellCorner c = triangle ? triangle_corners[corner] : square_corners[corner];
  const int d = part.polynomial->basis.degree();
  return part.nets[0].row(net_row(part.polynomial->basis, c.i * d, c.j * d));
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

class Cutter {
 public:
  Cutter(const FlatCellOptions& options, std::atomic<std::int64_t>& count, std::vector<FlatCell>& out)
      : options_(options), count_(count), out_(out) {}

  void cut(Index address, const PieceType& type, const Points& points, const CellCorners& corners) {
    if (type.polynomial()) {
      std::vector<PiecePart> whole;
      parts_.find(type, points, corners, 0, whole);
      cut(address, parts_.nets(type.polynomial()->basis), type.polynomial()->basis, whole[0].nets, corners);
      return;
    }
    const double bound = bound_by_parts(type, points);
    if (bound <= options_.chord || is_smallest(corners)) return add({address, corners, bound});
    for (const PieceLink& link : type.children()) {
      const auto child = child_of(corners, link.map, type.kind() == Piece::Kind::triangle);
      if (!child)
        throw UnsupportedTopology(type.types().scheme().name +
                                  ": faces next to a border of a dual scheme, or with knot intervals, are not cut into "
                                  "quarters; `limit -l N` has points of the limit there");
      cut(address, *link.type, child_points(link, points), *child);
    }
  }

 private:
  void add(const FlatCell& cell) {
    if (++count_ > options_.most) throw ResourceError("");  // told by the caller
    out_.push_back(cell);
  }

  void cut(Index address, const BernsteinNets& nets, const PolynomialBasis& basis,
           const std::vector<Points>& coefficients, const CellCorners& corners) {
    double bound = 0;
    for (const Points& net : coefficients) bound = std::max(bound, chord_bound(basis, net));
    const bool bent = options_.angle > 0 && !is_within_angle(basis, coefficients, options_.angle);
    if ((bound <= options_.chord && !bent) || is_smallest(corners)) return add({address, corners, bound});
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
        std::ranges::all_of(parts, [](const PiecePart& part) { return part.polynomial; })) {
      by_derivatives = 0;
      for (const PiecePart& part : parts)
        for (const Points& net : part.nets)
          by_derivatives =
              std::max(by_derivatives, std::ldexp(chord_bound(part.polynomial->basis, net), 2 * part.depth));
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
        const double d = part.polynomial->basis.degree();
        for_each_net_row(part.polynomial->basis,
                         [&](int i, int j, Eigen::Index row) { extend(part, net.row(row), i / d, j / d); });
      }
      if (part.polynomial) continue;
      const Eigen::RowVector3d low = part.points.colwise().minCoeff(), high = part.points.colwise().maxCoeff(),
                               margin = part.type->reach() * (high - low);
      for (const CellCorner& c : triangle ? std::span<const CellCorner>(triangle_corners) : square_corners) {
        extend(part, low - margin, c.i, c.j);
        extend(part, high + margin, c.i, c.j);
      }
    }
    return std::min(by_derivatives, box.isEmpty() ? 0 : box.diagonal().norm());
  }

  const FlatCellOptions& options_;
  std::atomic<std::int64_t>& count_;
  std::vector<FlatCell>& out_;
  PieceParts parts_;
};

}  // namespace

std::vector<FlatCell> flat_cells(const LimitSurface& surface, const Points& points, const FlatCellOptions& options) {
  const AddressPieces pieces(surface, points);
  if (pieces.has_no_polynomials())
    throw UnsupportedTopology(
        pieces.scheme() +
        ": no piece of its limits is a polynomial, and only polynomials have bounds on second derivatives");
  constexpr std::int64_t addresses_a_block = 32;
  const Index addresses = surface.addresses().size();
  std::vector<std::vector<FlatCell>> blocks(size_t(num_blocks(addresses, addresses_a_block)));
  std::atomic<std::int64_t> count = 0;
  try {
    parallel_for_blocks(
        addresses,
        [&](std::int64_t block, std::int64_t begin, std::int64_t end) {
          Cutter cutter(options, count, blocks[size_t(block)]);
          for (std::int64_t a = begin; a < end; ++a)
            pieces.visit(static_cast<Index>(a), [&](const PieceType& type, const Points& local, const CellCorners& c) {
              cutter.cut(static_cast<Index>(a), type, local, c);
            });
        },
        addresses_a_block);
  } catch (const ResourceError&) {
    if (count <= options.most) throw;
    throw ResourceError("more than " + std::to_string(options.most) +
                        " cells are needed; allow a larger distance or more triangles");
  }
  std::vector<FlatCell> cells;
  for (std::vector<FlatCell>& block : blocks) cells.insert(cells.end(), block.begin(), block.end());
  return cells;
}

}  // namespace sublimit
