// SPDX-License-Identifier: Apache-2.0
#include "sublimit/patches/spline_surface.h"

#include <Eigen/Geometry>

#include <limits>
#include <utility>

#include "sublimit/base/parallel_for.h"
#include "sublimit/core/uninitialized.h"
#include "sublimit/limit/derivative_order.h"
#include "sublimit/patches/collapsed_side.h"
#include "sublimit/patches/finer_knots.h"
#include "sublimit/patches/spline_rows.h"

namespace sublimit {
namespace {

KnotPlace<double> u_place(const SplineSurface& surface, const Sample& s) {
  return {s.face % surface.u().num_faces(), s.u};
}
KnotPlace<double> v_place(const SplineSurface& surface, const Sample& s) {
  return {s.face / surface.u().num_faces(), s.v};
}

/// Unit normal of derivatives that are not parallel, as far as rounding tells, else zero.
Eigen::Vector3d plain_normal(const RowValues& at) {
  if (!(at.sizes[1] > 0) || !(at.sizes[2] > 0)) return Eigen::Vector3d::Zero();
  // In units of their terms: squares of huge or tiny ones would leave the range of numbers.
  const Eigen::Vector3d du = at.values.row(1) / at.sizes[1], dv = at.values.row(2) / at.sizes[2];
  const Eigen::Vector3d normal = du.cross(dv);
  const double noise = 64 * std::numeric_limits<double>::epsilon() * (du.norm() + dv.norm());
  return normal.norm() > noise ? normal.normalized() : Eigen::Vector3d::Zero();
}

}  // namespace

SplineSurface::SplineSurface(Knots<double> u, Knots<double> v) : u_(std::move(u)), v_(std::move(v)) {
  if (std::int64_t{u_.num_points()} * v_.num_points() > std::numeric_limits<Index>::max())
    throw ResourceError(format_number(u_.num_points()) + " x " + format_number(v_.num_points()) +
                        " control points are more than 32-bit indices count");
}

Sample SplineSurface::place(const Parameters& parameters) const {
  const KnotPlace<double> u = u_.place(parameters.u, parameters.u_side), v = v_.place(parameters.v, parameters.v_side);
  return {.face = u.face + u_.num_faces() * v.face, .u = u.u, .v = v.u};
}

SplineSurface::Parameters SplineSurface::parameters(const Sample& place) const {
  const auto side = [](double t) { return t == 1 ? KnotSide::left : KnotSide::right; };
  return {.u = u_.parameter(u_place(*this, place)),
          .v = v_.parameter(v_place(*this, place)),
          .u_side = side(place.u),
          .v_side = side(place.v)};
}

LimitStencil SplineSurface::rows(const Sample& sample, int order) const {
  const PointRows in_u = point_rows(u_, u_place(*this, sample), order);
  const PointRows in_v = point_rows(v_, v_place(*this, sample), order);
  LimitStencil result;
  if (in_u.sides_differ || in_v.sides_differ) result.status = LimitStatus::crease;
  for (const Index j : in_v.points)
    for (const Index i : in_u.points) result.vertices.push_back(i + u_.num_points() * j);
  constexpr std::pair<int, int> orders[] = {{0, 0}, {1, 0}, {0, 1}, {2, 0}, {1, 1}, {0, 2}};
  result.weights.resize(order == 0 ? 1 : order == 1 ? 3 : 6, std::ssize(result.vertices));
  const Eigen::Index width = std::ssize(in_u.points);
  for (Eigen::Index r = 0; r < result.weights.rows(); ++r)
    for (Eigen::Index j = 0; j < in_v.weights.cols(); ++j)
      result.weights.row(r).segment(j * width, width) =
          in_v.weights(orders[r].second, j) * in_u.weights.row(orders[r].first);
  return result;
}

LimitStencil SplineSurface::stencil(const Sample& sample, int order) const {
  check_order(order);
  if (sample.face < 0 || sample.face >= num_faces())
    throw InvalidParameter("face " + format_number(sample.face) + " does not exist; there are " +
                           format_number(num_faces()) + " squares");
  if (!is_inside(sample))
    throw InvalidParameter("(" + format_number(sample.u) + ", " + format_number(sample.v) +
                           ") is outside the square 0 <= u, v <= 1");
  LimitStencil result = rows(sample, order);
  if (order >= 1) result.tangents = result.weights.middleRows(1, 2);
  return result;
}

LimitSamples SplineSurface::evaluate(const Points& columns, std::span<const Sample> samples, int order,
                                     Coordinates coordinates) const {
  check_order(order);
  const Index width = coordinates == Coordinates::homogeneous ? 4 : 3;
  if (columns.rows() != num_points() || columns.cols() != width)
    throw InvalidParameter("columns are " + format_number(columns.rows()) + " x " + format_number(columns.cols()) +
                           ", not " + format_number(num_points()) + " x " + format_number(width));
  LimitSamples out;
  const auto count = std::ssize(samples);
  Points* const targets[] = {&out.position, &out.du, &out.dv, &out.duu, &out.duv, &out.dvv};
  for (int k = 0; k < 6; ++k) targets[k]->setZero(k == 0 || order >= (k < 3 ? 1 : 2) ? count : 0, 3);
  out.normal.setZero(order >= 1 ? count : 0, 3);
  out.status.assign(static_cast<size_t>(count), LimitStatus::outside);
  out.order.assign(static_cast<size_t>(count), 0);
  const auto fill = [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i < end; ++i) {
      const Sample& sample = samples[static_cast<size_t>(i)];
      if (!is_inside(sample)) continue;
      const LimitStencil found = rows(sample, order);
      const RowValues at = row_values(found.weights, 2, columns(found.vertices, Eigen::all), coordinates);
      out.status[i] = at.is_pole ? LimitStatus::pole : found.status;
      if (at.is_pole) continue;
      out.order[i] = static_cast<std::int8_t>(order);
      for (Eigen::Index k = 0; k < at.values.rows(); ++k) targets[k]->row(i) = at.values.row(k);
      if (order == 0) continue;
      Eigen::Vector3d normal = plain_normal(at);
      if (normal.isZero(0)) normal = collapsed_side_normal(*this, columns, coordinates, sample);
      out.normal.row(i) = normal;
      if (normal.isZero(0)) out.status[i] = LimitStatus::undefined_normal;
    }
  };
  parallel_for_blocks(count, fill, 256);
  return out;
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
