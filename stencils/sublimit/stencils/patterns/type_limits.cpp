// SPDX-License-Identifier: Apache-2.0
#include "sublimit/stencils/patterns/type_limits.h"

#include <algorithm>
#include <atomic>

#include "sublimit/base/detail/parallel_for.h"
#include "sublimit/eval/table/pattern_table.h"
#include "sublimit/stencils/patterns/point_status.h"
#include "sublimit/surface/detail/limit_map_parts.h"

namespace sublimit {
namespace {

/// From parameters of an address to those of a lattice in it.
PieceMap lattice_map(const LatticePlace& place, bool triangle) {
  PieceMap map;
  const int turn = place.turn;
  if (triangle) {
    map.is_triangle = true;
    for (int c = 0; c < 3; ++c) map.barycentric[c][(turn + c) % 3] = 1;
    return map;
  }
  const auto span = [&](int axis) {
    if (place.quarter < 0) return Span::whole;
    const bool upper = axis == 0 ? place.quarter == 1 || place.quarter == 2 : place.quarter >= 2;
    return upper ? Span::upper : Span::lower;
  };
  const auto axis = [&](int from, bool reversed) {
    return PieceMap::Axis{static_cast<std::uint8_t>(from), span(from), reversed};
  };
  // Counter-clockwise: corner `turn` of the address is (0, 0).
  map.axes = turn == 0   ? std::array{axis(0, false), axis(1, false)}
             : turn == 1 ? std::array{axis(1, false), axis(0, true)}
             : turn == 2 ? std::array{axis(0, true), axis(1, true)}
                         : std::array{axis(1, true), axis(0, false)};
  return map;
}

/// The piece of a type that a place of the address is in.
LimitMap::Parts::Target target_at(const LimitMap::Parts& surface, const PieceType& type, const LatticePlace& place,
                                  const PieceMap& map, const AddressParameters& p) {
  const PieceCoordinates outer = type.kind() == Piece::Kind::triangle ? triangle_place(p.u, p.v) : quad_place(p.u, p.v);
  if (type.kind() == Piece::Kind::quad && surface.scheme.is_dual()) {  // each of its corners is a piece
    const int corner = nearest_corner(p.u, p.v);
    HalfEdge h = type.piece().start;  // at corner `turn` of the address
    for (int k = place.turn; k % 4 != corner; ++k) h = surface.level.topology().next(h);
    const PieceMap& quarter = quarter_map(corner);
    return {{Piece::Kind::corner, h}, quarter(outer), &quarter, outer};
  }
  return {type.piece(), map(outer), &map, outer};
}

}  // namespace

std::optional<Patterns::LimitBlock> limits_of_type(const std::shared_ptr<LimitCache>& types, const PieceType& type,
                                                   const LatticePlace& place,
                                                   std::span<const AddressParameters> parameters, int derivatives) {
  Level level = type.level();
  level.holes.assign(level.holes.size(), false);  // of the mesh that the type was met in first
  const LimitMap::Parts surface(types->pieces().scheme(), std::move(level), types);
  const PieceMap map = lattice_map(place, type.kind() == Piece::Kind::triangle);
  std::vector<Eigen::Index> slot_of(type.level().topology().num_vertices(), -1);
  for (size_t s = 0; s < type.slots().size(); ++s) slot_of[type.slots()[s]] = Eigen::Index(s);

  // Among its own points a walk could see less: of a vertex with several fans only those around the piece are there.
  const std::vector<Index> slots(type.slots().begin(), type.slots().end());
  const Topology& t = type.level().topology();
  const std::span<const Index> corners = t.vertices(t.face(type.piece().start));
  const bool has_several_fans =
      std::any_of(corners.begin(), corners.end(), [&](Index v) { return t.is_nonmanifold(Vertex{v}); });

  const int quantities = num_quantities(derivatives);
  const auto count = static_cast<Eigen::Index>(parameters.size());
  Patterns::LimitBlock block;
  block.weights = RowMatrix::Zero(quantities * count, type.num_slots());
  block.status.resize(size_t(count));
  std::atomic<bool> beyond = false;
  const auto fill_row = [&](Eigen::Index row) {
    const LimitMap::Parts::Target target = target_at(surface, type, place, map, parameters[size_t(row)]);
    const bool is_whole = target.piece.kind == type.kind();
    const LimitMap::Parts::Found found =
        is_whole ? surface.find(target, derivatives, type, slots) : surface.find(target, derivatives);
    if (found.tangents.size() > 0 && has_several_fans) beyond = true;
    block.status[size_t(row)] = point_status(found.status, found.rows.order, derivatives);
    const auto add = [&](Eigen::Index quantity, Index vertex, double weight) {
      if (weight == 0) return;
      const Eigen::Index slot = slot_of[vertex];
      if (slot < 0)
        beyond = true;
      else
        block.weights(quantity * count + row, slot) += weight;
    };
    const auto add_differences = [&](Eigen::Index q, const auto& weights) {
      for (Eigen::Index s = 0; s < weights.size(); ++s) add(q, found.vertices[s + 1], weights[s]);
      add(q, found.vertices[0], (q == 0 ? 1 : 0) - weights.sum());
    };
    const RowMatrix& rows = found.rows.rows;
    const auto position = surface.vertex_position(target);
    if (position)
      for (const auto& [vertex, weight] : *position) add(0, vertex, weight);
    for (Eigen::Index q = position ? 1 : 0; q < rows.rows(); ++q) add_differences(q, rows.row(q));
    if (derivatives == 0 || rows.rows() > 1) return;
    // Where there are no natural derivatives, two tangents that span the plane.
    const RowMatrix& tangents = found.rows.tangents;
    for (Eigen::Index q = 0; q < std::min<Eigen::Index>(tangents.rows(), 2); ++q)
      add_differences(q + 1, tangents.row(q));
    if (found.tangents.size() >= 2)
      for (Eigen::Index q = 1; q <= 2; ++q)
        for (const auto& [vertex, weight] : found.tangents[size_t(q - 1)]) add(q, vertex, weight);
  };
  // Of types with finite sharpness, whose sums have an order, in turn.
  constexpr std::int64_t per_block = 256;
  if (type.decays())
    for (Eigen::Index row = 0; row < count; ++row) fill_row(row);
  else
    parallel_for_blocks(
        count,
        [&](std::int64_t, std::int64_t begin, std::int64_t end) {
          for (std::int64_t row = begin; row < end; ++row) fill_row(row);
        },
        per_block);
  if (beyond) return std::nullopt;
  return block;
}

std::optional<Patterns::LimitBlock> limits_of_type(const std::shared_ptr<LimitCache>& types, const PieceType& type,
                                                   const Patterns::LimitRequest& request) {
  const auto& [lattice, place, by_address, derivatives] = request;
  const LatticePlace own = by_address ? LatticePlace{0, 0, place.quarter} : place;
  std::vector<AddressParameters> parameters;
  request.lattice.for_each(
      [&](Index i, Index j) { parameters.push_back(address_parameters(request.lattice, own, i, j)); });
  return limits_of_type(types, type, place, parameters, derivatives);
}

}  // namespace sublimit
