// SPDX-License-Identifier: Apache-2.0
#include "sublimit/tessellation/flat_cells.h"

#include <Eigen/Dense>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "sublimit/base/error.h"
#include "sublimit/base/parallel_for.h"
#include "sublimit/limit/limit_patches.h"
#include "sublimit/limit/piece_hull.h"

namespace sublimit {
namespace {

using Corners = std::array<CellCorner, 4>;

constexpr std::array<CellCorner, 4> square_corners{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
constexpr std::array<CellCorner, 3> triangle_corners{{{0, 0}, {1, 0}, {0, 1}}};

/// A place of a cell by its own parameters in halves (0, 1 or 2).
CellCorner at_halves(const Corners& c, bool triangle, int u, int v) {
  const auto mean = [&](auto part) {
    if (triangle) return ((2 - u - v) * part(c[0]) + u * part(c[1]) + v * part(c[2])) / 2;
    return ((2 - u) * ((2 - v) * part(c[0]) + v * part(c[3])) + u * ((2 - v) * part(c[1]) + v * part(c[2]))) / 4;
  };
  return {static_cast<std::int32_t>(mean([](const CellCorner& p) { return std::int64_t(p.i); })),
          static_cast<std::int32_t>(mean([](const CellCorner& p) { return std::int64_t(p.j); }))};
}

/// Where the corners of a child are in its parent, in halves; nothing if it is neither a quarter nor all of it.
struct ChildCorners {
  std::array<CellCorner, 4> halves;
  bool whole = false;
};
std::optional<ChildCorners> corners_of(const PieceMap& map) {
  ChildCorners found;
  if (map.is_triangle) {
    Eigen::Matrix3d to_child;
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) to_child(r, c) = map.barycentric[size_t(r)][size_t(c)];
    const Eigen::Matrix3d halves = 2 * to_child.inverse();  // columns: corners of the child
    if (!halves.isApprox(halves.array().round().matrix(), 1e-12)) return std::nullopt;
    for (int k = 0; k < 3; ++k) {
      found.halves[size_t(k)] = {static_cast<std::int32_t>(std::lround(halves(1, k))),
                                 static_cast<std::int32_t>(std::lround(halves(2, k)))};
    }
    return found;
  }
  if (map.radial) return std::nullopt;
  int whole = 0;
  for (size_t k = 0; k < 4; ++k) {
    std::array<int, 2> parent{-1, -1};
    for (size_t a = 0; a < 2; ++a) {
      const PieceMap::Axis& axis = map.axes[a];
      const int own = a == 0 ? square_corners[k].i : square_corners[k].j, x = axis.reversed ? 1 - own : own;
      if (axis.span == Span::whole) {
        parent[axis.from] = 2 * x;
        ++whole;
      } else if ((axis.span == Span::lower || axis.span == Span::upper) && axis.scale == 2) {
        parent[axis.from] = axis.span == Span::lower ? x : x + 1;
      } else {
        return std::nullopt;
      }
    }
    if (parent[0] < 0 || parent[1] < 0) return std::nullopt;
    found.halves[k] = {parent[0], parent[1]};
  }
  found.whole = whole == 8;
  return found;
}

class Cutter {
 public:
  Cutter(const FlatCellOptions& options, std::atomic<std::int64_t>& count, std::vector<FlatCell>& out)
      : options_(options), count_(count), out_(out) {}

  void cut(Index address, const PieceType& type, const Points& points, const Corners& corners) {
    if (const PiecePolynomial* p = type.polynomial()) {
      const Points differences = points.bottomRows(points.rows() - 1).rowwise() - points.row(0);
      const BernsteinNets& nets = nets_.try_emplace({p->basis.degree(), p->basis.total()}, p->basis).first->second;
      std::vector<Points> coefficients;  // of both halves of a piece that is cut in two, on all of it
      for (const RowMatrix& C : p->coefficients)
        coefficients.push_back((nets.from_basis() * (C * differences)).rowwise() + points.row(0));
      cut(address, nets, p->basis, coefficients, corners);
      return;
    }
    const bool triangle = type.kind() == Piece::Kind::triangle;
    const double bound = bound_by_parts(type, points);
    if (bound <= options_.chord || is_smallest(corners)) return add({address, corners, bound});
    for (const PieceLink& link : type.children()) {
      const std::optional<ChildCorners> child = corners_of(link.map);
      if (!child)
        throw UnsupportedTopology(
            type.types().scheme().name +
            ": faces next to a border of a dual scheme, or with knot intervals, are not cut into quarters; "
            "tessellate a refined mesh's limit (`limit -l`) instead");
      Corners of_child;
      for (size_t k = 0; k < 4; ++k) of_child[k] = at_halves(corners, triangle, child->halves[k].i, child->halves[k].j);
      cut(address, *link.type, child_points(link, points), of_child);
    }
  }

