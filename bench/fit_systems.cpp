// SPDX-License-Identifier: Apache-2.0
#include "fit_systems.h"

#include <cmath>
#include <random>

#include "meshes/meshes.h"
#include "sublimit/core/detail/sparse_product.h"
#include "sublimit/fit/scattered_fit.h"
#include "sublimit/limit/detail/limit_points.h"
#include "sublimit/schemes/schemes.h"
#include "sublimit/surface/limit_map.h"

namespace sublimit::bench {
namespace {

Mesh torus(Index vertices) {
  const Index side = Index(std::lround(std::sqrt(double(vertices))));
  return testing::jittered(testing::torus(side, side + 1), 0.001);
}

FitProblem points(Index vertices) {
  const Mesh mesh = torus(vertices);
  LimitCache cache(find_scheme<double>("catmull-clark").value());
  FitProblem p;
  p.C = limit_matrices(refine(cache.scheme(), mesh, 0)[0], cache).position;
  p.d = p.x0 = mesh.positions;
  return p;
}

FitProblem normals(Index vertices) {
  const Mesh mesh = torus(vertices / 4);
  const Index targets = Index(mesh.positions.rows());
  LimitCache cache(find_scheme<double>("catmull-clark").value());
  const auto levels = refine(cache.scheme(), mesh, 1);
  const LimitMatrices limit = limit_matrices(levels[1], cache);
  const Points refined = apply(refinement_matrix(levels), mesh.positions);
  const Points normal = limit_points(limit, levels[1].topology(), refined).normal;
  FitProblem p;
  p.x0 = Points(refined.size(), 1);
  for (Eigen::Index i = 0; i < refined.size(); ++i) p.x0(i, 0) = refined.data()[i];
  std::vector<Eigen::Triplet<double>> entries;
  for (Index v = 0; v < targets; ++v) {  // the first vertices of level 1 are those of level 0; a side each
    for (SparseMatrix::InnerIterator e(limit.position, v); e; ++e)
      for (Index k = 0; k < 3; ++k) entries.emplace_back(5 * v + k, 3 * Index(e.col()) + k, e.value());
    for (const Index t : {3, 4})
      for (SparseMatrix::InnerIterator e(t == 3 ? limit.tangent1 : limit.tangent2, v); e; ++e)
        for (Index k = 0; k < 3; ++k) entries.emplace_back(5 * v + t, 3 * Index(e.col()) + k, e.value() * normal(v, k));
  }
  p.C = SparseMatrix(5 * targets, Eigen::Index(refined.size()));
  p.C.setFromTriplets(entries.begin(), entries.end());
  p.d = Points::Zero(5 * targets, 1);
  for (Index v = 0; v < targets; ++v)
    for (Index k = 0; k < 3; ++k) p.d(5 * v + k, 0) = mesh.positions(v, k);
  return p;
}

FitProblem fairness(Index vertices) {
  const Mesh mesh = torus(vertices / 4);
  LimitCache cache(find_scheme<double>("catmull-clark").value());
  const auto levels = refine(cache.scheme(), mesh, 1);
  FitProblem p;
  p.C = limit_matrices(levels[1], cache).position.topRows(mesh.positions.rows());
  p.d = mesh.positions;
  p.x0 = apply(refinement_matrix(levels), mesh.positions);
  p.H = fairness_energy(LimitMap(cache.scheme(), levels[1]), {.thin_plate = 1});
  return p;
}

FitProblem places(Index vertices) {
  const Mesh mesh = torus(vertices);
  const LimitMap surface(find_scheme<double>("catmull-clark").value(), mesh);
  std::mt19937 generator(1);
  const auto random = [&] { return double(generator() >> 5) / double(1 << 27); };
  std::vector<Place> list(4 * mesh.positions.rows());
  for (Place& s : list) s = {Index(generator() % unsigned(surface.addresses().size())), random(), random()};
  FitProblem p;
  p.A = place_rows(surface, list);
  p.b = apply(p.A, mesh.positions);
  p.x0 = Points::Zero(mesh.positions.rows(), 3);
  return p;
}

}  // namespace

std::vector<FitSystem> fit_systems(Index vertices) {
  return {{"points", "square, limit points of all control points", [=] { return points(vertices); }},
          {"normals", "points and normals, one split, least change", [=] { return normals(vertices); }},
          {"fairness", "points, one split, thin plate", [=] { return fairness(vertices); }},
          {"places", "least squares at random places", [=] { return places(vertices); }}};
}

}  // namespace sublimit::bench
