// SPDX-License-Identifier: Apache-2.0
#include "sublimit/parts/parted_surface.h"

#include "sublimit/core/detail/finite_points.h"
#include "sublimit/parts/closed_surface.h"

namespace sublimit {
namespace {

/// Deeper parts are made when they are asked for, for each query anew; all of them would not fit in memory.
int levels_of(const AddressPieces& pieces, Index addresses) {
  constexpr Index many = 20'000;
  return pieces.has_no_polynomials() ? 1 : addresses < many ? 5 : 2;
}

const LimitSurface& measurable(const LimitSurface& surface) {
  check_measurable_control(surface.points());
  return surface;
}

}  // namespace

PartedLimit::PartedLimit(const LimitSurface& surface)
    : surface_(measurable(surface)),
      pieces_(surface_.map(), surface_.points()),
      levels_(levels_of(pieces_, surface_.faces().size)) {}

void PartedLimit::find_parts(Index face, PieceParts& cutter, std::vector<PiecePart>& out) const {
  pieces_.visit(face, [&](const PieceType& type, const Points& local, const CellCorners& corners) {
    cutter.find(type, local, corners, levels_, out);
  });
}

std::string PartedLimit::why_not_closed() const { return sublimit::why_not_closed(surface_.map()); }

}  // namespace sublimit
