// SPDX-License-Identifier: Apache-2.0
#include "sublimit/stencils/bake/detail/face_places.h"

#include "sublimit/base/detail/parallel_for.h"
#include "sublimit/neighborhood/piece.h"
#include "sublimit/source/address.h"

namespace sublimit {
namespace {

bool is_right(int corner) { return corner == 1 || corner == 2; }
bool is_upper(int corner) { return corner >= 2; }

/// The quarter of a square that a child is, and which of the quarter's corners it begins with.
struct Quarter {
  int number = -1, first = -1;
};

Quarter quarter_of(const PieceMap& child, bool is_all) {
  Quarter quarter;
  for (int k = 0; k < 4; ++k)
    if (!is_all && child.contains(quad_place(is_right(k) ? 0.75 : 0.25, is_upper(k) ? 0.75 : 0.25))) quarter.number = k;
  const double size = is_all ? 1 : 0.5, u = !is_all && is_right(quarter.number) ? 0.5 : 0,
               v = !is_all && is_upper(quarter.number) ? 0.5 : 0;
  for (int k = 0; k < 4; ++k) {
    const PieceCoordinates p = child(quad_place(u + (is_right(k) ? size : 0), v + (is_upper(k) ? size : 0)));
    if (p.u == 0 && p.v == 0) quarter.first = k;
  }
  return quarter;
}

}  // namespace

std::optional<std::vector<LatticePlace>> places_of_children(const Scheme<double>& scheme, const Level& control,
                                                            const Level& level, std::span<const std::int8_t> turn) {
  if (scheme.face_size() == 3 || level.steps.size() != scheme.steps.size()) return std::nullopt;
  const Topology &t = control.topology(), &fine = level.topology();
  const Addresses addresses(t, false);
  std::vector<LevelStep> steps;
  for (const Refinement& step : level.steps) steps.push_back({&step, 0});
  std::vector<LatticePlace> places(fine.num_faces());
  parallel_for(addresses.size(), [&](std::int64_t a) {
    const auto address = static_cast<Index>(a);
    const Addresses::FaceCorner at = addresses.place(address);
    const bool is_corner = at.corner >= 0;
    const Piece piece =
        is_corner ? Piece{Piece::Kind::cut, t.corner(at.face, at.corner)} : Piece{Piece::Kind::quad, t.first(at.face)};
    for (const PieceChild& child : children(piece, t, steps)) {
      const Quarter quarter = quarter_of(child.map, is_corner);
      const Face face = fine.face(child.piece.start);
      const int first = quarter.first + turn[index(face)] - fine.corner_index(child.piece.start);
      places[index(face)] = {address, static_cast<std::int8_t>((first + 4) % 4),
                             static_cast<std::int8_t>(quarter.number)};
    }
  });
  return places;
}

}  // namespace sublimit
