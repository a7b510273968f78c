// SPDX-License-Identifier: Apache-2.0
// How far points and normals of the limit surface of Catmull-Clark are from the truth near extraordinary vertices, as a
// table in Markdown: OpenSubdiv's car, helmet, bishop and righthanded, by the distance 2^-1 ... 2^-12 to the corner of
// the square, three places each inside all squares there. The truth is refinement and limit masks (dyadic_limits.h),
// exact to rounding.
//   off     part of the error along the true normal, over the diagonal of the bounding box
//   along   the rest of it: sliding along the surface
//   normal  angle between normals in degrees; theirs are du x dv
// Everything is in double. Corners are smooth (of another valence than 4) or sharp (at creases that are not regular).
//
// `limit_accuracy [--all] [mesh]`: each distance by itself, too, not all of them together alone.
#include <Eigen/Geometry>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "peers/compare_with_opensubdiv.h"
#include "peers/dyadic_limits.h"
#include "peers/opensubdiv_limit_reference.h"
#include "sublimit/io/read_mesh.h"
#include "sublimit/surface/limit_map.h"

namespace sublimit::bench {
namespace {

using testing::DyadicLimit;
using testing::SquareCorner;

constexpr int last_exponent = 12;

struct Point {
  Eigen::Vector3d position, normal;  ///< the normal is zero where there is none
};
/// Who makes points at all places.
struct Contender {
  std::string name;
  std::function<std::vector<Point>(const Mesh&, const std::vector<Place>&)> points;
};

template <class Limit, class LimitOptions>
Contender opensubdiv(const std::string& name, const LimitOptions& options) {
  return {name, [options](const Mesh& mesh, const std::vector<Place>& places) {
            const Limit limit(mesh, testing::reference_options(mesh, "catmull-clark", 0), options);
            std::vector<Point> points;
            for (const Place& place : places) {
              const testing::ReferencePoint p = limit.at(place).value();
              const Eigen::Vector3d normal = p.du.cross(p.dv);
              points.push_back({p.position, normal.norm() > 0 ? Eigen::Vector3d(normal.normalized()) : normal});
            }
            return points;
          }};
}

Contender ours() {
  return {"ours", [](const Mesh& mesh, const std::vector<Place>& places) {
            const LimitMap surface(testing::scheme_for(mesh, "catmull-clark"), mesh);
            const LimitSamples made = surface.evaluate(mesh.positions, places, 1);
            std::vector<Point> points;
            for (Index i = 0; i < made.position.rows(); ++i)
              points.push_back({made.position.row(i).transpose(), made.normal.row(i).transpose()});
            return points;
          }};
}

std::vector<Contender> contenders() {
  using testing::BfrLimit;
  using testing::FarLimit;
  return {opensubdiv<BfrLimit>("Bfr, default", BfrLimit::Options{}),
          opensubdiv<BfrLimit>("Bfr, level 10", BfrLimit::Options{.smooth_level = 10, .sharp_level = 10}),
          opensubdiv<FarLimit>("Far, level 4", FarLimit::Options{.level = 4}),
          opensubdiv<FarLimit>("Far, default (level 10)", FarLimit::Options{.level = 10}),
          opensubdiv<FarLimit>("Far, best", FarLimit::Options{.level = 10, .inf_sharp_patches = true}),
          ours()};
}

struct Errors {
  double off = 0, along = 0, normal = 0;  ///< largest
  double off_sum = 0, along_sum = 0, normal_sum = 0;
  int count = 0, normals = 0, without_normal = 0;

