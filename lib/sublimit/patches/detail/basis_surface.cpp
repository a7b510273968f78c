// SPDX-License-Identifier: Apache-2.0
#include "sublimit/patches/detail/basis_surface.h"

#include <array>
#include <limits>
#include <utility>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/error.h"
#include "sublimit/patches/spline_surface.h"

namespace sublimit {
namespace {

bool is_joint(const SegmentBasis& basis, Index face, double t, int order) {
  if (t != 0 && t != 1) return false;
  return basis.continuity(face, t == 0 ? KnotSide::left : KnotSide::right) < order;
}

}  // namespace

BasisSurface::BasisSurface(SegmentBasis u, SegmentBasis v) : u_(std::move(u)), v_(std::move(v)) {
  if (std::int64_t{u_.num_points()} * v_.num_points() > std::numeric_limits<Index>::max())
    throw ResourceError(format_number(u_.num_points()) + " x " + format_number(v_.num_points()) +
                        " control points are more than 32-bit indices count");
}

std::vector<Index> BasisSurface::slots(Index face) const {
  const Index i0 = u_.first_point(face % u_.num_faces()), j0 = v_.first_point(face / u_.num_faces());
  std::vector<Index> points;
  for (Index j = j0; j <= j0 + v_.degree(); ++j)
    for (Index i = i0; i <= i0 + u_.degree(); ++i) points.push_back(i + u_.num_points() * j);
  return points;
}

LimitStatus BasisSurface::rows(const Place& s, int order, WeightRows& weights) const {
  const Eigen::Index m = u_.degree() + 1, n = v_.degree() + 1;
  std::array<double, 3 * (max_degree + 1)> in_u, in_v;
  u_.rows(s.u, order, std::span<double>(in_u).first(size_t((order + 1) * m)));
  v_.rows(s.v, order, std::span<double>(in_v).first(size_t((order + 1) * n)));
  product_rows(in_u, m, in_v, n, order, weights);
  const bool joint =
      is_joint(u_, s.face % u_.num_faces(), s.u, order) || is_joint(v_, s.face / u_.num_faces(), s.v, order);
  return joint ? LimitStatus::crease : LimitStatus::regular;
}

std::string BasisSurface::type(Index) const {
  std::string bytes = "basis";
  u_.append_type(bytes);
  v_.append_type(bytes);
  return bytes;
}

std::string BasisSurface::ends(Index face) const {
  std::string bytes;
  u_.append_ends(face % u_.num_faces(), bytes);
  v_.append_ends(face / u_.num_faces(), bytes);
  return bytes;
}

Place BasisSurface::place(const Parameters& p) const {
  const KnotPlace<double> u = u_.place(p.u, p.u_side), v = v_.place(p.v, p.v_side);
  return {.face = u.face + u_.num_faces() * v.face, .u = u.u, .v = v.u};
}

Patch::Parameters BasisSurface::parameters(const Place& s) const {
  const auto side = [](double t) { return t == 1 ? KnotSide::left : KnotSide::right; };
  return {.u = u_.parameter({s.face % u_.num_faces(), s.u}),
          .v = v_.parameter({s.face / u_.num_faces(), s.v}),
          .u_side = side(s.u),
          .v_side = side(s.v)};
}

Patch::Lengths BasisSurface::lengths(Index face) const {
  return {u_.length(face % u_.num_faces()), v_.length(face / u_.num_faces())};
}

std::optional<Patch::BezierRows> BasisSurface::bezier(Index) const {
  return BezierRows{u_.degree(), v_.degree(), outer_product(v_.to_bezier(), u_.to_bezier())};
}

Patch::Refined BasisSurface::refined() const {
  return {std::make_shared<const SplineSurface>(u_.knots_of_pieces(), v_.knots_of_pieces()),
          kronecker(v_.matrix_of_pieces(), u_.matrix_of_pieces())};
}

}  // namespace sublimit