 private:
  /// Triangles that a cell becomes, at least.
  void add(const FlatCell& cell) {
    if (++count_ > options_.most) throw ResourceError("");  // told by the caller
    out_.push_back(cell);
  }

  static bool is_smallest(const Corners& c) { return std::abs(c[1].i - c[0].i) + std::abs(c[1].j - c[0].j) < 2; }

  void cut(Index address, const BernsteinNets& nets, const PolynomialBasis& basis,
           const std::vector<Points>& coefficients, const Corners& corners) {
    double bound = 0;
    for (const Points& net : coefficients) bound = std::max(bound, chord_bound(basis, net));
    const bool bent = options_.angle > 0 && !is_within_angle(basis, coefficients);
    if ((bound <= options_.chord && !bent) || is_smallest(corners)) return add({address, corners, bound});
    const bool triangle = basis.total();
    for (int k = 0; k < 4; ++k) {
      std::vector<Points> quarter;
      for (const Points& net : coefficients) quarter.push_back(nets.quarter(k) * net);
      Corners own;
      if (triangle) {
        // The middle one lies upside down.
        for (size_t m = 0; m < 3; ++m) {
          const int u = k == 3 ? 1 - triangle_corners[m].i : triangle_corners[m].i + (k & 1),
                    v = k == 3 ? 1 - triangle_corners[m].j : triangle_corners[m].j + (k >> 1);
          own[m] = at_halves(corners, true, u, v);
        }
        own[3] = own[0];
      } else {
        for (size_t m = 0; m < 4; ++m)
          own[m] = at_halves(corners, false, square_corners[m].i + (k & 1), square_corners[m].j + (k >> 1));
      }
      cut(address, nets, basis, quarter, own);
    }
  }

  /// Calls with every difference of neighbouring coefficients: rows one step along u and along v from each.
  template <class Visit>
  static void for_each_node(const PolynomialBasis& basis, const Visit& visit) {
    const int d = basis.degree();
    Eigen::Index row = 0;
    for (int i = 0; i <= d; ++i)
      for (int j = 0; j <= (basis.total() ? d - i : d); ++j, ++row) visit(i, j, row);
  }
  /// Row of node (i, j).
  static Eigen::Index node(const PolynomialBasis& basis, int i, int j) {
    const int d = basis.degree();
    return basis.total() ? i * (d + 1) - i * (i - 1) / 2 + j : i * (d + 1) + j;
  }

  static double chord_bound(const PolynomialBasis& basis, const Points& net) {
    const int d = basis.degree();
    const auto at = [&](int i, int j) { return net.row(node(basis, i, j)); };
    const bool total = basis.total();
    double uu = 0, uv = 0, vv = 0;
    for_each_node(basis, [&](int i, int j, Eigen::Index) {
      const int room_u = total ? d - i - j : d - i, room_v = total ? d - i - j : d - j;
      if (room_u >= 2) uu = std::max(uu, (at(i + 2, j) - 2 * at(i + 1, j) + at(i, j)).norm());
      if (room_v >= 2) vv = std::max(vv, (at(i, j + 2) - 2 * at(i, j + 1) + at(i, j)).norm());
      if (total ? room_u >= 2 : room_u >= 1 && room_v >= 1)
        uv = std::max(uv, (at(i + 1, j + 1) - at(i + 1, j) - at(i, j + 1) + at(i, j)).norm());
    });
    return (d * (d - 1) * (uu + vv) + 2 * (total ? d * (d - 1) : d * d) * uv) / 8;
  }

  /// Normals are in the cone of the cross products of derivatives' coefficients.
  bool is_within_angle(const PolynomialBasis& basis, const std::vector<Points>& coefficients) const {
    const int d = basis.degree();
    std::vector<Eigen::Vector3d> normals;
    for (const Points& net : coefficients) {
      std::vector<Eigen::Vector3d> along_u, along_v;
      for_each_node(basis, [&](int i, int j, Eigen::Index row) {
        const bool total = basis.total();
        if (total ? i + j < d : i < d) along_u.push_back(net.row(node(basis, i + 1, j)) - net.row(row));
        if (total ? i + j < d : j < d) along_v.push_back(net.row(node(basis, i, j + 1)) - net.row(row));
      });
      for (const Eigen::Vector3d& a : along_u)
        for (const Eigen::Vector3d& b : along_v) normals.push_back(a.cross(b).normalized());
    }
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    for (const Eigen::Vector3d& n : normals) mean += n;
    mean.normalize();
    const double least = std::cos(options_.angle / 2);
    return std::ranges::all_of(normals, [&](const Eigen::Vector3d& n) { return n.dot(mean) >= least; });
  }

