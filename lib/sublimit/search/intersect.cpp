// SPDX-License-Identifier: Apache-2.0
#include "sublimit/search/intersect.h"

#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <utility>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/detail/parallel_for.h"
#include "sublimit/base/error.h"
#include "sublimit/core/detail/finite_points.h"
#include "sublimit/parts/parted_patches.h"
#include "sublimit/parts/parted_surface.h"
#include "sublimit/patches/patches.h"
#include "sublimit/search/closest_point.h"
#include "sublimit/search/detail/surface_parts.h"
#include "sublimit/search/detail/tracer.h"

namespace sublimit {
namespace {

/// Points of the surface at the places of hits. Where corners of parts are not known (next to borders of dual schemes)
/// or have too few digits (at extraordinary vertices) these are not the hits: there the places are those nearest to
/// them.
void place_on_rays(const PartedSurface& surface, const std::vector<Ray>& rays, const SurfaceParts& parts,
                   RayHits& hits) {
  LimitSamples samples;
  surface.samples().evaluate(hits.places, 1, true, samples);
  Points on_rays(std::ssize(hits.t), 3);
  std::vector<Eigen::Index> off;
  for (size_t i = 0; i < rays.size(); ++i)
    for (std::int64_t k = hits.first[i]; k < hits.first[i + 1]; ++k) {
      on_rays.row(k) = rays[i].origin + hits.t[size_t(k)] * rays[i].direction;
      if (hits.kinds[size_t(k)] == HitKind::given_up) continue;
      const double allowed = 10 * (same_hit * parts.size() + 8 * parts.rounding(rays[i].origin));
      if (!((samples.position.row(k) - on_rays.row(k)).norm() <= allowed)) off.push_back(k);
    }
  if (!off.empty()) {
    const ClosestPoints found = closest(surface, on_rays(off, Eigen::all), {.prove = false});
    for (size_t m = 0; m < off.size(); ++m) hits.places[size_t(off[m])] = found.places[m];
    surface.samples().evaluate(hits.places, 1, true, samples);
  }
  hits.points.swap(samples.position);
  hits.normals.swap(samples.normal);
  hits.status = std::move(samples.status);
  for (size_t k = 0; k < hits.kinds.size(); ++k) {
    if (hits.kinds[k] != HitKind::given_up) continue;
    hits.points.row(Eigen::Index(k)) = on_rays.row(Eigen::Index(k));
    hits.normals.row(Eigen::Index(k)).setZero();
    hits.status[k] = LimitStatus::outside;
  }
}

std::int64_t not_crossing(const std::vector<Tracer::Hit>& hits) {
  return std::ranges::count_if(hits, [](const Tracer::Hit& hit) { return hit.kind != HitKind::crossing; });
}

void check(const Ray& ray, const std::string& which) {
  if (!ray.origin.allFinite() || !ray.direction.allFinite() || std::isnan(ray.tmin) || std::isnan(ray.tmax))
    throw InvalidParameter(which + " is not finite");
  if (ray.origin.cwiseAbs().maxCoeff() > farthest_coordinate)
    throw InvalidParameter(which + " begins at a coordinate above 1e150 in size");
  if (ray.direction.isZero(0)) throw InvalidParameter(which + " has the direction (0, 0, 0)");
  if (ray.tmin > ray.tmax)
    throw InvalidParameter(which + " ends at t = " + format_number(ray.tmax) + ", before it begins");
}

void check(const std::vector<Ray>& rays) {
  for (size_t i = 0; i < rays.size(); ++i) check(rays[i], "ray " + std::to_string(i));
}

void check(const RayOptions& options) {
  if (options.most_parts < 1)
    throw InvalidParameter("a ray is given up after " + std::to_string(options.most_parts) +
                           " parts; 1 or more is right");
}

void check_has_parts(const PartedSurface& surface) {
  if (const std::string which = surface.without_parts(); !which.empty())
    throw UnsupportedTopology("rays need polynomial or rational surfaces: " + which);
}

}  // namespace

const char* name(HitKind kind) {
  switch (kind) {
    case HitKind::crossing:
      return "crossing";
    case HitKind::touching:
      return "touching";
    default:
      return "given-up";
  }
}

const char* RayHits::word(std::int64_t hit) const {
  const HitKind kind = kinds[size_t(hit)];
  return kind == HitKind::crossing ? name(status[size_t(hit)]) : name(kind);
}

RayHits intersect(const LimitSurface& surface, const std::vector<Ray>& rays, const RayOptions& options) {
  return intersect(PartedLimit(surface), rays, options);
}
RayHits LimitSurface::intersect(const std::vector<Ray>& rays, const RayOptions& options) const {
  return sublimit::intersect(*this, rays, options);
}
RayHits LimitSurface::intersect(const std::vector<Ray>& rays) const { return sublimit::intersect(*this, rays); }

RayHits intersect(const Patches& patches, const std::vector<Ray>& rays, const RayOptions& options) {
  return intersect(PartedPatches(patches.set(), patches.points()), rays, options);
}
RayHits Patches::intersect(const std::vector<Ray>& rays, const RayOptions& options) const {
  return sublimit::intersect(*this, rays, options);
}
RayHits Patches::intersect(const std::vector<Ray>& rays) const { return sublimit::intersect(*this, rays); }

RayHits intersect(const LimitMap& surface, const Points& points, const std::vector<Ray>& rays,
                  const RayOptions& options) {
  return intersect(PartedLimit(surface, points), rays, options);
}

RayHits intersect(const PartedSurface& surface, const std::vector<Ray>& rays, const RayOptions& options) {
  check(rays);
  check(options);
  check_has_parts(surface);
  const SurfaceParts parts(surface, PartBoxes::for_rays);
  std::vector<std::vector<Tracer::Hit>> found(rays.size());
  RayHits result;
  result.undecided.resize(rays.size());
  parallel_for_blocks(
      std::ssize(rays),
      [&](std::int64_t, std::int64_t begin, std::int64_t end) {
        Tracer trace(parts, options);
        for (auto i = size_t(begin); i < size_t(end); ++i) {
          found[i] = trace(rays[i]);
          result.undecided[i] = not_crossing(found[i]);
        }
      },
      64);
  result.first = {0};
  for (const std::vector<Tracer::Hit>& hits : found) {
    for (const Tracer::Hit& hit : hits) {
      result.t.push_back(hit.t);
      result.kinds.push_back(hit.kind);
      result.places.push_back(hit.place);
    }
    result.first.push_back(std::ssize(result.t));
  }
  place_on_rays(surface, rays, parts, result);
  return result;
}

struct RayTracer::Prepared {
  SurfaceParts parts;
  std::vector<std::int64_t> first;  // parts of address a are [first[a], first[a + 1])
  // What cuts parts is made once a thread.
  tbb::enumerable_thread_specific<Tracer> tracers{[this] { return Tracer(parts); }};
  std::optional<LimitMap> map = {};  // whose types the parts refer to
};

RayTracer::RayTracer(const LimitSurface& surface) : RayTracer(PartedLimit(surface)) { prepared_->map = surface.map(); }

RayTracer::RayTracer(const PartedSurface& surface) {
  check_has_parts(surface);
  prepared_.reset(new Prepared{.parts = SurfaceParts(surface, PartBoxes::for_rays),
                               .first = std::vector<std::int64_t>(size_t(surface.faces().size) + 1)});
  std::vector<std::int64_t>& first = prepared_->first;
  for (const SurfacePart& part : prepared_->parts.parts()) ++first[size_t(part.address) + 1];
  std::partial_sum(first.begin(), first.end(), first.begin());
}

std::vector<RayHit> RayTracer::trace(const Ray& ray, const RayOptions& options, std::optional<Index> address,
                                     std::int64_t* undecided) const {
  check(ray, "the ray");
  check(options);
  const std::vector<std::int64_t>& first = prepared_->first;
  const Index addresses = static_cast<Index>(std::ssize(first) - 1);
  if (address && (*address < 0 || *address >= addresses))
    throw InvalidParameter("address " + std::to_string(*address) + " of " + std::to_string(addresses));
  Tracer& trace = prepared_->tracers.local();
  trace.set(options);
  const std::vector<Tracer::Hit> found =
      address ? trace(ray, first[size_t(*address)], first[size_t(*address) + 1]) : trace(ray);
  if (undecided) *undecided = not_crossing(found);
  std::vector<RayHit> hits;
  hits.reserve(found.size());
  for (const Tracer::Hit& hit : found) hits.push_back({hit.t, hit.place, hit.kind});
  return hits;
}

}  // namespace sublimit
