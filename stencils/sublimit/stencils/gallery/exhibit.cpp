// SPDX-License-Identifier: Apache-2.0
#include "sublimit/stencils/gallery/exhibit.h"

#include "sublimit/core/detail/sparse_product.h"
#include "sublimit/limit/detail/limit_points.h"
#include "sublimit/stencils/files/level_files.h"
#include "sublimit/stencils/gallery/measures.h"
#include "sublimit/stencils/picture/picture_mesh.h"

namespace sublimit::gallery {
namespace {

constexpr Color approximating{.42, .60, .70}, interpolating{.74, .58, .42}, cage_wire{.55, .35, .25};

/// Levels up to one of so many faces, but at least so many levels, and their points.
struct Refined {
  std::vector<Level> levels;
  std::vector<Points> points;

  Refined(const Scheme<double>& scheme, const Mesh& cage, int at_least, Index faces) {
    levels.push_back(control_level(scheme, cage));
    points.push_back(cage.positions);
    while (static_cast<int>(levels.size()) <= at_least || levels.back().topology().num_faces() < faces) {
      levels.push_back(next_level(scheme, levels.back()));
      points.push_back(apply(levels.back().S, points.back()));
    }
  }
  /// The first level of so many faces.
  int level_of(Index faces) const {
    int k = 0;
    while (levels[k].topology().num_faces() < faces) ++k;
    return k;
  }
};

/// The vertices of a level, moved to the limit.
struct Limit {
  const Level& level;
  LimitMatrices matrices;
  LimitPoints points;

  Limit(const Refined& refined, int k, LimitCache& cache)
      : level(refined.levels[k]),
        matrices(limit_matrices(level, cache)),
        points(limit_points(matrices, level.topology(), refined.points[k])) {}
  PictureMesh picture() const { return surface_picture(limit_mesh(level, matrices, points, Normals::per_corner)); }
};

void measure(Measured& m, const Cage& cage, const Limit& fine) {
  const Topology control(view(cage.mesh));
  const Points &corners = cage.mesh.positions, &x = fine.points.position;
  const Topology& t = fine.level.topology();
  m.level = fine.level.number;
  m.faces = t.num_faces();
  m.volume = volume(t, x) / volume(control, corners);
  const Distances to_cage = distances(t, x, SurfaceDistance(control, corners));
  m.mean_distance = to_cage.mean / diameter(corners);
  m.max_distance = to_cage.max / diameter(corners);
  const Eigen::VectorXd radii = x.rowwise().norm();
  m.roundness = radii.minCoeff() / radii.maxCoeff();
}

}  // namespace

Exhibit exhibit(const Cage& cage, LimitCache& cache, const ExhibitOptions& options) {
  const Refined refined(cache.scheme(), cage.mesh, options.levels, options.faces);
  Exhibit result;
  Measured& m = result.measured;
  m.scheme = cache.scheme().name;
  m.cage = cage.name;

  PictureMesh wire = wire_picture(refined.levels[0], refined.points[0]);
  wire.faces = false;
  wire.color = cage_wire;
  const auto panel = [&](PictureMesh mesh, const std::string& caption, const std::string& note) {
    mesh.color = cache.scheme().claims.interpolates ? interpolating : approximating;
    return Panel{{std::move(mesh), wire}, caption, note};
  };
  for (int k = 0; k <= options.levels; ++k) {
    const Topology& t = refined.levels[k].topology();
    result.panels.push_back(
        panel(wire_picture(refined.levels[k], refined.points[k]), "level " + std::to_string(k),
              std::to_string(t.num_vertices()) + " points, " + std::to_string(t.num_faces()) + " faces"));
  }
  for (const Index share : {16, 4, 1}) {
    const Limit limit(refined, refined.level_of(options.faces / share), cache);
    const Topology& t = limit.level.topology();
    m.bending.push_back({limit.level.number, t.num_faces(), bending_energy(t, limit.points.position)});
    if (share == 4) {
      m.symmetry_defect =
          symmetry_defect(t, limit.points.position, symmetries(cage.mesh.positions)) / diameter(cage.mesh.positions);
      result.small = panel(limit.picture(), m.scheme, "");
    }
    if (share > 1) continue;
    measure(m, cage, limit);
    result.panels.push_back(panel(limit.picture(), "limit", "of the points of level " + std::to_string(m.level)));
  }
  return result;
}

}  // namespace sublimit::gallery
