// SPDX-License-Identifier: Apache-2.0
// Nearest points of the limit and rays, beside Embree (float) on triangles: those of a grid of 32 x 32 limit points a
// face, as a mesh refined five times has them.
//   closest   points in the mesh's box, a little larger: microseconds a point, trees made anew; with and without proof
//   rays      through that box, the nearest hit: ours, Embree's triangles, Embree's own subdivision geometry of the
//   same
//             rate
//   error     of these triangles, in parts of the box's diagonal: the largest difference of a distance; of t that which
//             one ray in a hundred exceeds, as rays that graze the surface miss triangles. Ours is the truth here;
//             tests compare it with brute force.
#include <embree3/rtcore.h>

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <random>

#include "bench_meshes.h"
#include "measuring.h"
#include "bench_report.h"
#include "sublimit/base/detail/parallel_for.h"
#include "sublimit/schemes/schemes.h"
#include "sublimit/search/closest_point.h"
#include "sublimit/search/intersect.h"
#include "sublimit/surface/limit_map.h"

namespace sublimit::bench {
namespace {

constexpr int steps = 32;  // a side of a face

/// The nearest point of a triangle. Ericson 2004, "Real-Time Collision Detection", section 5.1.5.
Eigen::Vector3f nearest_of_triangle(const Eigen::Vector3f& p, const Eigen::Vector3f& a, const Eigen::Vector3f& b,
                                    const Eigen::Vector3f& c) {
  const Eigen::Vector3f ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
  const float d1 = ab.dot(ap), d2 = ac.dot(ap), d3 = ab.dot(bp), d4 = ac.dot(bp), d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d1 <= 0 && d2 <= 0) return a;
  if (d3 >= 0 && d4 <= d3) return b;
  if (d6 >= 0 && d5 <= d6) return c;
  const float vc = d1 * d4 - d3 * d2, vb = d5 * d2 - d1 * d6, va = d3 * d6 - d5 * d4;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return a + d1 / (d1 - d3) * ab;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return a + d2 / (d2 - d6) * ac;
  if (va <= 0 && d4 >= d3 && d5 >= d6) return b + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (c - b);
  return a + (vb * ab + vc * ac) / (va + vb + vc);
}

/// Triangles, or a subdivision geometry, in a scene.
class EmbreeScene {
 public:
  explicit EmbreeScene(const Case& mesh, bool triangles) : device_(rtcNewDevice(nullptr)) {
    if (!device_) throw std::runtime_error("Embree makes no device");
    if (triangles)
      add_triangles(mesh);
    else
      add_subdivision(mesh);
  }
  ~EmbreeScene() {
    forget();
    rtcReleaseDevice(device_);
  }
  EmbreeScene(const EmbreeScene&) = delete;
  EmbreeScene& operator=(const EmbreeScene&) = delete;

  /// Its tree, anew.
  void commit() {
    forget();
    geometry_ = rtcNewGeometry(device_, peer_ ? RTC_GEOMETRY_TYPE_SUBDIVISION : RTC_GEOMETRY_TYPE_TRIANGLE);
    const auto share = [&](RTCBufferType type, RTCFormat format, const void* data, size_t stride, size_t count) {
      if (count > 0) rtcSetSharedGeometryBuffer(geometry_, type, 0, format, data, 0, stride, count);
    };
    share(RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, points_.data(), 12, points_.size() / 3);
    if (peer_) {
      const PeerMesh& m = peer_->mesh;
      share(RTC_BUFFER_TYPE_FACE, RTC_FORMAT_UINT, m.face_sizes.data(), 4, m.face_sizes.size());
      share(RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT, m.face_vertices.data(), 4, m.face_vertices.size());
      share(RTC_BUFFER_TYPE_EDGE_CREASE_INDEX, RTC_FORMAT_UINT2, m.crease_vertices.data(), 8,
            m.crease_sharpness.size());
      share(RTC_BUFFER_TYPE_EDGE_CREASE_WEIGHT, RTC_FORMAT_FLOAT, m.crease_sharpness.data(), 4,
            m.crease_sharpness.size());
      share(RTC_BUFFER_TYPE_VERTEX_CREASE_INDEX, RTC_FORMAT_UINT, m.corner_vertices.data(), 4,
            m.corner_sharpness.size());
      share(RTC_BUFFER_TYPE_VERTEX_CREASE_WEIGHT, RTC_FORMAT_FLOAT, m.corner_sharpness.data(), 4,
            m.corner_sharpness.size());
      rtcSetGeometrySubdivisionMode(geometry_, 0, RTC_SUBDIVISION_MODE_PIN_CORNERS);
      rtcSetGeometryTessellationRate(geometry_, float(steps));
    } else {
      share(RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, triangles_.data(), 12, triangles_.size() / 3);
    }
    rtcCommitGeometry(geometry_);
    scene_ = rtcNewScene(device_);
    rtcAttachGeometry(scene_, geometry_);
    rtcCommitScene(scene_);
    if (rtcGetDeviceError(device_) != RTC_ERROR_NONE) throw std::runtime_error("Embree refuses the mesh");
  }

