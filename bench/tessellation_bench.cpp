// SPDX-License-Identifier: Apache-2.0
// Triangles near the limit, beside uniform levels and OpenSubdiv's Bfr::Tessellation, at equal error.
//   triangles   that are as near as ours: the measured error of ours within a chord is what the others may have, and
//               they take the least level, the least uniform rate, and the coarsest rates by lengths of edges, that
//               keep it
//   tessellate  the time of all that from the mesh: ours in double, with a proof; theirs in float, told their rates
// Errors are the largest distance of triangles and limit at equal parameters, at 15 places a triangle, in
// quadrilaterals (triangles of Loop); patterns are compared, with exact points in all of them.
#include <opensubdiv/bfr/refinerSurfaceFactory.h>
#include <opensubdiv/bfr/tessellation.h>
#include <opensubdiv/far/primvarRefiner.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "bench_meshes.h"
#include "measuring.h"
#include "opensubdiv_point.h"
#include "opensubdiv_refiner.h"
#include "bench_report.h"
#include "sublimit/surface/limit_map.h"
#include "sublimit/stencils/patterns/demo_mesh.h"
#include "sublimit/schemes/schemes.h"
#include "sublimit/tessellation/tessellate.h"
#include "support/tolerance.h"

namespace sublimit::bench {
namespace {

namespace Bfr = OpenSubdiv::Bfr;
namespace Far = OpenSubdiv::Far;

using Triangles = std::vector<Tessellation::Triangle>;

/// Largest distance of triangles from the limit along its normal; only that it is larger, once it is.
double error_of(const LimitMap& surface, const Points& control, const Triangles& triangles, double most) {
  constexpr int steps = 4;
  constexpr size_t at_once = 4096;
  double largest = 0;
  std::vector<Place> places;
  for (size_t begin = 0; begin < triangles.size() && largest <= most; begin += at_once) {
    const size_t end = std::min(begin + at_once, triangles.size());
    places.clear();
    for (size_t t = begin; t < end; ++t)
      for (int i = 0; i <= steps; ++i)
        for (int j = 0; i + j <= steps; ++j) {
          Place s{triangles[t].face, 0, 0};
          const double w[] = {1 - double(i + j) / steps, double(i) / steps, double(j) / steps};
          for (size_t k = 0; k < 3; ++k) s.u += w[k] * triangles[t].uv[k][0], s.v += w[k] * triangles[t].uv[k][1];
          s.u = std::clamp(s.u, 0.0, 1.0), s.v = std::clamp(s.v, 0.0, surface.faces().triangles ? 1 - s.u : 1.0);
          places.push_back(s);
        }
    const LimitSamples on = surface.evaluate(control, places, 1);
    const Points& x = on.position;
    constexpr Index a_triangle = (steps + 1) * (steps + 2) / 2;
    for (Index first = 0; first < x.rows(); first += a_triangle) {
      const Eigen::RowVector3d a = x.row(first), b = x.row(first + a_triangle - 1), c = x.row(first + steps);
      Index at = first;
      for (int i = 0; i <= steps; ++i)
        for (int j = 0; i + j <= steps; ++j, ++at) {
          const Eigen::RowVector3d off = (a * (steps - i - j) + b * i + c * j) / steps - x.row(at),
                                   n = on.normal.row(at);
          largest = std::max(largest, n.isZero(0) ? off.norm() : std::abs(off.dot(n)));
        }
    }
  }
  return largest;
}

/// Bfr's surfaces of a mesh, and what it makes of rates of edges.
class BfrTessellator {
 public:
  /// Rates of a face's edges, or one for all of it.
  using Rates = std::function<void(Index face, std::vector<int>& rates)>;

  explicit BfrTessellator(const Case& c) : mesh_(c.mesh), peer_(c), is_loop_(c.scheme == "loop") {
    Index first = 0;
    for (const Index size : mesh_.face_sizes) {
      first_.push_back(first);
      first += size;
    }
  }

  Rates uniform(int rate) const {
    return [rate](Index, std::vector<int>& rates) { rates.assign(1, rate); };
  }
  /// As many as edges of the control mesh are longer than an interval.
  Rates by_lengths(double interval) const {
    return [=, this](Index face, std::vector<int>& rates) {
      rates.clear();
      const Index n = mesh_.face_sizes[size_t(face)];
      for (Index k = 0; k < n; ++k) {
        const auto at = [&](Index i) {
          return mesh_.positions.row(mesh_.face_vertices[size_t(first_[size_t(face)] + i)]);
        };
        rates.push_back(std::max(1, int(std::ceil((at(k) - at((k + 1) % n)).norm() / interval))));
      }
    };
  }

