// SPDX-License-Identifier: Apache-2.0
// A limit surface in a renderer: Embree's tree over the boxes of faces, our exact hits inside of them.
//
// Embree has a user geometry, whose primitives are what its callbacks say. Here a primitive is an address of the
// surface, a square or triangle: `LimitMap::bounding_boxes` bounds it, and `RayTracer::trace` meets it. Nothing is
// tessellated; the surface takes part in a scene with triangles and all else that Embree has.
//
// Embree's rays are float. Its tree only chooses addresses; what it chooses is traced with the ray in double, which
// goes along in the context, and so does the hit: t, and the place (face, u, v) that shading starts from.
#include <embree3/rtcore.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <random>

#include "meshes/meshes.h"
#include "sublimit/base/detail/parallel_for.h"
#include "sublimit/schemes/schemes.h"
#include "sublimit/search/intersect.h"
#include "sublimit/surface/limit_map.h"
#include "support/tolerance.h"

namespace sublimit::testing {
namespace {

/// A ray on its way through Embree. The callbacks get the address of `embree`, the first member, as their context.
struct Query {
  RTCIntersectContext embree = {};
  Ray ray = {};
  RayHit nearest{std::numeric_limits<double>::infinity(), {}};
};

/// What a renderer makes of a surface in one pose. A new pose has new boxes, a new RayTracer, and `rtcCommitGeometry`.
class LimitGeometry {
 public:
  LimitGeometry(RTCDevice device, const LimitMap& surface, const Points& points)
      : tracer_(surface, points), boxes_(surface.bounding_boxes(points)), scene_(rtcNewScene(device)) {
    const RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryUserPrimitiveCount(geometry, unsigned(boxes_.size()));
    rtcSetGeometryUserData(geometry, this);
    rtcSetGeometryBoundsFunction(geometry, bounds, nullptr);
    rtcSetGeometryIntersectFunction(geometry, intersect);
    rtcSetGeometryOccludedFunction(geometry, occluded);
    rtcCommitGeometry(geometry);
    // Boxes are not missed by the rounding of Embree's own arithmetic.
    rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene_);
  }
  ~LimitGeometry() { rtcReleaseScene(scene_); }
  LimitGeometry(const LimitGeometry&) = delete;
  LimitGeometry& operator=(const LimitGeometry&) = delete;

  /// The nearest hit; t is infinite if there is none.
  RayHit nearest(const Ray& ray) const {
    Query query{.ray = ray};
    rtcInitIntersectContext(&query.embree);
    RTCRayHit in{};
    in.ray = in_float(ray);
    in.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(scene_, &query.embree, &in);
    return query.nearest;
  }
  /// Whether there is any, as for shadows.
  bool is_hit(const Ray& ray) const {
    Query query{.ray = ray};
    rtcInitIntersectContext(&query.embree);
    RTCRay in = in_float(ray);
    rtcOccluded1(scene_, &query.embree, &in);
    return in.tfar == -INFINITY;
  }

 private:
  static RTCRay in_float(const Ray& ray) {
    RTCRay in{};
    in.org_x = float(ray.origin.x()), in.org_y = float(ray.origin.y()), in.org_z = float(ray.origin.z());
    in.dir_x = float(ray.direction.x()), in.dir_y = float(ray.direction.y()), in.dir_z = float(ray.direction.z());
    in.tnear = float(ray.tmin), in.tfar = float(ray.tmax);
    in.mask = ~0u;
    return in;
  }

  /// Of one address: boxes in float that hold those in double.
  static void bounds(const RTCBoundsFunctionArguments* arguments) {
    const auto& self = *static_cast<const LimitGeometry*>(arguments->geometryUserPtr);
    const Eigen::AlignedBox3d& box = self.boxes_[arguments->primID];
    const auto down = [](double x) { return std::nextafterf(float(x), -INFINITY); };
    const auto up = [](double x) { return std::nextafterf(float(x), INFINITY); };
    RTCBounds& out = *arguments->bounds_o;
    out.lower_x = down(box.min().x()), out.lower_y = down(box.min().y()), out.lower_z = down(box.min().z());
    out.upper_x = up(box.max().x()), out.upper_y = up(box.max().y()), out.upper_z = up(box.max().z());
  }