  double distance(const Eigen::Vector3d& from) const {
    RTCPointQuery query{float(from[0]), float(from[1]), float(from[2]), 0, HUGE_VALF};
    RTCPointQueryContext context;
    rtcInitPointQueryContext(&context);
    rtcPointQuery(scene_, &query, &context, nearer, const_cast<EmbreeScene*>(this));
    return query.radius;
  }
  /// Infinite of a miss.
  double t(const Ray& ray) const {
    RTCRayHit hit{};
    const auto xyz = [](const Eigen::Vector3d& x, float& a, float& b, float& c) {
      a = float(x[0]), b = float(x[1]), c = float(x[2]);
    };
    xyz(ray.origin, hit.ray.org_x, hit.ray.org_y, hit.ray.org_z);
    xyz(ray.direction, hit.ray.dir_x, hit.ray.dir_y, hit.ray.dir_z);
    hit.ray.tfar = HUGE_VALF;
    hit.ray.mask = ~0u;
    hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(scene_, &context, &hit);
    return hit.hit.geomID == RTC_INVALID_GEOMETRY_ID ? HUGE_VAL : double(hit.ray.tfar);
  }

 private:
  void add_triangles(const Case& c) {
    const LimitMap surface(find_scheme(c.scheme).value(), c.mesh);
    const Points grid = surface.evaluate_grid(c.mesh.positions, steps + 1).position;
    points_.assign(grid.data(), grid.data() + grid.size());
    for (unsigned face = 0; face < unsigned(surface.faces().size); ++face)
      for (unsigned j = 0; j < steps; ++j)
        for (unsigned i = 0; i < steps; ++i) {
          const unsigned at = (face * (steps + 1) + j) * (steps + 1) + i;
          for (const unsigned k : {at, at + 1, at + steps + 2, at, at + steps + 2, at + steps + 1})
            triangles_.push_back(k);
        }
    points_.push_back(0);  // the last vertex is read as four floats
  }
  void add_subdivision(const Case& c) {
    peer_.emplace(c);
    points_.assign(c.mesh.positions.data(), c.mesh.positions.data() + c.mesh.positions.size());
    points_.push_back(0);
  }
  void forget() {
    if (geometry_) rtcReleaseGeometry(geometry_);
    if (scene_) rtcReleaseScene(scene_);
    geometry_ = nullptr, scene_ = nullptr;
  }
  static bool nearer(RTCPointQueryFunctionArguments* arguments) {
    const auto& self = *static_cast<const EmbreeScene*>(arguments->userPtr);
    RTCPointQuery& query = *arguments->query;
    const auto corner = [&](size_t k) {
      return Eigen::Map<const Eigen::Vector3f>(&self.points_[3 * self.triangles_[3 * arguments->primID + k]]);
    };
    const Eigen::Vector3f from(query.x, query.y, query.z);
    const float distance = (nearest_of_triangle(from, corner(0), corner(1), corner(2)) - from).norm();
    if (distance >= query.radius) return false;
    query.radius = distance;
    return true;
  }