  /// A part of a piece that is no polynomial: one that is, or one that is looked into no further.
  struct Part {
    Corners corners;  ///< in the piece, in steps of its own sides
    int depth = 0;
    const PolynomialBasis* basis = nullptr;
    Points net;  ///< coefficients, or points that it depends on
    double reach = 0;
  };
  /// Levels that are looked into below such a piece.
  static constexpr int part_levels = 6;

  void find_parts(const PieceType& type, const Points& points, const Corners& corners, int depth,
                  std::vector<Part>& parts) {
    if (const PiecePolynomial* p = type.polynomial()) {
      const Points differences = points.bottomRows(points.rows() - 1).rowwise() - points.row(0);
      const BernsteinNets& nets = nets_.try_emplace({p->basis.degree(), p->basis.total()}, p->basis).first->second;
      for (const RowMatrix& C : p->coefficients)
        parts.push_back(
            {corners, depth, &p->basis, (nets.from_basis() * (C * differences)).rowwise() + points.row(0), 0});
      return;
    }
    std::vector<std::pair<const PieceLink*, Corners>> children;
    if (depth < part_levels)
      for (const PieceLink& link : type.children()) {
        const std::optional<ChildCorners> child = corners_of(link.map);
        if (!child) break;
        Corners own;
        for (size_t k = 0; k < 4; ++k)
          own[k] = at_halves(corners, type.kind() == Piece::Kind::triangle, child->halves[k].i, child->halves[k].j);
        children.push_back({&link, own});
      }
    if (children.empty() || children.size() < type.children().size()) {
      parts.push_back({corners, depth, nullptr, points, type.reach()});
      return;
    }
    for (const auto& [link, own] : children)
      find_parts(*link->type, child_points(*link, points), own, depth + (corners_of(link->map)->whole ? 0 : 1), parts);
  }

  /// Chord of a piece that is no polynomial, by its parts: by second derivatives where all of them are polynomials and
  /// it is C^1; else by how far it is from some affine map A of its parameters. Triangles leave x as they leave x - A,
  /// whose values are no farther apart than the box of its coefficients is large. A may be any, near the surface.
  double bound_by_parts(const PieceType& type, const Points& points) {
    const bool triangle = type.kind() == Piece::Kind::triangle;
    Corners whole;
    for (size_t k = 0; k < 4; ++k) {
      const CellCorner c = triangle ? triangle_corners[k % 3] : square_corners[k];
      whole[k] = {c.i * cell_steps, c.j * cell_steps};
    }
    std::vector<Part> parts;
    find_parts(type, points, whole, 0, parts);
    const bool all_polynomials = std::ranges::all_of(parts, [](const Part& part) { return part.basis; });
    double by_derivatives = 0;
    if (all_polynomials && type.types().regular_smoothness() >= 1) {
      for (const Part& part : parts)
        by_derivatives = std::max(by_derivatives, std::ldexp(chord_bound(*part.basis, part.net), 2 * part.depth));
      if (by_derivatives <= options_.chord) return by_derivatives;
    } else {
      by_derivatives = HUGE_VAL;
    }
    const Eigen::Matrix3d A = affine_map(parts, whole, triangle);  // rows: constant, u, v
    const auto at = [&](double u, double v) { return Eigen::RowVector3d(Eigen::RowVector3d(1, u, v) * A); };
    Eigen::AlignedBox3d box;
    const auto extend = [&](const Eigen::RowVector3d& x) { box.extend(Eigen::Vector3d(x)); };
    for (const Part& part : parts) {
      const auto place = [&](double u, double v) {
        const Corners& c = part.corners;
        const size_t last = triangle ? 2 : 3;
        return at((c[0].i + u * (c[1].i - c[0].i) + v * (c[last].i - c[0].i)) / cell_steps,
                  (c[0].j + u * (c[1].j - c[0].j) + v * (c[last].j - c[0].j)) / cell_steps);
      };
      if (part.basis) {
        const double d = part.basis->degree();
        for_each_node(*part.basis,
                      [&](int i, int j, Eigen::Index row) { extend(part.net.row(row) - place(i / d, j / d)); });
        continue;
      }
      const Eigen::RowVector3d low = part.net.colwise().minCoeff(), high = part.net.colwise().maxCoeff(),
                               margin = part.reach * (high - low);
      for (const CellCorner& c : triangle ? std::span<const CellCorner>(triangle_corners) : square_corners) {
        extend(low - margin - place(c.i, c.j));
        extend(high + margin - place(c.i, c.j));
      }
    }
    return std::min(by_derivatives, box.isEmpty() ? 0 : box.diagonal().norm());
  }