  /// The nearest hit of one address, if it is nearer than what the query has. May be called by any number of threads,
  /// each with queries of its own.
  static void intersect(const RTCIntersectFunctionNArguments* arguments) {
    if (arguments->N != 1 || arguments->valid[0] == 0) return;  // rtcIntersect1 comes with one ray
    const auto& self = *static_cast<const LimitGeometry*>(arguments->geometryUserPtr);
    Query& query = *reinterpret_cast<Query*>(arguments->context);
    Ray ray = query.ray;
    ray.tmax = std::min(ray.tmax, query.nearest.t);
    const std::vector<RayHit> hits = self.tracer_.trace(ray, {}, Index(arguments->primID));
    if (hits.empty()) return;
    query.nearest = hits[0];
    RTCRayHit& hit = *reinterpret_cast<RTCRayHit*>(arguments->rayhit);
    // Not before t, so that boxes of nearer hits are still looked at.
    hit.ray.tfar = std::nextafterf(float(hits[0].t), INFINITY);
    hit.hit.u = float(hits[0].place.u), hit.hit.v = float(hits[0].place.v);
    hit.hit.primID = arguments->primID, hit.hit.geomID = arguments->geomID;
    hit.hit.instID[0] = arguments->context->instID[0];
  }
  static void occluded(const RTCOccludedFunctionNArguments* arguments) {
    if (arguments->N != 1 || arguments->valid[0] == 0) return;
    const auto& self = *static_cast<const LimitGeometry*>(arguments->geometryUserPtr);
    const Query& query = *reinterpret_cast<const Query*>(arguments->context);
    if (!self.tracer_.trace(query.ray, {}, Index(arguments->primID)).empty())
      reinterpret_cast<RTCRay*>(arguments->ray)->tfar = -INFINITY;
  }

  RayTracer tracer_;
  std::vector<Eigen::AlignedBox3d> boxes_;
  RTCScene scene_;
};

/// From outside through a mesh; numbers are floats, so that Embree's rays are the same.
std::vector<Ray> camera(const Mesh& mesh, int count) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  const Eigen::Vector3d middle = mesh.positions.colwise().mean();
  const double size = diagonal(mesh.positions);
  std::vector<Ray> rays(static_cast<size_t>(count));
  for (Ray& ray : rays) {
    const Eigen::Vector3d out = Eigen::Vector3d(normal(random), normal(random), normal(random)).normalized();
    const Eigen::Vector3d aim(normal(random), normal(random), normal(random));
    ray.origin = (middle + 2 * size * out).cast<float>().cast<double>();
    ray.direction = (middle + 0.2 * size * aim - ray.origin).cast<float>().cast<double>();
  }
  return rays;
}

TEST(EmbreeUserGeometry, HasTheHitsOfIntersect) {
  const std::unique_ptr<RTCDeviceTy, decltype(&rtcReleaseDevice)> device(rtcNewDevice(nullptr), rtcReleaseDevice);
  ASSERT_NE(device, nullptr);
  Mesh creased = jittered(cube());
  add_crease(creased, {0, 1, 3}, 10);
  Mesh holed = jittered(grid(6, 5));
  holed.holes = {7};
  const std::vector<std::pair<const char*, Mesh>> scenes{{"catmull-clark", creased},
                                                         {"catmull-clark", jittered(torus(12, 8))},
                                                         {"catmull-clark", holed},
                                                         {"loop", jittered(icosahedron())},
                                                         {"doo-sabin", jittered(prism(5))}};
  for (const auto& [scheme, mesh] : scenes) {
    SCOPED_TRACE(scheme);
    const LimitMap surface(find_scheme(scheme).value(), mesh);
    const LimitGeometry geometry(device.get(), surface, mesh.positions);
    ASSERT_EQ(rtcGetDeviceError(device.get()), RTC_ERROR_NONE);
    const std::vector<Ray> rays = camera(mesh, 4000);
    std::vector<RayHit> found(rays.size());
    std::vector<std::uint8_t> is_hit(rays.size());
    parallel_for(std::ssize(rays), [&](std::int64_t i) {
      found[size_t(i)] = geometry.nearest(rays[size_t(i)]);
      is_hit[size_t(i)] = geometry.is_hit(rays[size_t(i)]);
    });

    const RayHits truth = intersect(surface, mesh.positions, rays);
    std::vector<Place> places;
    std::vector<Eigen::Vector3d> on_rays;
    for (size_t i = 0; i < rays.size(); ++i) {
      const bool hits = truth.first[i + 1] > truth.first[i];
      ASSERT_EQ(std::isfinite(found[i].t), hits) << i;
      EXPECT_EQ(is_hit[i] != 0, hits) << i;
      if (!hits) continue;
      EXPECT_NEAR(found[i].t, truth.t[size_t(truth.first[i])], found_hit) << i;
      places.push_back(found[i].place);
      on_rays.emplace_back(rays[i].origin + found[i].t * rays[i].direction);
    }
    EXPECT_GT(places.size(), 500u);
    // Shading: position, derivatives and normal at the place of the nearest hit, of the pose that was bound once.
    const std::unique_ptr<BoundSource> pose = surface.bound(mesh.positions);
    LimitSamples shading;
    pose->evaluate(places, 1, true, shading);
    for (size_t k = 0; k < places.size(); ++k)
      EXPECT_LE((shading.position.row(Eigen::Index(k)).transpose() - on_rays[k]).norm(),
                found_hit * diagonal(mesh.positions));
  }
}

}  // namespace
}  // namespace sublimit::testing