  /// Triangles of all faces, and the places of those of quadrilaterals or of Loop's triangles.
  /// @return  how many of all
  std::int64_t pattern(const Rates& rates_of, Triangles& places) const {
    std::int64_t count = 0;
    std::vector<int> rates, facets;
    std::vector<double> coordinates;
    places.clear();
    Index address = 0;
    for (Index face = 0; face < mesh_.num_faces(); ++face) {
      const Index size = mesh_.face_sizes[size_t(face)];
      rates_of(face, rates);
      const Bfr::Tessellation t = tessellation(size, rates);
      count += t.GetNumFacets();
      if (size == (is_loop_ ? 3 : 4)) {
        coordinates.resize(2 * size_t(t.GetNumCoords()));
        facets.resize(3 * size_t(t.GetNumFacets()));
        t.GetCoords(coordinates.data());
        t.GetFacets(facets.data());
        for (size_t i = 0; i < facets.size(); i += 3) {
          Tessellation::Triangle triangle{address, {}, {}};
          for (size_t k = 0; k < 3; ++k) {
            const double* uv = &coordinates[2 * size_t(facets[i + k])];
            triangle.uv[k] = {uv[0], uv[1]};
          }
          places.push_back(triangle);
        }
        ++address;
      } else {
        address += size;
      }
    }
    return count;
  }

  /// All of the work, in float: surfaces, points, triangles; points of edges once for each face.
  void run(const Rates& rates_of) const {
    const std::unique_ptr<Far::TopologyRefiner> refiner = topology_refiner(peer_.mesh);
    const Bfr::RefinerSurfaceFactory<> factory(*refiner);
    const std::vector<float> control(mesh_.positions.data(), mesh_.positions.data() + mesh_.positions.size());
    Bfr::Surface<float> surface;
    std::vector<float> patch_points, coordinates, points;
    std::vector<int> rates, facets, all_facets;
    for (Index face = 0; face < mesh_.num_faces(); ++face) {
      if (!factory.InitVertexSurface(face, &surface)) continue;
      rates_of(face, rates);
      Bfr::Tessellation t = tessellation(mesh_.face_sizes[size_t(face)], rates);
      patch_points.resize(3 * size_t(surface.GetNumPatchPoints()));
      surface.PreparePatchPoints(control.data(), 3, patch_points.data(), 3);
      coordinates.resize(2 * size_t(t.GetNumCoords()));
      t.GetCoords(coordinates.data());
      const size_t first = points.size();
      points.resize(first + 3 * size_t(t.GetNumCoords()));
      for (size_t i = 0; i < size_t(t.GetNumCoords()); ++i)
        surface.Evaluate(&coordinates[2 * i], patch_points.data(), 3, &points[first + 3 * i]);
      facets.resize(3 * size_t(t.GetNumFacets()));
      t.GetFacets(facets.data());
      t.TransformFacetCoordIndices(facets.data(), int(first / 3));
      all_facets.insert(all_facets.end(), facets.begin(), facets.end());
    }
    benchmark::DoNotOptimize(points.data());
    benchmark::DoNotOptimize(all_facets.data());
  }

  /// Points of level k on the limit, in float, and two triangles for each face.
  void run_level(int level) const {
    using Point = OpenSubdivPoint<float>;
    const std::unique_ptr<Far::TopologyRefiner> refiner = topology_refiner(peer_.mesh);
    Far::TopologyRefiner::UniformOptions options(level);
    options.fullTopologyInLastLevel = true;  // the limit needs it
    refiner->RefineUniform(options);
    std::vector<Point> points(size_t(mesh_.num_vertices())), next;
    for (size_t v = 0; v < points.size(); ++v) {
      const auto x = mesh_.positions.row(Index(v));
      points[v].x = float(x[0]), points[v].y = float(x[1]), points[v].z = float(x[2]);
    }
    const Far::PrimvarRefinerReal<float> primvars(*refiner);
    for (int k = 1; k <= level; ++k) {
      next.resize(size_t(refiner->GetLevel(k).GetNumVertices()));
      Point *from = points.data(), *to = next.data();
      primvars.Interpolate(k, from, to);
      points.swap(next);
    }
    next.resize(points.size());
    Point *from = points.data(), *to = next.data();
    primvars.Limit(from, to);
    std::vector<int> triangles;
    const Far::TopologyLevel& last = refiner->GetLevel(level);
    for (int f = 0; f < last.GetNumFaces(); ++f) {
      const Far::ConstIndexArray v = last.GetFaceVertices(f);
      for (int k = 1; k + 1 < v.size(); ++k) triangles.insert(triangles.end(), {v[0], v[k], v[k + 1]});
    }
    benchmark::DoNotOptimize(next.data());
    benchmark::DoNotOptimize(triangles.data());
  }
  std::int64_t triangles_of_level(int level) const {
    double count = 0;
    for (const Index size : mesh_.face_sizes)
      count += level == 0 ? size - 2 : std::ldexp(is_loop_ ? 1 : size / 2.0, 2 * level);
    return static_cast<std::int64_t>(count);
  }