  static Eigen::Matrix3d affine_map(const std::vector<Part>& parts, const Corners& whole, bool triangle) {
    std::array<Eigen::RowVector3d, 4> x;
    for (size_t k = 0; k < (triangle ? 3u : 4u); ++k) {
      x[k].setZero();
      for (const Part& part : parts)
        for (size_t m = 0; m < (triangle ? 3u : 4u); ++m)
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
  /// The surface at a corner of a part, or a point near it.
  static Eigen::RowVector3d corner_of(const Part& part, size_t corner, bool triangle) {
    if (!part.basis) return part.net.colwise().mean();
    const CellCorner c = triangle ? triangle_corners[corner] : square_corners[corner];
    const int d = part.basis->degree();
    return part.net.row(node(*part.basis, c.i * d, c.j * d));
  }

  const FlatCellOptions& options_;
  std::atomic<std::int64_t>& count_;
  std::vector<FlatCell>& out_;
  std::map<std::pair<int, bool>, BernsteinNets> nets_;
};

}  // namespace

std::vector<FlatCell> flat_cells(const LimitSurface& surface, const Points& points, const FlatCellOptions& options) {
  const LimitSurface::Parts& parts = LimitPatches::parts_of(surface);
  if (points.cols() != 3 || points.rows() != parts.level.topology().num_vertices())
    throw InvalidParameter("cells need a point of three coordinates for each vertex");
  const LimitSurface::Parts::Pieces& pieces = parts.pieces();
  if (parts.types->pieces().has_no_polynomials())
    throw UnsupportedTopology(
        parts.scheme.name +
        ": no piece of its limits is a polynomial, and only polynomials have bounds on second derivatives");
  const Points fine = parts.prepared ? Points(parts.prepared->S * points) : Points();
  const Points& x = parts.prepared ? fine : points;
  const bool triangles = parts.addresses.triangles();
  constexpr std::int64_t addresses_a_block = 32;
  std::vector<std::vector<FlatCell>> blocks(size_t(num_blocks(parts.addresses.size(), addresses_a_block)));
  std::atomic<std::int64_t> count = 0;
  Corners whole;
  for (size_t k = 0; k < 4; ++k) whole[k] = triangles ? triangle_corners[k % 3] : square_corners[k];
  for (CellCorner& c : whole) c = {c.i * cell_steps, c.j * cell_steps};
  const auto cut_address = [&](Cutter& cutter, Index a) {
    std::vector<Index> done;
    for (const double u : {0.25, 0.75})
      for (const double v : {0.25, 0.75}) {
        if (triangles && u + v > 1) continue;
        const Sample s{a, u, v};
        const LimitSurface::Parts::Target target = parts.target(s);
        if (parts.sides(target.piece) & LimitSurface::Parts::hole) continue;
        const Index piece = parts.number(s, target);
        if (std::ranges::find(done, piece) != done.end()) continue;
        done.push_back(piece);
        Corners corners = whole;
        if (target.map) {
          const std::optional<ChildCorners> own = corners_of(*target.map);
          for (size_t k = 0; k < 4; ++k) corners[k] = at_halves(whole, triangles, own->halves[k].i, own->halves[k].j);
        }
        const std::int64_t first = pieces.first[size_t(piece)], size = pieces.first[size_t(piece) + 1] - first;
        Points local(size, 3);
        for (std::int64_t j = 0; j < size; ++j) local.row(j) = x.row(pieces.vertices[size_t(first + j)]);
        cutter.cut(a, *pieces.types[size_t(piece)], local, corners);
      }
  };
  try {
    parallel_for_blocks(
        parts.addresses.size(),
        [&](std::int64_t block, std::int64_t begin, std::int64_t end) {
          Cutter cutter(options, count, blocks[size_t(block)]);
          for (std::int64_t a = begin; a < end; ++a) cut_address(cutter, static_cast<Index>(a));
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