  RTCDevice device_;
  RTCGeometry geometry_ = nullptr;
  RTCScene scene_ = nullptr;
  std::optional<PeerCase> peer_;
  std::vector<float> points_;
  std::vector<unsigned> triangles_;
};

struct Box {
  Eigen::Array3d low, high;
  explicit Box(const Mesh& mesh)
      : low(mesh.positions.colwise().minCoeff().transpose()), high(mesh.positions.colwise().maxCoeff().transpose()) {}
  double diagonal() const { return (high - low).matrix().norm(); }
  Eigen::Vector3d random(std::mt19937& numbers) const {
    std::uniform_real_distribution<double> uniform(-0.1, 1.1);
    const Eigen::Array3d x(uniform(numbers), uniform(numbers), uniform(numbers));
    return low + x * (high - low);
  }
};

std::function<double()> turn(int threads, int count, const std::function<void()>& work) {
  return [=] { return timed(threads, work) / count; };
}

void measure_closest(Report& report, const Case& c, int count) {
  if (!report.wants("closest", c.name)) return;
  std::mt19937 numbers(1);
  const Box box(c.mesh);
  Points q(count, 3);
  for (int i = 0; i < count; ++i) q.row(i) = box.random(numbers);
  const LimitMap surface(find_scheme(c.scheme).value(), c.mesh);
  EmbreeScene triangles(c, true);
  std::vector<double> theirs(static_cast<size_t>(count));
  ClosestPoints ours;
  for (const int threads : report.threads()) {
    const Threads scope(threads);
    report.measure(
        {"closest", c.name, "", threads, "us", 1e6},
        {{"ours", Role::ours, turn(threads, count, [&] { ours = closest(surface, c.mesh.positions, q); })},
         {"unproved", Role::shown,
          turn(threads, count, [&] { ours = closest(surface, c.mesh.positions, q, {.prove = false}); })},
         {"Embree float", Role::peer, turn(threads, count, [&] {
            triangles.commit();
            parallel_for(count, [&](std::int64_t i) { theirs[size_t(i)] = triangles.distance(q.row(i).transpose()); });
          })}});
  }
  double error = 0, open = 0;
  for (int i = 0; i < count; ++i) {
    error = std::max(error, std::abs(theirs[size_t(i)] - ours.distances[i]) / box.diagonal());
    open = std::max(open, (ours.distances[i] - ours.lower[i]) / box.diagonal());
  }
  report.add({"closest error", c.name, "", 1, "of the diagonal", 1},
             {{"ours, not proved", Role::shown, {open}}, {"Embree float", Role::shown, {error}}});
}

void measure_rays(Report& report, const Case& c, int count) {
  if (!report.wants("rays", c.name)) return;
  std::mt19937 numbers(2);
  const Box box(c.mesh);
  std::vector<Ray> rays(static_cast<size_t>(count));
  for (Ray& ray : rays) {
    const Eigen::Vector3d through = box.random(numbers), along = box.random(numbers) - box.random(numbers);
    ray = {through - 2 * box.diagonal() * along.normalized(), along.normalized()};
  }
  const LimitMap surface(find_scheme(c.scheme).value(), c.mesh);
  EmbreeScene triangles(c, true), subdivision(c, false);
  RayHits ours;
  std::array<std::vector<double>, 2> theirs{std::vector<double>(rays.size()), std::vector<double>(rays.size())};
  const auto trace = [&](EmbreeScene& scene, size_t which) {
    scene.commit();
    parallel_for(count, [&](std::int64_t i) { theirs[which][size_t(i)] = scene.t(rays[size_t(i)]); });
  };
  for (const int threads : report.threads()) {
    const Threads scope(threads);
    report.measure(
        {"rays", c.name, "", threads, "us", 1e6},
        {{"ours", Role::ours, turn(threads, count, [&] { ours = intersect(surface, c.mesh.positions, rays); })},
         {"Embree triangles", Role::peer, turn(threads, count, [&] { trace(triangles, 0); })},
         {"Embree subdivision", Role::peer, turn(threads, count, [&] { trace(subdivision, 1); })}});
  }
  // Of rays that both hit, t; and how many only one of them hits.
  std::array<std::vector<double>, 2> error;
  std::array<double, 2> apart{};
  for (size_t i = 0; i < rays.size(); ++i) {
    const bool hit = ours.first[i + 1] > ours.first[i];
    for (size_t which = 0; which < 2; ++which) {
      const double t = theirs[which][i];
      if (hit != std::isfinite(t))
        ++apart[which];
      else if (hit)
        error[which].push_back(std::abs(t - ours.t[size_t(ours.first[i])]) / box.diagonal());
    }
  }
  const auto large = [&](size_t which) {
    std::ranges::sort(error[which]);
    return error[which].empty() ? 0 : error[which][error[which].size() * 99 / 100];
  };
  report.add({"rays error", c.name, "", 1, "of the diagonal", 1},
             {{"Embree triangles", Role::shown, {large(0)}}, {"Embree subdivision", Role::shown, {large(1)}}});
  report.add({"rays one of both hits", c.name, "", 1, "of 1000", 1},
             {{"Embree triangles", Role::shown, {1000 * apart[0] / count}},
              {"Embree subdivision", Role::shown, {1000 * apart[1] / count}}});
}

int run(int argc, char** argv) {
  Report report("search_bench", argc, argv);
  report.take_turns(3);
  const int count = report.quick() ? 200 : 20'000;
  std::vector<Case> meshes;
  for (Case& c : cases(true))
    if (c.scheme == "catmull-clark") meshes.push_back(std::move(c));
  for (const Case& c : meshes) measure_closest(report, c, count);
  for (const Case& c : meshes) measure_rays(report, c, count);
  return report.finish();
}

}  // namespace
}  // namespace sublimit::bench

int main(int argc, char** argv) { return sublimit::bench::run(argc, argv); }
