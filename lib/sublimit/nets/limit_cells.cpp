// SPDX-License-Identifier: Apache-2.0
#include "sublimit/nets/limit_cells.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "sublimit/base/detail/parallel_for.h"
#include "sublimit/base/error.h"
#include "sublimit/core/detail/finite_points.h"
#include "sublimit/neighborhood/piece_rows.h"
#include "sublimit/nets/hull_cell.h"
#include "sublimit/nets/piece_hull.h"
#include "sublimit/surface/detail/limit_patches.h"

namespace sublimit {
namespace {

/// At most so many cells of an address, but for the pieces of polygons' corners and of rotating schemes.
constexpr int most_parts = 64;
/// The same where pieces towards extraordinary vertices and borders are cut: their hulls are wide.
constexpr int most_children = 256;
/// Places a side of an address, by which cells know where they are.
constexpr int places_a_side = 8;

/// A place of the address, and where it is in the piece at hand.
struct Known {
  Place sample;
  PieceCoordinates place;
};

class Cutter {
 public:
  explicit Cutter(std::vector<LimitCell>& out) : out_(out) {}

  /// @param known  not empty
  void cut(const PieceType& type, const Points& points, const std::vector<Known>& known, int parts) {
    if (const PiecePolynomial* p = type.polynomial()) {
      const BernsteinNets& nets = nets_of(p->basis);
      cut(nets, p->basis.total(), polynomial_nets(*p, nets.from_basis(), points), known, parts);
      return;
    }
    const std::deque<PieceLink>& children = type.children();
    if (parts * int(children.size()) <= (type.types().has_no_polynomials() ? most_parts : most_children)) {
      for (const PieceLink& link : children) {
        std::vector<Known> all;
        for (const Known& k : known) all.push_back({k.sample, link.map(k.place)});
        const std::vector<Known> inside = those_inside(all, link.type->kind() == Piece::Kind::triangle);
        cut(*link.type, child_points(link, points), inside, parts * int(children.size()));
      }
      return;
    }
    const Middle start = middle(known, type.kind() == Piece::Kind::triangle, parts);
    Hull hull;
    if (type.types().has_no_polynomials()) {
      const Points differences = points.bottomRows(points.rows() - 1).rowwise() - points.row(0);
      const Points seen = (limits_of(type) * differences).rowwise() + points.row(0);
      for (Eigen::Index i = 0; i < seen.rows(); ++i) hull.push_back(seen.row(i));
      out_.push_back(hull_cell(hull, start.place, start.radius, 0.25, 0.02));
    } else {
      for (Eigen::Index i = 0; i < points.rows(); ++i) hull.push_back(points.row(i));
      out_.push_back(hull_cell(hull, start.place, start.radius, type.reach(), 0));
    }
  }

 private:
  void cut(const BernsteinNets& nets, bool triangle, const std::vector<Points>& coefficients,
           const std::vector<Known>& known, int parts) {
    Hull hull;
    for (const Points& net : coefficients)
      for (Eigen::Index i = 0; i < net.rows(); ++i) hull.push_back(net.row(i));
    const Middle start = middle(known, triangle, parts);
    const LimitCell cell = hull_cell(hull, start.place, start.radius);
    if (4 * parts > most_parts || (cell.is_thin() && !turns(coefficients, triangle))) {
      out_.push_back(cell);
      return;
    }
    for (int k = 0; k < 4; ++k) {
      std::vector<Points> quarter;
      for (const Points& net : coefficients) quarter.push_back(nets.quarter(k) * net);
      std::vector<Known> all;
      for (const Known& one : known) {
        const Eigen::Vector2d p = BernsteinNets::in_quarter(k, triangle, one.place.u, one.place.v);
        all.push_back({one.sample, triangle ? triangle_place(p.x(), p.y()) : quad_place(p.x(), p.y())});
      }
      const std::vector<Known> inside = those_inside(all, triangle);
      cut(nets, triangle, quarter, inside, 4 * parts);
    }
  }

  /// Or, of a cell without one, the place that is closest to it.
  static std::vector<Known> those_inside(const std::vector<Known>& all, bool triangle) {
    const auto outside = [&](const Known& k) {
      const PieceCoordinates& p = k.place;
      return -std::min({p.u, p.v, p.u1, triangle ? 1.0 : p.v1});
    };
    std::vector<Known> result;
    for (const Known& k : all)
      if (outside(k) <= 0) result.push_back(k);
    if (result.empty())
      result.push_back(*std::min_element(all.begin(), all.end(),
                                         [&](const Known& a, const Known& b) { return outside(a) < outside(b); }));
    return result;
  }

