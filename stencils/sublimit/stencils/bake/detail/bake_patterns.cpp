// SPDX-License-Identifier: Apache-2.0
#include "sublimit/stencils/bake/detail/bake_patterns.h"

#include "sublimit/base/error.h"

namespace sublimit {

Piece piece_of(const Scheme<double>& scheme, const Topology& t, const Addresses& addresses, Index address) {
  const Addresses::FaceCorner at = addresses.place(address);
  if (at.corner >= 0) return {scheme.is_dual() ? Piece::Kind::corner : Piece::Kind::cut, t.corner(at.face, at.corner)};
  return {addresses.triangles() ? Piece::Kind::triangle : Piece::Kind::quad, t.first(at.face)};
}

namespace {

std::optional<Baked> bake_corners_or_none(Patterns& patterns, const Level& control, const BakeRequest& request,
                                          const PatternBake& how) {
  try {
    return bake_corners(patterns, control, request, how);
  } catch (const AnalysisError&) {
    return std::nullopt;  // corners that are no pieces: rows know what to do
  }
}

}  // namespace

std::optional<Baked> bake_by_patterns(Patterns& patterns, const Level& control, const BakeRequest& request,
                                      const PatternBake& how) {
  if (!control.intervals.empty()) return std::nullopt;  // lattices have new knots in the middle
  // Limits of vertices have the weights of `limit_matrices`. Types have the same where masks of one ring are enough;
  // elsewhere refinement sums in the order of the mesh.
  const bool at_vertices = request.rows == TableRows::limit && request.level == 0 && request.derivatives == 0;
  if (how.must_pay && at_vertices && !patterns.scheme().has_one_ring_limits()) return std::nullopt;
  std::optional<Baked> baked;
  if (request.rows == TableRows::level || request.rows == TableRows::limit)
    baked = patterns.scheme().is_dual() ? bake_corners_or_none(patterns, control, request, how)
                                        : bake_lattices(patterns, control, request, how);
  else if (!how.first_by_rows)
    baked = request.rows == TableRows::grid ? bake_grids(patterns, control, request, how)
                                            : bake_places(patterns, control, request, how);
  if (baked) baked->statistics.method = how.first_by_rows ? BakeMethod::rows_then_patterns : BakeMethod::patterns;
  return baked;
}

}  // namespace sublimit
