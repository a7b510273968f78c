// SPDX-License-Identifier: Apache-2.0
#pragma once
// What the program does with meshes, in C++: refine, limit, closest, intersect, tessellate, bake, fit, analyze and info
// are functions of the same names. Recipes, fields and STEP files have headers of their own (recipes/, implicit/,
// cad/).
//
// Meshes are of files or arrays. A scheme is a name, a name with options, or one of your own. Rules for boundaries,
// creases and triangles are those of the mesh:
//
//   Mesh mesh = read_mesh("cube.obj");  // or make_mesh(points, faces), of lists or of Eigen's matrices
//   mesh.boundary = Boundary::edge_only;
//   mesh.creases.push_back({.tail = 0, .head = 1, .sharpness = 2.5F});
//   write_mesh("fine.obj", refine(mesh, "catmull-clark", 3));
//   const Mesh fine = refine(mesh, {"kobbelt", {{"tension", "3/4"}}}, 2);
//   fine.positions.row(v), fine.face_sizes[f], fine.face_vertices, fine.face_varying[0].values;
//   const SparseMatrix P = subdivision_matrix(mesh, "loop", 3);  // P * mesh.positions: points of level 3
//
// `Points` is an Eigen matrix of doubles by rows, #points x 3; `SparseMatrix` one of Eigen's too. Texture coordinates
// are refined linearly unless `mesh.face_varying_interpolation` says otherwise. `limit`, `levels`, `fit` and `info` are
// functions: where a variable has the same name, write `sublimit::` before the call.
//
// The limit of vertices, and anywhere. A place is (face, u, v). Under schemes for triangles `face` is the number of the
// triangle. Under others it is that of the face if all faces are quadrilaterals; any other polygon counts as one square
// for each of its corners, as Ptex numbers them (limit/address.h):
//
//   const Limit limit = sublimit::limit(mesh, "catmull-clark");  // .points.row(v), .matrix
//   limit.normals.row(s), limit.side_vertex[s];  // a normal for each side of the sharp edges at a vertex
//   const LimitSurface surface(mesh, "catmull-clark");
//   const LimitSamples samples = surface.evaluate({{.face = 0, .u = 0.5, .v = 0.25}}, 2);
//   samples.position.row(0), samples.du.row(0), samples.duu.row(0), samples.normal.row(0);
//   samples.status[0];  // LimitStatus::outside: no such place, all numbers are 0
//   const std::optional<Curvature> bend = curvature(samples, 0);  // none at extraordinary vertices
//   bend->k1, bend->k2, bend->gauss, bend->mean;
//   const PlaceStencils rows = surface.stencils(surface.grid(3));  // .matrices[0] * mesh.positions
//   const LimitSurface next = surface.with(points_of_another_frame);
//
//   const ClosestPoints near = closest(surface, Points{{2, 0, 0}, {0, 1, 3}});
//   near.points.row(0), near.distances[0], near.places[0], near.normals.row(0);
//   const RayHits hits = intersect(surface, {{.origin = {0, 0, 9}, .direction = {0, 0, -1}}}, {.all = true});
//   hits.t.size(), hits.points.row(0);
//   const Tessellation flat = tessellate(surface, {.chord = 1e-3});
//   flat.points.row(flat.triangles[t].vertices[0]);
//   const Points normals = surface.evaluate(flat.places, 1).normal;
//
// Tables, once a connectivity, and applied every frame (table.h, which needs the component eval alone):
//
//   bake(mesh, "catmull-clark", {.levels = 3}).save("cube.safetensors");
//   const Table table = load("cube.safetensors");
//   std::vector<float> result(table.num_results(3));
//   table.apply(points, 3, result);  // by all threads
//   const TableFrame<float> frame(table, points, 3, result);  // by threads of your own:
//   frame.apply_part(i, n);                                   // any thread, for i = 0 ... n - 1
//   frame.finish();                                           // after all of them
//
// A scheme of your own is a function of the number type: masks of vertices, edges and faces as expressions of the
// points around them (scheme/sites.h), in double here, in exact numbers for its report:
//
//   #include <sublimit/certificates/algebraic.h>
//   template <class T>
//   Scheme<T> mine() {
//     const auto vertex = [](const Ring<T>& v) { return (v.center() + v.neighbor_mean()) / 2; };
//     const auto edge = [](const EdgeSite<T>& e) { return (e.tail() + e.head()) / 2; };
//     const auto face = [](const FaceSite<T>& f) { return f.centroid(); };
//     return {.name = "mine",
//             .source = "here",
//             .steps = {Step<T>{Split::pqq, {.vertex = vertex, .edge = edge, .face = face}}},
//             .creases = cubic_bspline_creases<T>()};
//   }
//   refine(mesh, mine<double>(), 2);
//   analyze(mine<double>(), mine<Algebraic>()).save_html("mine.html");
//
// Data and reports (report/report.h, if the component report is there):
//
//   const Fit fit = sublimit::fit(mesh, "loop", {{.vertex = 0, .position = {0, 0, 1}}});
//   fit.mesh, fit.solved, fit.why_not;
//   analyze("loop", {.valences = {3, 5}}).save_html("loop.html");
//   const MeshInfo known = info(mesh, "loop");  // counts, valences, .why_not
//
// Functions throw `Error`s (base/error.h): each has a code, and says what is wrong, where, and what would be right.
// They use all threads of oneTBB. Everything is a value. Surfaces, tables and schemes never change: copies are cheap,
// and any number of threads may use one.
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "sublimit/base/error.h"
#include "sublimit/fit/cloud_fit.h"
#include "sublimit/fit/scattered_fit.h"
#include "sublimit/io/read_mesh.h"
#include "sublimit/io/write_mesh.h"
#include "sublimit/jobs/mesh_info.h"
#include "sublimit/limit/limit.h"
#include "sublimit/limit/limit_surface.h"
#include "sublimit/mesh/make_mesh.h"
#include "sublimit/scheme/refined_mesh.h"
#include "sublimit/schemes/cubic_bspline_creases.h"
#include "sublimit/search/closest_point.h"
#include "sublimit/search/intersect.h"
#include "sublimit/table.h"
#include "sublimit/tessellation/tessellate.h"
#if __has_include("sublimit/report/report.h")  // the component report is linked
#include "sublimit/report/report.h"
#endif