  void add(const DyadicLimit& truth, const Point& p, double box) {
    if (!truth.has_normal) return;
    const Eigen::Vector3d error = p.position - truth.position;
    const double off_part = std::abs(error.dot(truth.normal)) / box;
    const double along_part = (error - error.dot(truth.normal) * truth.normal).norm() / box;
    ++count;
    off = std::max(off, off_part);
    along = std::max(along, along_part);
    off_sum += off_part;
    along_sum += along_part;
    if (p.normal.norm() == 0) {
      ++without_normal;
      return;
    }
    const double angle =
        std::atan2(p.normal.cross(truth.normal).norm(), p.normal.dot(truth.normal)) * 180 / std::numbers::pi;
    ++normals;
    normal = std::max(normal, angle);
    normal_sum += angle;
  }
};

void print_row(const std::string& mesh, const char* corners, const std::string& distance, const std::string& who,
               const Errors& e) {
  std::printf("| %s | %s | %s | %s | %.1e | %.1e | %.1e | %.1e | %.1e | %.1e | %d%s |\n", mesh.c_str(), corners,
              distance.c_str(), who.c_str(), e.off, e.off_sum / e.count, e.along, e.along_sum / e.count, e.normal,
              e.normal_sum / std::max(1, e.normals), e.count,
              e.without_normal ? (", " + std::to_string(e.without_normal) + " without normal").c_str() : "");
}

void print_mesh(const std::string& name, const Mesh& mesh, bool every_distance) {
  testing::DyadicLimits truth(testing::scheme_for(mesh, "catmull-clark"), mesh);
  const double box = (mesh.positions.colwise().maxCoeff() - mesh.positions.colwise().minCoeff()).norm();
  std::vector<DyadicLimit> limits[2];  // at smooth, sharp corners
  for (const SquareCorner& c : truth.corners()) {
    if (c.kind == SquareCorner::Kind::regular) continue;
    auto& list = limits[c.kind == SquareCorner::Kind::sharp];
    const std::vector<DyadicLimit> made = truth.towards(c, last_exponent);
    list.insert(list.end(), made.begin(), made.end());
  }
  for (const int sharp : {0, 1}) {
    if (limits[sharp].empty()) continue;
    const char* corners = sharp ? "sharp" : "smooth";
    std::vector<Place> places;
    for (const DyadicLimit& l : limits[sharp]) places.push_back(l.place);
    std::vector<std::vector<Errors>> errors;  // by contender, by exponent; 0: all
    const std::vector<Contender> who = contenders();
    for (const Contender& c : who) {
      const std::vector<Point> points = c.points(mesh, places);
      errors.emplace_back(last_exponent + 1);
      for (size_t i = 0; i < places.size(); ++i)
        for (const int exponent : {0, limits[sharp][i].exponent})
          errors.back()[exponent].add(limits[sharp][i], points[i], box);
    }
    for (int exponent = 0; exponent <= (every_distance ? last_exponent : 0); ++exponent)
      for (size_t i = 0; i < who.size(); ++i)
        print_row(name, corners, exponent == 0 ? "all" : "2^-" + std::to_string(exponent), who[i].name,
                  errors[i][exponent]);
    std::fflush(stdout);
  }
}

int main(int argc, char** argv) {
  bool every_distance = false;
  std::vector<std::string> names;
  for (int i = 1; i < argc; ++i) {
    if (std::string(argv[i]) == "--all") {
      every_distance = true;
    } else {
      names.push_back(argv[i]);
    }
  }
  if (names.empty()) names = {"car", "helmet", "bishop", "righthanded"};
  std::printf("| mesh | corners | distance | | off, max | mean | along, max | mean | normal, max | mean | places |\n");
  std::printf("|---|---|---|---|---|---|---|---|---|---|---|\n");
  for (const std::string& name : names) {
    const std::filesystem::path path = std::filesystem::path(SUBLIMIT_SHARED_MESHES) / ("catmark_" + name + ".obj");
    if (!std::filesystem::exists(path)) {
      std::fprintf(stderr, "limit_accuracy: NO %s: it is not measured\n", path.c_str());
      continue;
    }
    print_mesh(name, read_mesh(path), every_distance);
  }
  return 0;
}

}  // namespace
}  // namespace sublimit::bench

int main(int argc, char** argv) { return sublimit::bench::main(argc, argv); }
