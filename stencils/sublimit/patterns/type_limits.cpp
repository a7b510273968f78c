// SPDX-License-Identifier: Apache-2.0
#include "sublimit/patterns/type_limits.h"

#include <algorithm>

#include "sublimit/limit/limit_surface_parts.h"
#include "sublimit/pattern_table.h"
#include "sublimit/patterns/point_status.h"

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

}  // namespace

std::optional<Patterns::LimitBlock> limits_of_type(const std::shared_ptr<LimitTypes>& types, const PieceType& type,
                                                   const Patterns::LimitRequest& request) {
  const auto& [lattice, place, by_address, derivatives] = request;
  Level level = type.level();
  level.holes.assign(level.holes.size(), false);  // of the mesh that the type was met in first
  const LimitSurface::Parts surface(types->pieces().scheme(), std::move(level), types);
  const PieceMap map = lattice_map(place, lattice.triangle);
  std::vector<Eigen::Index> slot_of(type.level().topology().num_vertices(), -1);
  for (size_t s = 0; s < type.slots().size(); ++s) slot_of[type.slots()[s]] = Eigen::Index(s);

  // Among its own points a walk could see less: of a vertex with several fans only those around the piece are there.
  const std::vector<Index> slots(type.slots().begin(), type.slots().end());
  const Topology& t = type.level().topology();
  const auto has_several_fans = [&] {
    const Face face = t.face(type.piece().start);
    return std::any_of(t.vertices(face).begin(), t.vertices(face).end(),
                       [&](Index v) { return t.is_nonmanifold(Vertex{v}); });
  };

  const int quantities = num_quantities(derivatives);
  const Eigen::Index count = lattice.size();
  Patterns::LimitBlock block;
  block.weights = RowMatrix::Zero(quantities * count, type.num_slots());
  block.status.resize(size_t(count));
  bool beyond = false;
  const LatticePlace own = by_address ? LatticePlace{0, 0, place.quarter} : place;
  request.lattice.for_each([&](Index i, Index j) {
    const Lattice& all = request.lattice;
    const AddressParameters p = address_parameters(all, own, i, j);
    LimitSurface::Parts::Target target{type.piece(), {}, &map, {}};
    target.outer = all.triangle ? triangle_place(p.u, p.v) : quad_place(p.u, p.v);
    target.place = map(target.outer);
    const LimitSurface::Parts::Found found = surface.find(target, request.derivatives, type, slots);
    if (found.tangents.size() > 0 && has_several_fans()) beyond = true;
    const Eigen::Index row = all.row(i, j);
    block.status[size_t(row)] = point_status(found.status, found.rows.order, request.derivatives);
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
    for (Eigen::Index q = 0; q < rows.rows(); ++q) add_differences(q, rows.row(q));
    if (request.derivatives == 0 || rows.rows() > 1) return;
    // Where there are no natural derivatives, two tangents that span the plane.
    const RowMatrix& tangents = found.rows.tangents;
    for (Eigen::Index q = 0; q < std::min<Eigen::Index>(tangents.rows(), 2); ++q)
      add_differences(q + 1, tangents.row(q));
    if (found.tangents.size() >= 2)
      for (Eigen::Index q = 1; q <= 2; ++q)
        for (const auto& [vertex, weight] : found.tangents[size_t(q - 1)]) add(q, vertex, weight);
  });
  if (beyond) return std::nullopt;
  return block;
}

}  // namespace sublimit
