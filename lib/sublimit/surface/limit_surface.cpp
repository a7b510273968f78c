// SPDX-License-Identifier: Apache-2.0
#include "sublimit/surface/limit_surface.h"

#include <utility>

#include "sublimit/base/detail/parallel_for.h"
#include "sublimit/core/detail/finite_points.h"
#include "sublimit/mesh/detail/points_in_space.h"
#include "sublimit/source/detail/derivative_order.h"
#include "sublimit/surface/detail/limit_patches.h"

namespace sublimit {

struct LimitSurface::Bound {
  LimitMap map;
  Points points;
  LimitPatches patches;  // refers to both

  Bound(const LimitMap& of, Points at)
      : map(of), points(std::move(at)), patches((check_points(map.level(), points), map.parts()), points) {}
  Bound(const Bound&) = delete;
};

LimitSurface::LimitSurface(const Mesh& mesh, const AnyScheme& scheme, std::shared_ptr<LimitCache> cache)
    : LimitSurface(LimitMap(*scheme.for_mesh(mesh), mesh, {}, std::move(cache)), points_in_space(mesh)) {}
LimitSurface::LimitSurface(const LimitMap& map, Points points)
    : bound_(std::make_shared<const Bound>(map, std::move(points))) {}

LimitSurface LimitSurface::with(Points points) const {
  check_finite_control(points);
  return {map(), std::move(points)};
}

const LimitMap& LimitSurface::map() const { return bound_->map; }
const Points& LimitSurface::points() const& { return bound_->points; }

void LimitSurface::evaluate(std::span<const Place> places, int derivatives, bool normals, LimitSamples& out) const {
  check_order(derivatives);
  resize(out, static_cast<std::int64_t>(places.size()), derivatives, normals);
  parallel_for_blocks(
      static_cast<std::int64_t>(places.size()),
      [&](std::int64_t, std::int64_t begin, std::int64_t end) {
        bound_->patches.evaluate(places, begin, end, derivatives, normals, out);
      },
      samples_per_block);
}

LimitSamples LimitSurface::evaluate(std::span<const Place> places, int derivatives, bool normals) const {
  LimitSamples out;
  evaluate(places, derivatives, normals, out);
  return out;
}

}  // namespace sublimit
