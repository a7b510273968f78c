// SPDX-License-Identifier: Apache-2.0
#include "sublimit/patches/spline_surface.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <utility>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/detail/parallel_for.h"
#include "sublimit/base/error.h"
#include "sublimit/core/uninitialized.h"
#include "sublimit/patches/detail/collapsed_side.h"
#include "sublimit/patches/detail/finer_knots.h"
#include "sublimit/patches/detail/spline_rows.h"

namespace sublimit {
namespace {

void append_type(std::string& bytes, const Knots<double>& knots, Index face) {
  bytes += char(knots.degree());
  for (const double distance : knots.type(face)) {
    char item[sizeof distance];
    std::memcpy(item, &distance, sizeof distance);
    bytes.append(item, sizeof distance);
  }
}

/// Of each control point the Greville abscissa, inside the domain.
std::vector<double> point_abscissae(const Knots<double>& knots) {
  const std::vector<double> all = knots.greville();
  std::vector<double> result;
  for (Index point = 0; point < knots.num_points(); ++point) {
    double t = all[size_t(knots.function(point))];
    const double begin = knots.begin(), end = knots.end();
    if (knots.is_closed() && t >= end) t -= end - begin;
    if (knots.is_closed() && t < begin) t += end - begin;
    result.push_back(std::clamp(t, begin, end));
  }
  return result;
}

}  // namespace

SplineSurface::SplineSurface(Knots<double> u, Knots<double> v) : u_(std::move(u)), v_(std::move(v)) {
  if (std::int64_t{u_.num_points()} * v_.num_points() > std::numeric_limits<Index>::max())
    throw ResourceError(format_number(u_.num_points()) + " x " + format_number(v_.num_points()) +
                        " control points are more than 32-bit indices count");
}

Place SplineSurface::place(const Parameters& parameters) const {
  const KnotPlace<double> u = u_.place(parameters.u, parameters.u_side), v = v_.place(parameters.v, parameters.v_side);
  return {.face = u.face + u_.num_faces() * v.face, .u = u.u, .v = v.u};
}

Patch::Parameters SplineSurface::parameters(const Place& place) const {
  const auto side = [](double t) { return t == 1 ? KnotSide::left : KnotSide::right; };
  return {.u = u_.parameter(u_place(place)),
          .v = v_.parameter(v_place(place)),
          .u_side = side(place.u),
          .v_side = side(place.v)};
}

Patch::Lengths SplineSurface::lengths(Index face) const {
  return {u_.length(face % u_.num_faces()), v_.length(face / u_.num_faces())};
}

std::vector<Index> SplineSurface::slots(Index face) const {
  const Index in_u = face % u_.num_faces(), in_v = face / u_.num_faces();
  const Index i0 = u_.span(in_u) - u_.degree(), j0 = v_.span(in_v) - v_.degree();
  std::vector<Index> points;
  points.reserve(size_t(u_.degree() + 1) * size_t(v_.degree() + 1));
  for (Index j = j0; j <= j0 + v_.degree(); ++j)
    for (Index i = i0; i <= i0 + u_.degree(); ++i) points.push_back(u_.point(i) + u_.num_points() * v_.point(j));
  return points;
}

LimitStatus SplineSurface::rows(const Place& place, int order, WeightRows& weights) const {
  const KnotPlace<double> at_u = u_place(place), at_v = v_place(place);
  const Eigen::Index m = u_.degree() + 1, n = v_.degree() + 1;
  std::array<double, 3 * (max_degree + 1)> in_u, in_v;
  span_rows(u_, at_u.face, at_u.u, order, std::span<double>(in_u).first(size_t((order + 1) * m)));
  span_rows(v_, at_v.face, at_v.u, order, std::span<double>(in_v).first(size_t((order + 1) * n)));
  product_rows(in_u, m, in_v, n, order, weights);
  return sides_differ(u_, at_u, order) || sides_differ(v_, at_v, order) ? LimitStatus::crease : LimitStatus::regular;
}

std::string SplineSurface::type(Index face) const {
  std::string bytes = "spline";
  append_type(bytes, u_, face % u_.num_faces());
  append_type(bytes, v_, face / u_.num_faces());
  return bytes;
}

std::string SplineSurface::ends(Index face) const {
  std::string bytes;
  for (const auto& [knots, at] : {std::pair(&u_, face % u_.num_faces()), std::pair(&v_, face / u_.num_faces())})
    for (const KnotSide end : {KnotSide::left, KnotSide::right})
      bytes += char(std::min(knots->continuity(at, end).value_or(2), 2));
  return bytes;
}

std::optional<Patch::BezierRows> SplineSurface::bezier(Index face) const {
  const auto rows_of = [](const BandRows<double>& rows) {
    return WeightRows(Eigen::Map<const WeightRows>(rows.weights.data(), rows.size(), rows.width));
  };
  return BezierRows{
      u_.degree(), v_.degree(),
      outer_product(rows_of(bezier_rows(v_, face / u_.num_faces())), rows_of(bezier_rows(u_, face % u_.num_faces())))};
}

Patch::Refined SplineSurface::refined() const {
  auto fine = std::make_shared<const SplineSurface>(halved(*this));
  SparseMatrix S = refinement_matrix(*this, *fine);
  return {std::move(fine), std::move(S)};
}

Patch::Net SplineSurface::net() const {
  const std::vector<double> u = point_abscissae(u_), v = point_abscissae(v_);
  Net net;
  for (const double y : v)
    for (const double x : u) net.places.push_back({.u = x, .v = y});
  const Index m = u_.num_points(), n = v_.num_points();
  for (Index j = 0; j < n - (v_.is_closed() ? 0 : 1); ++j)
    for (Index i = 0; i < m - (u_.is_closed() ? 0 : 1); ++i) {
      const Index right = (i + 1) % m, above = (j + 1) % n;
      if (right == i || above == j) continue;  // closed with a single point
      net.sizes.push_back(4);
      net.vertices.insert(net.vertices.end(), {i + m * j, right + m * j, right + m * above, i + m * above});
    }
  return net;
}

Eigen::Vector3d SplineSurface::limit_normal(const Points& columns, Coordinates coordinates, const Place& place) const {
  return collapsed_side_normal(*this, columns, coordinates, place);
}

SplineSurface halved(const SplineSurface& surface) { return {halved_knots(surface.u()), halved_knots(surface.v())}; }

SparseMatrix refinement_matrix(const SplineSurface& coarse, const SplineSurface& fine) {
  return kronecker(refinement_matrix(coarse.v(), fine.v()), refinement_matrix(coarse.u(), fine.u()));
}

SparseMatrix kronecker(const SparseMatrix& A, const SparseMatrix& B) {
  constexpr std::int64_t most = std::numeric_limits<Index>::max();
  if (A.nonZeros() * B.nonZeros() > most || A.rows() * B.rows() > most || A.cols() * B.cols() > most)
    throw ResourceError("outer product of matrices: more nonzeros than 32-bit indices count");
  SparseMatrix M(A.rows() * B.rows(), A.cols() * B.cols());
  resize_nonzeros(M, A.nonZeros() * B.nonZeros());
  const auto size = [](const SparseMatrix& matrix, Index row) {
    return matrix.outerIndexPtr()[row + 1] - matrix.outerIndexPtr()[row];
  };
  Index* const start = M.outerIndexPtr();
  start[0] = 0;
  const Index block = static_cast<Index>(B.rows()), width = static_cast<Index>(B.cols());
  for (Index r = 0; r < M.rows(); ++r) start[r + 1] = start[r] + size(A, r / block) * size(B, r % block);
  parallel_for(M.rows(), [&](std::int64_t r) {
    Index at = start[r];
    for (SparseMatrix::InnerIterator a(A, r / block); a; ++a)
      for (SparseMatrix::InnerIterator b(B, r % block); b; ++b) {
        M.innerIndexPtr()[at] = static_cast<Index>(a.col()) * width + static_cast<Index>(b.col());
        M.valuePtr()[at++] = a.value() * b.value();
      }
  });
  return M;
}

}  // namespace sublimit