  /// A start in the middle, and how far the cell goes from there, by the places known in it.
  struct Middle {
    Place place;
    double radius = 0;
  };
  static Middle middle(const std::vector<Known>& known, bool triangle, int parts) {
    const double centre = triangle ? 1. / 3 : 0.5;
    const auto off = [&](const Known& k) {
      return std::max(std::abs(k.place.u - centre), std::abs(k.place.v - centre));
    };
    const Place start = std::min_element(known.begin(), known.end(), [&](const Known& a, const Known& b) {
                          return off(a) < off(b);
                        })->sample;
    double radius = 0.5 / std::sqrt(double(parts));
    for (const Known& k : known)
      radius = std::max({radius, std::abs(k.sample.u - start.u), std::abs(k.sample.v - start.v)});
    return {start, radius + 1.0 / places_a_side};
  }

  /// Rows of a net of places all over the piece, in differences.
  const RowMatrix& limits_of(const PieceType& type) {
    const auto [at, is_new] = limits_.try_emplace(&type);
    if (!is_new) return at->second;
    constexpr int steps = 4;
    const bool triangle = type.kind() == Piece::Kind::triangle;
    std::vector<RowMatrix> rows;
    for (int j = 0; j <= steps; ++j)
      for (int i = 0; i <= (triangle ? steps - j : steps); ++i) {
        const double u = double(i) / steps, v = double(j) / steps;
        rows.push_back(piece_rows(type, triangle ? triangle_place(u, v) : quad_place(u, v), 0).rows);
      }
    at->second.resize(Eigen::Index(rows.size()), type.num_slots() - 1);
    for (size_t i = 0; i < rows.size(); ++i) at->second.row(Eigen::Index(i)) = rows[i].row(0);
    return at->second;
  }

  const BernsteinNets& nets_of(const PolynomialBasis& basis) {
    return nets_.try_emplace({basis.degree(), basis.total()}, basis).first->second;
  }

  std::vector<LimitCell>& out_;
  std::map<std::pair<int, bool>, BernsteinNets> nets_;
  std::map<const PieceType*, RowMatrix> limits_;
};

}  // namespace

std::vector<LimitCell> limit_cells(const LimitMap& surface, const Points& points) {
  const LimitMap::Parts& parts = surface.parts();
  const Points x = parts.points_of_pieces(points, "cells");
  check_finite_control(points);
  const LimitMap::Parts::Pieces& pieces = parts.pieces();
  const Index count = parts.addresses.size();
  const bool triangles = parts.addresses.triangles();
  constexpr std::int64_t addresses_a_block = 32;
  std::vector<std::vector<LimitCell>> blocks(size_t(num_blocks(count, addresses_a_block)));
  parallel_for_blocks(
      count,
      [&](std::int64_t block, std::int64_t begin, std::int64_t end) {
        Cutter cutter(blocks[size_t(block)]);
        for (std::int64_t a = begin; a < end; ++a) {
          std::map<Index, std::vector<Known>> known;  // by piece
          for (int j = 0; j < places_a_side; ++j)
            for (int i = 0; i < (triangles ? places_a_side - j : places_a_side); ++i) {
              // Short numbers, and off the middle lines: there second derivatives may jump.
              const double off = triangles ? 0.3125 : 0.4375;
              const Place s{Index(a), (i + off) / places_a_side, (j + off) / places_a_side};
              const LimitMap::Parts::Target target = parts.target(s);
              if (parts.sides(target.piece) & LimitMap::Parts::hole) continue;
              known[parts.number(s, target)].push_back({s, target.place});
            }
          for (const auto& [piece, places] : known) {
            const Points local = pieces.points_of(piece, x);
            cutter.cut(*pieces.types[size_t(piece)], local, places, int(known.size()));
          }
        }
      },
      addresses_a_block);
  std::vector<LimitCell> cells;
  for (std::vector<LimitCell>& block : blocks) cells.insert(cells.end(), block.begin(), block.end());
  return cells;
}

}  // namespace sublimit