 private:
  Bfr::Tessellation tessellation(Index size, const std::vector<int>& rates) const {
    const Bfr::Parameterization parameters(is_loop_ ? OpenSubdiv::Sdc::SCHEME_LOOP : OpenSubdiv::Sdc::SCHEME_CATMARK,
                                           size);
    return {parameters, int(rates.size()), rates.data()};
  }

  const Mesh& mesh_;
  PeerCase peer_;
  bool is_loop_;
  std::vector<Index> first_;
};

/// What the others need to be as near.
struct Needed {
  int level = 0, rate = 1;
  double interval = 0;
  std::int64_t of_level = 0, of_rate = 0, of_lengths = 0;  ///< triangles
};

Needed needed(const BfrTessellator& bfr, const LimitMap& surface, const Case& c, double error) {
  Needed n;
  Triangles places;
  const auto is_as_near = [&] { return error_of(surface, c.mesh.positions, places, error) <= error; };
  // Points of level k are those of the rate 2^k.
  for (;; ++n.level) {
    bfr.pattern(bfr.uniform(1 << n.level), places);
    if (is_as_near()) break;
  }
  n.of_level = bfr.triangles_of_level(n.level);
  for (;; ++n.rate) {
    n.of_rate = bfr.pattern(bfr.uniform(n.rate), places);
    if (is_as_near()) break;
  }
  n.interval = testing::diagonal(c.mesh.positions);
  for (;; n.interval *= 0.9) {
    n.of_lengths = bfr.pattern(bfr.by_lengths(n.interval), places);
    if (is_as_near()) return n;
  }
}

void measure(Report& report, const Case& c, const char* percent) {
  if (!report.wants("triangles", c.name, percent) && !report.wants("tessellate", c.name, percent)) return;
  const Points& control = c.mesh.positions;
  const TessellationOptions options{.chord = std::atof(percent) / 100 * testing::diagonal(control)};
  const LimitMap surface(find_scheme(c.scheme).value(), c.mesh);
  const Tessellation ours = tessellate(surface, control, options);
  Triangles own = ours.triangles;  // of whole faces, as the others are measured
  std::erase_if(own, [&](const auto& t) { return surface.addresses().place(t.face).corner >= 0; });
  const double error = error_of(surface, control, own, HUGE_VAL);
  const BfrTessellator bfr(c);
  const Needed n = needed(bfr, surface, c, error);
  std::printf("    proved %.3g, measured %.3g of the diagonal; level %d, rate %d\n",
              ours.bound / testing::diagonal(control), error / testing::diagonal(control), n.level, n.rate);
  report.add({"triangles", c.name, percent, 1, "thousands", 1e-3},
             {{"ours", Role::ours, {1e-3 * double(ours.triangles.size())}},
              {"levels", Role::peer, {1e-3 * double(n.of_level)}},
              {"Bfr uniform", Role::peer, {1e-3 * double(n.of_rate)}},
              {"Bfr by lengths", Role::peer, {1e-3 * double(n.of_lengths)}}});
  const Threads scope(1);
  const auto turn = [](const auto& work) { return [=] { return timed(1, work); }; };
  report.measure(
      {"tessellate", c.name, percent, 1, "ms", 1e3},
      {{"ours", Role::ours, turn([&] {
          const LimitMap made(find_scheme(c.scheme).value(), c.mesh);
          benchmark::DoNotOptimize(tessellate(made, control, options));
        })},
       {"surface there", Role::shown, turn([&] { benchmark::DoNotOptimize(tessellate(surface, control, options)); })},
       {"levels", Role::peer, turn([&] { bfr.run_level(n.level); })},
       {"Bfr uniform", Role::peer, turn([&] { bfr.run(bfr.uniform(n.rate)); })},
       {"Bfr by lengths", Role::peer, turn([&] { bfr.run(bfr.by_lengths(n.interval)); })}});
}

int run(int argc, char** argv) {
  Report report("tessellation_bench", argc, argv);
  report.take_turns(5);
  std::vector<Case> meshes = cases(true);
  meshes.push_back({"demo", "catmull-clark", demo_mesh()});
  for (const Case& c : meshes)
    for (const char* percent : {"1%", "0.1%"})
      if (!report.quick() || percent == std::string("1%")) measure(report, c, percent);
  return report.finish();
}

}  // namespace
}  // namespace sublimit::bench

int main(int argc, char** argv) { return sublimit::bench::run(argc, argv); }
