// SPDX-License-Identifier: Apache-2.0
#include "sublimit/patches/detail/cut_patch.h"

#include <algorithm>
#include <utility>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/error.h"
#include "sublimit/core/detail/sparse_product.h"
#include "sublimit/patches/detail/blossom.h"
#include "sublimit/patches/detail/spline_rows.h"
#include "sublimit/patches/spline_surface.h"

namespace sublimit {
namespace {

/// Bernstein coefficients on [a, b] by those on [0, 1]: blossoms of a and b.
WeightRows part_rows(int degree, double a, double b) {
  constexpr UnitSpan<double> span;
  const UnitArgument<double> first = UnitArgument<double>::point(a), last = UnitArgument<double>::point(b);
  WeightRows rows = WeightRows::Zero(degree + 1, degree + 1);
  for (int i = 0; i <= degree; ++i) {
    rows(i, 0) = 1;
    for (int q = 1; q <= degree; ++q) blossom_step(span, q, q <= degree - i ? first : last, rows.row(i).data());
  }
  return rows;
}

}  // namespace

CutPatch::CutPatch(std::shared_ptr<const Patch> patch, Eigen::Array2d first, Eigen::Array2d last)
    : patch_(std::move(patch)), first_(first), last_(last) {
  // Both corners must be places; what lies between is found face by face.
  patch_->place({.u = first[0], .v = first[1]});
  patch_->place({.u = last[0], .v = last[1], .u_side = KnotSide::left, .v_side = KnotSide::left});
  for (Index face = 0; face < patch_->faces().size; ++face) {
    const Parameters corner = patch_->parameters({.face = face});
    const Lengths length = patch_->lengths(face);
    const auto fraction = [](double t, double begin, double whole) {
      return std::clamp((t - begin) / whole, 0.0, 1.0);
    };
    const Part part{.face = face,
                    .u0 = fraction(first[0], corner.u, length.u),
                    .v0 = fraction(first[1], corner.v, length.v),
                    .u1 = fraction(last[0], corner.u, length.u),
                    .v1 = fraction(last[1], corner.v, length.v)};
    if (part.u0 < part.u1 && part.v0 < part.v1) parts_.push_back(part);
  }
  if (parts_.empty())
    throw InvalidParameter("from (" + format_number(first[0]) + ", " + format_number(first[1]) + ") to (" +
                           format_number(last[0]) + ", " + format_number(last[1]) + ") there is no area");
}

Place CutPatch::inner(const Place& s) const {
  const Part& part = parts_[size_t(s.face)];
  const auto between = [](double a, double b, double t) { return t == 1 ? b : std::min(b, a + t * (b - a)); };
  return {.face = part.face, .u = between(part.u0, part.u1, s.u), .v = between(part.v0, part.v1, s.v)};
}

LimitStatus CutPatch::rows(const Place& place, int order, WeightRows& weights) const {
  const LimitStatus status = patch_->rows(inner(place), order, weights);
  const Part& part = parts_[size_t(place.face)];
  const double u = part.u1 - part.u0, v = part.v1 - part.v0;
  const double scales[] = {1, u, v, u * u, u * v, v * v};
  for (Eigen::Index r = 1; r < weights.rows(); ++r) weights.row(r) *= scales[r];
  return status;
}

std::string CutPatch::type(Index face) const {
  const Part& part = parts_[size_t(face)];
  std::string bytes = "cut" + patch_->type(part.face);
  for (const double t : {part.u0, part.v0, part.u1, part.v1}) bytes.append(reinterpret_cast<const char*>(&t), sizeof t);
  return bytes;
}

Place CutPatch::place(const Parameters& parameters) const {
  // At its ends a place belongs to the piece inside, also where these are knots of the whole.
  Parameters inside = parameters;
  const auto turn = [](double t, double first, double last, KnotSide& side) {
    if (t == first) side = KnotSide::right;
    if (t == last) side = KnotSide::left;
  };
  turn(inside.u, first_[0], last_[0], inside.u_side);
  turn(inside.v, first_[1], last_[1], inside.v_side);
  const Place found = patch_->place(inside);
  const auto part = std::ranges::lower_bound(parts_, found.face, {}, &Part::face);
  if (part == parts_.end() || part->face != found.face || found.u < part->u0 || found.u > part->u1 ||
      found.v < part->v0 || found.v > part->v1)
    throw InvalidParameter("(" + format_number(parameters.u) + ", " + format_number(parameters.v) +
                           ") is outside the part of the domain that is kept");
  return {.face = static_cast<Index>(part - parts_.begin()),
          .u = (found.u - part->u0) / (part->u1 - part->u0),
          .v = (found.v - part->v0) / (part->v1 - part->v0)};
}

Patch::Parameters CutPatch::parameters(const Place& place) const {
  Parameters result = patch_->parameters(inner(place));
  result.u_side = place.u == 1 ? KnotSide::left : KnotSide::right;
  result.v_side = place.v == 1 ? KnotSide::left : KnotSide::right;
  return result;
}

Patch::Lengths CutPatch::lengths(Index face) const {
  const Part& part = parts_[size_t(face)];
  const Lengths whole = patch_->lengths(part.face);
  return {whole.u * (part.u1 - part.u0), whole.v * (part.v1 - part.v0)};
}

std::optional<Patch::BezierRows> CutPatch::bezier(Index face) const {
  const Part& part = parts_[size_t(face)];
  std::optional<BezierRows> whole = patch_->bezier(part.face);
  if (!whole) return std::nullopt;
  whole->rows =
      outer_product(part_rows(whole->degree_v, part.v0, part.v1), part_rows(whole->degree_u, part.u0, part.u1)) *
      whole->rows;
  return whole;
}

Patch::Refined CutPatch::refined() const {
  Refined whole{patch_, {}};
  if (!std::dynamic_pointer_cast<const SplineSurface>(patch_)) whole = patch_->refined();
  const auto* const spline = dynamic_cast<const SplineSurface*>(whole.patch.get());
  if (!spline) return {};
  const SplineSurface part(part_knots(spline->u(), first_[0], last_[0]), part_knots(spline->v(), first_[1], last_[1]));
  auto fine = std::make_shared<const SplineSurface>(halved(part));
  SparseMatrix S = product(refinement_matrix(part, *fine),
                           kronecker(part_matrix(spline->v(), part.v()), part_matrix(spline->u(), part.u())));
  if (whole.S.size() > 0) S = product(S, whole.S);
  return {std::move(fine), std::move(S)};
}

}  // namespace sublimit
