// SPDX-License-Identifier: Apache-2.0
#include "sublimit/stencils/bake/detail/lattice_cells.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstdint>

#include "sublimit/base/detail/parallel_for.h"
#include "sublimit/neighborhood/piece.h"

namespace sublimit {
namespace {

struct Spot {
  Index i = 0, j = 0;
  bool operator==(const Spot&) const = default;
  Spot operator+(const Spot& other) const { return {i + other.i, j + other.j}; }
  Spot operator*(Index s) const { return {i * s, j * s}; }
};

/// A cell by its corners: the first, and the steps from there to the next one and to the last one.
struct Cell {
  Spot first, u, v;
};

/// Cells of a lattice of n to a side, in their order.
class Cells {
 public:
  Cells(Index n, bool triangles) : n_(n), triangles_(triangles) {}
  Index count() const { return n_ * n_; }
  template <class Body>
  void for_each(const Body& body) const {
    Index number = 0;
    for (Index j = 0; j < n_; ++j)
      for (Index i = 0; i < (triangles_ ? n_ - j : n_); ++i) {
        body(number++, Cell{{i, j}, {1, 0}, {0, 1}});
        if (triangles_ && i + j + 1 < n_) body(number++, Cell{{i + 1, j}, {0, 1}, {-1, 1}});
      }
  }
  /// The cell with these corners, counter-clockwise from any.
  /// @param first  which of them is its first one
  Index number(std::span<const Spot> corners, int& first) const {
    Spot low = corners[0];
    for (const Spot& c : corners) low = {std::min(low.i, c.i), std::min(low.j, c.j)};
    const auto at = std::find(corners.begin(), corners.end(), low);
    const bool is_down = at == corners.end();  // triangles only: none of the corners is at (i, j)
    const Spot start = is_down ? low + Spot{1, 0} : low;
    first = static_cast<int>(std::find(corners.begin(), corners.end(), start) - corners.begin());
    assert(first < std::ssize(corners));
    if (!triangles_) return low.j * n_ + low.i;
    return low.j * (2 * n_ - low.j) + 2 * low.i + (is_down ? 1 : 0);
  }

 private:
  Index n_;
  bool triangles_;
};

/// Where the corners of a child lie in its parent, in halves.
std::array<Spot, 4> corners_of(const PieceMap& child, bool triangles) {
  std::array<Spot, 4> corners;
  for (Index j = 0; j <= 2; ++j)
    for (Index i = 0; i <= (triangles ? 2 - j : 2); ++i) {
      const PieceCoordinates p = child(triangles ? triangle_place(i / 2.0, j / 2.0) : quad_place(i / 2.0, j / 2.0));
      // Halves are exact.
      if (p.u == 0 && p.v == 0) corners[0] = {i, j};
      if (p.u == 1 && p.v == 0) corners[1] = {i, j};
      if (p.u == 1 && p.v == 1) corners[2] = {i, j};
      if (p.u == 0 && p.v == 1) corners[triangles ? 2 : 3] = {i, j};
    }
  return corners;
}

}  // namespace

std::vector<HalfEdge> lattice_cells(std::span<const Level> levels, bool triangles, std::span<const std::int8_t> turn) {
  const size_t sides = triangles ? 3 : 4;
  const auto faces = static_cast<Index>(turn.size());
  std::vector<HalfEdge> cells(turn.size());
  for (Index f = 0; f < faces; ++f) cells[f] = levels[0].topology().corner(Face{f}, turn[f]);
  Index n = 1;
  for (size_t k = 0; k + 1 < levels.size(); ++k, n *= 2) {
    const Topology &parent = levels[k].topology(), &child = levels[k + 1].topology();
    const LevelStep step{&levels[k + 1].steps[0], levels[k].number};
    const Cells coarse(n, triangles), fine(2 * n, triangles);
    std::vector<HalfEdge> next(size_t(faces) * size_t(fine.count()));
    parallel_for(faces, [&](std::int64_t f) {
      const HalfEdge* own = cells.data() + f * coarse.count();
      HalfEdge* out = next.data() + f * fine.count();
      coarse.for_each([&](Index number, const Cell& cell) {
        const Piece piece{triangles ? Piece::Kind::triangle : Piece::Kind::quad, own[number]};
        for (const PieceChild& c : children(piece, parent, std::span(&step, 1))) {
          std::array<Spot, 4> corners = corners_of(c.map, triangles);
          for (Spot& at : corners) at = cell.first * 2 + cell.u * at.i + cell.v * at.j;
          int first = 0;
          const Index to = fine.number(std::span(corners).first(sides), first);
          HalfEdge h = c.piece.start;
          while (first-- > 0) h = child.next(h);
          out[to] = h;
        }
      });
    });
    cells = std::move(next);
  }
  return cells;
}

}  // namespace sublimit