namespace sublimit {

/// A control mesh: `positions`, `face_sizes`, `face_vertices`, and what may be absent: `creases`, `corners`, `holes`,
/// rules, texture coordinates (`face_varying`), names of faces. `make_mesh` makes one of arrays, `read_mesh` of a file.
using Mesh = ControlMesh;

/// Writes .obj or .ply, with all tags that the format has room for.
/// @throws InvalidOption  another extension;  InvalidMesh  coordinates that no reader would take back
/// @throws IoError        unwritable;  ResourceError  a full disk
inline void write_mesh(const std::filesystem::path& path, const Mesh& mesh) { write_mesh(path, output(mesh)); }

/// Returns level `levels` of a mesh, with its texture coordinates, and with the creases, corners and holes that are
/// left after so many levels: refining the result continues the refinement.
/// @param progress  called before each level with its number, if given
/// @throws InvalidParameter                  negative levels
/// @throws InvalidMesh, UnsupportedTopology  a mesh that the scheme cannot refine, coordinates that are not finite:
/// says
///                                           where
/// @throws ResourceError                     more memory than there is, predicted before it is taken
/// @note  Texture coordinates that the scheme cannot refine are left out: `warnings` of the result says why.
[[nodiscard]] Mesh refine(const Mesh& mesh, const AnyScheme& scheme, int levels,
                          const std::function<void(int)>& progress = {});

/// Returns levels 0 to `levels`: of each its connectivity, and the matrix `S` that makes its points from those of the
/// level before (empty for level 0).
/// @throws as `refine`
[[nodiscard]] std::vector<Level> levels(const Mesh& mesh, const AnyScheme& scheme, int levels);

/// Returns the matrix that makes the points of level `levels` from the control points, #points x #control points.
/// @throws as `refine`
[[nodiscard]] SparseMatrix subdivision_matrix(const Mesh& mesh, const AnyScheme& scheme, int levels);

/// Returns counts, valences, rules in force and warnings of a mesh.
[[nodiscard]] MeshInfo info(const Mesh& mesh);
/// Returns the same, and whether a scheme can refine the mesh: if not, `why_not` says why.
[[nodiscard]] MeshInfo info(const Mesh& mesh, const AnyScheme& scheme);

/// What points a table makes: one of levels, grid and places.
struct BakeOptions {
  std::optional<int> levels = {};   ///< points of this level, 1 to 11; 0 to 11 if `limit` is set
  bool limit = false;               ///< the limits of these points instead
  std::optional<int> grid = {};     ///< N x N places on each face, sides included, N from 2 to 2048
  std::vector<Sample> places = {};  ///< places on the limit
  std::vector<Index> face_sizes = {}, face_vertices = {};  ///< faces between the places, as triangles of `tessellate`
  int derivatives = 0;                                     ///< of the limit: 0, 1 or 2
  bool in_double = false;                                  ///< weights of 64 bits; else of 32
};

/// Bakes a table: weights over the control points, made once for a connectivity and its tags.
/// @throws InvalidParameter                  none of levels, grid and places, or several; numbers outside their range
/// @throws InvalidMesh, UnsupportedTopology  a mesh that the scheme cannot refine: says where
/// @throws ResourceError                     more memory than there is, predicted before it is taken
/// @note  Points of levels have an order of the table's own, not that of `refine`: `Table::faces` has the faces between
///        them. Those of grids stand face by face, u fastest; places as they are given.
[[nodiscard]] Table bake(const Mesh& mesh, const AnyScheme& scheme, const BakeOptions& options);

struct FitOptions {
  Fairness fairness =
      {};  ///< decides what the targets leave free; none: the mesh stays as near to the given one as it can
  /// Refinements, each of which adds control points: as few as meet the targets.
  int least_refinements = 0, most_refinements = 2;
};

/// A mesh whose limit meets targets at vertices.
struct [[nodiscard]] Fit {
  Mesh mesh;
  bool solved = false;             ///< all targets are met to rounding
  std::string why_not;             ///< which are not, in words
  int refinements = 0;             ///< of the given mesh
  Eigen::VectorXd position_error;  ///< distance, by target
  Eigen::VectorXd normal_error;    ///< radians, by target; not a number where no normal was asked for
};

/// Finds a mesh whose limit has given vertices at given points, with given normals.
/// @throws InvalidParameter                  a vertex that does not exist, or with two targets; numbers that are not
///                                           finite
/// @throws InvalidMesh, UnsupportedTopology  a mesh that the scheme cannot refine: says where
[[nodiscard]] Fit fit(const Mesh& mesh, const AnyScheme& scheme, const std::vector<VertexTarget>& targets,
                      const FitOptions& options = {});

/// Finds control points whose limit comes near to given points at given places, by least squares.
/// @throws InvalidParameter  a place on no face, numbers that are not finite: says which
inline ScatteredFit fit_places(const LimitSurface& surface, const PlaceTargets& targets,
                               const ScatteredFitOptions& options = {}) {
  return fit_places(surface.map(), targets, surface.points(), options);
}

/// Finds control points whose limit is near to points without order.
/// @throws InvalidParameter  no points, numbers that are not finite
inline CloudFit fit_cloud(const LimitSurface& surface, const Cloud& cloud, const CloudFitOptions& options = {}) {
  return fit_cloud(surface.map(), cloud, surface.points(), options);
}

}  // namespace sublimit
