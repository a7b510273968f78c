// SPDX-License-Identifier: Apache-2.0
#include "sublimit/patches/patches.h"

#include <algorithm>
#include <string>
#include <utility>

#include "sublimit/base/error.h"
#include "sublimit/surface/detail/limit_patches.h"

namespace sublimit {

struct Patches::Bound {
  PatchSet set;
  Points columns;
  std::unique_ptr<BoundSource> source;  // refers to both

  Bound(PatchSet of, Points at) : set(std::move(of)), columns(std::move(at)), source(set.bound(columns)) {}
  Bound(const Bound&) = delete;
};

Patches::Patches(PatchSet set, Points columns)
    : bound_(std::make_shared<const Bound>(std::move(set), std::move(columns))) {}

Patches Patches::with(Points columns) const {
  if (!columns.allFinite()) throw InvalidParameter("control points should be finite");
  return {set(), std::move(columns)};
}

const PatchSet& Patches::set() const { return bound_->set; }
const Points& Patches::points() const& { return bound_->columns; }
bool Patches::rational() const { return set().coordinates() == Coordinates::homogeneous; }
Index Patches::num_patches() const { return static_cast<Index>(set().members().size()); }
Index Patches::first_face(Index patch) const {
  if (patch < 0 || patch > num_patches())
    throw InvalidParameter("patch " + std::to_string(patch) + ": there are " + std::to_string(num_patches()));
  return set().first_face(size_t(patch));
}

void Patches::evaluate(std::span<const Place> places, int derivatives, bool normals, LimitSamples& out) const {
  const FaceCount all = faces();
  const auto is_on = [&](const Place& place) { return is_inside(all, place); };
  if (std::ranges::all_of(places, is_on)) return bound_->source->evaluate(places, derivatives, normals, out);
  std::vector<Place> inside(places.size());
  if (all.size > 0) {
    std::ranges::transform(places, inside.begin(), [&](const Place& place) { return is_on(place) ? place : Place{}; });
    bound_->source->evaluate(inside, derivatives, normals, out);
  } else {
    resize(out, std::ssize(places), derivatives, normals);
  }
  for (size_t i = 0; i < places.size(); ++i) {
    if (is_on(places[i])) continue;
    const auto row = Eigen::Index(i);
    for (Points* const part : {&out.position, &out.du, &out.dv, &out.duu, &out.duv, &out.dvv, &out.normal})
      if (part->rows() > row) part->row(row).setZero();
    out.status[i] = LimitStatus::outside;
    out.order[i] = 0;
  }
}

LimitSamples Patches::evaluate(std::span<const Place> places, int derivatives, bool normals) const {
  LimitSamples out;
  evaluate(places, derivatives, normals, out);
  return out;
}

}  // namespace sublimit
