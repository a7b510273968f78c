// SPDX-License-Identifier: Apache-2.0
#pragma once
// The library in one header, in namespace sublimit. What the program does with meshes are functions of the same names:
// refine, limit, closest, intersect, tessellate, bake, fit, info, construct; analyze, implicit and step too, if
// sublimit::report, sublimit::implicit_mesh and sublimit::cad are linked (by CMake; pkg-config sublimit has report).
// Everything is a value; functions may be called by any thread.
//
// Meshes come from files or arrays. A scheme is given by its name, by name and options, or as one of your own. The mesh
// has tags (creases, corners, holes) and rules for boundaries, creases and triangles:
//
//   Mesh mesh = read_mesh("cube.obj");
//   Mesh made = make_mesh(points, faces);  // lists of points and faces, or Eigen matrices #V x 3 and #F x n
//   made = make_mesh(std::span(floats), 3, std::span(indices), 4);  // flat arrays: stride 3, quadrilaterals
//   mesh.boundary = Boundary::edge_only;
//   mesh.creases.push_back({.tail = 0, .head = 1, .sharpness = 2.5F});
//   mesh = mesh.with_points(points_of_another_frame);  // Points: an Eigen matrix of doubles by rows, #V x 3
//   for (const SchemeInfo& scheme : schemes()) std::cout << scheme.name << ": " << scheme.limit << "\n";
//
// Refinement. Texture coordinates are refined linearly unless `mesh.face_varying_interpolation` says otherwise.
// `refine`, `limit`, `levels`, `fit` and `info` are functions: where a variable has such a name, write `sublimit::`
// before a call.
//
//   write_mesh("fine.obj", refine(mesh, "catmull-clark", 3));
//   const Mesh fine = refine(mesh, {"kobbelt", {{"tension", "3/4"}}}, 2);
//   fine.positions.row(v), fine.face_sizes[f], fine.face_vertices, fine.face_varying[0].values;
//   const SparseMatrix P = subdivision_matrix(mesh, "loop", 3);  // P * mesh.positions: points of level 3
//
// The limit of all vertices, with a normal for each side of the sharp edges at a vertex. A cache shared by calls with
// the same scheme saves time:
//
//   const Limit limit = sublimit::limit(mesh, "catmull-clark");
//   limit.points.row(v), limit.matrix, limit.normals.row(side), limit.side_vertex[side];
//   const auto cache = limit_cache("catmull-clark");
//   const Limit cached = sublimit::limit(mesh, "catmull-clark", {.levels = 2, .cache = cache});
//
// The limit at any place: points, derivatives, normals, curvature, stencils. A place is (face, u, v), with u and v from
// 0 to 1. Under schemes for triangles the face is a triangle of the mesh, and u + v at most 1. Under others it is a
// face of the mesh if all are quadrilaterals; any other polygon counts as one square for each corner, as Ptex does
// (source/address.h):
//
//   const LimitSurface surface(mesh, "catmull-clark");
//   const LimitSamples samples = surface.evaluate({{.face = 0, .u = 0.5, .v = 0.25}}, 2);
//   samples.position.row(0), samples.du.row(0), samples.duu.row(0), samples.normal.row(0);
//   samples.status[0];  // LimitStatus::outside: no such place; all numbers are 0, and nothing is thrown
//   const std::optional<Curvature> bend = curvature(samples, 0);  // absent at extraordinary vertices
//   bend->k1, bend->k2, bend->gauss, bend->mean;
//   const PlaceStencils rows = surface.stencils(surface.grid(3));  // .matrices[0] * mesh.positions
//   const LimitSurface next = surface.with(points_of_another_frame);
//
// Nearest points, rays, and triangles near the limit. `closest`, `intersect` and `tessellate` are members of a surface
// and functions:
//
//   const ClosestPoints near = surface.closest(Points{{2, 0, 0}, {0, 1, 3}});
//   near.points.row(0), near.distances[0], near.places[0], near.normals.row(0);
//   const RayHits hits = surface.intersect({{.origin = {0, 0, 9}, .direction = {0, 0, -1}}}, {.all = true});
//   hits.t.size(), hits.points.row(0);
//   write_mesh("triangles.obj", tessellate(mesh, "catmull-clark", {.chord = 1e-3, .normals = true}));  // .face_normals
//   const Tessellation flat = surface.tessellate({.chord = 1e-3});
//   flat.points.row(flat.triangles[t].vertices[0]), flat.places;
//
// Scenes of USD: each subdivision mesh becomes triangles with exact normals, all else stays as it is:
//
//   const FlattenedScene flat_scene = flatten("scene.usda", "flat.usda", {.relative_chord = 1e-3});
//   flat_scene.meshes[0].triangles, flat_scene.meshes[0].bound, flat_scene.warnings;
//
// Tables: baked once for a connectivity, applied every frame. eval/table.h needs the component eval alone:
//
//   bake(mesh, "catmull-clark", {.levels = 3}).save("cube.safetensors");
//   const Table table = load("cube.safetensors");
//   std::vector<float> result(table.num_results(3));
//   table.apply(frame, 3, result);  // frame: std::vector<float>; on all threads
//   const TableFrame<float> parts(table, frame, 3, result);  // on threads of your own:
//   parts.apply_part(i, n);                                  // any thread, for i = 0 ... n - 1
//   parts.finish();                                          // one thread, after all of them
//
// Fits: meshes whose limit meets points at vertices, or is near to points at places or without order:
//
//   const Fit fitted = fit(mesh, "loop", {{.vertex = 0, .position = {0, 0, 1}}});
//   fitted.mesh, fitted.solved, fitted.why_not;
//   const ScatteredFit near_places = fit_places(surface, {.places = places, .values = goals});  // goals: Points
//   const CloudFit near_cloud = fit_cloud(surface, {.points = scan});  // scan: Points
//   write_mesh("fitted.obj", mesh.with_points(near_cloud.points));
//
// Classical curves and surfaces from recipes, control meshes of implicit surfaces, and files for CAD:
//
//   const Construction cone = construct("cone.json");  // .surfaces(), .curves(), .write("cone.obj")
//   cone.surfaces().evaluate({{.face = 0, .u = 0.5, .v = 0.5}}, 1);
//   const ImplicitMesh torus = implicit("torus.json", "catmull-clark", {.tolerance = 1e-3});
//   torus.mesh, torus.met, torus.largest_distance;
//   const StepFile written = step(surface, "surface.step");  // or of cone.surfaces()
//   written.met, written.solids, written.deviation;
//
// Information, and reports on smoothness (report/report.h):
//
//   const MeshInfo facts = info(mesh, "loop");  // .vertices, .interior_valences, .warnings, .why_not
//   analyze("loop", {.valences = {3, 5}}).save_html("loop.html");
//   analyze(mesh, "catmull-clark").save_html("mesh.html");
//   std::puts(version());
//
// A scheme of your own is a function of the number type. Its masks of vertices, edges and faces are expressions of the
// points around them (scheme/sites.h); `double` makes meshes, exact numbers make the report:
//
//   #include <sublimit/certificates/numbers/algebraic.h>
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
// Functions throw `Error`s (base/error.h): each has a code, and a message that says what is wrong, where, and what
// would be right. Functions use all threads of oneTBB. Surfaces, tables, schemes and constructions never change: copies
// are cheap, and any number of threads may share one. Meshes and results are plain data.
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "sublimit/base/error.h"
#include "sublimit/base/version.h"
#include "sublimit/curves/limit_curve.h"
#include "sublimit/eval/table.h"
#include "sublimit/fit/cloud_fit.h"
#include "sublimit/fit/scattered_fit.h"
#include "sublimit/io/read_mesh.h"
#include "sublimit/io/write_mesh.h"
#include "sublimit/limit/limit.h"
#include "sublimit/mesh/make_mesh.h"
#include "sublimit/scheme/cubic_bspline_creases.h"
#include "sublimit/scheme/refined_mesh.h"
#include "sublimit/scheme/scheme_info.h"
#include "sublimit/search/closest_point.h"
#include "sublimit/search/intersect.h"
#include "sublimit/stencils/bake/editable_table.h"
#include "sublimit/stencils/jobs/mesh_info.h"
#include "sublimit/stencils/recipes/construct.h"
#include "sublimit/stencils/recipes/implicit.h"
#include "sublimit/surface/limit_surface.h"
#include "sublimit/tessellation/tessellate.h"
// Headers of components, included if the component is linked:
#if __has_include("sublimit/report/report.h")
#include "sublimit/report/report.h"
#endif
#if __has_include("sublimit/cad/step.h")
#include "sublimit/cad/step.h"
#endif

namespace sublimit {

/// Returns level `levels` of a mesh, with its texture coordinates, and with the creases, corners and holes that are
/// left on that level: refining the result continues the refinement.
/// @param levels    0 or more
/// @param progress  called before each level with its number, if given
/// @throws InvalidParameter                  negative levels
/// @throws InvalidMesh, UnsupportedTopology  the scheme cannot refine the mesh, coordinates are not finite; the message
///                                           says where
/// @throws ResourceError                     not enough memory, predicted before it is taken
/// @note  All channels of `Mesh::face_varying` are refined. `warnings` of the result says what keeps the mesh from
///        being a manifold, and why channels that the scheme cannot refine are left out.
[[nodiscard]] Mesh refine(const Mesh& mesh, const AnyScheme& scheme, int levels,
                          const std::function<void(int)>& progress = {});

/// Returns levels 0 to `levels`, each with its connectivity and the matrix `S` that makes its points from those of the
/// previous level (empty for level 0).
/// @throws as `refine`
[[nodiscard]] std::vector<Level> levels(const Mesh& mesh, const AnyScheme& scheme, int levels);

/// Returns the matrix that makes the points of level `levels` from the control points: #points x #control points.
/// @throws as `refine`
[[nodiscard]] SparseMatrix subdivision_matrix(const Mesh& mesh, const AnyScheme& scheme, int levels);

/// Returns counts, valences, rules in force and warnings of a mesh.
[[nodiscard]] MeshInfo info(const Mesh& mesh);
/// Options of `info`.
struct InfoOptions {
  bool limit = false;  ///< compute area, volume and other integrals of the limit too, which takes time
};
/// Returns counts, valences, rules and warnings of a mesh, and in `why_not` why a scheme cannot refine it, if so.
/// @throws as `LimitSurface`  if `options.limit`
[[nodiscard]] MeshInfo info(const Mesh& mesh, const AnyScheme& scheme, const InfoOptions& options = {});

/// Points that a table makes. Set one of levels, grid and at.
struct BakeOptions {
  std::optional<int> levels = {};  ///< vertices of this level, 1 to 11; 0 to 11 if `limit` is set
  bool limit = false;              ///< with `levels`: limits of the vertices instead of their positions on the level
  std::optional<int> grid = {};    ///< N x N places on each face, sides included, N from 2 to 2048
  std::vector<Place> at = {};      ///< places on the limit, for example those of a `Tessellation`
  /// With `at`: faces between them, as the number of corners of each face, and the places at all corners, face by
  /// face. Optional: `Table::faces` returns them.
  std::vector<Index> face_sizes = {}, face_vertices = {};
  int derivatives = 0;     ///< order of derivatives of the limit: 0, 1 (du, dv) or 2 (duu, duv, dvv too)
  bool in_double = false;  ///< true: weights in double; false: in float, half the memory
  bool order = false;      ///< with levels: keep which vertex of `refine` each point is, `Table::refined_points`
};

/// Bakes a table: weights over the control points for a connectivity and its tags. Positions do not matter.
/// @throws InvalidParameter                  none of levels, grid and at, or several; numbers outside their range
/// @throws InvalidMesh, UnsupportedTopology  the scheme cannot refine the mesh; the message says where
/// @throws ResourceError                     not enough memory, predicted before it is taken
/// @note  Points of levels are in an order of the table, not in that of `refine`; `Table::faces` has the faces between
///        them, and `Table::refined_points` the point of each vertex of `refine` if `order` is set. Points of grids are
///        ordered face by face, u fastest; places keep their order.
[[nodiscard]] Table bake(const Mesh& mesh, const AnyScheme& scheme, const BakeOptions& options);

/// Bakes a table of classical patches. Level k consists of the control nets after halving every knot span k times.
/// @throws InvalidParameter     none of levels, grid and at, or several; `limit`, which patches do not have
/// @throws UnsupportedTopology  levels of patches that have no nets
/// @throws ResourceError        not enough memory, predicted before it is taken
/// @note  A table of rational patches takes points (w x, w y, w z, w); see `Table::apply`.
[[nodiscard]] Table bake(const Patches& patches, const BakeOptions& options);

/// Returns triangles near the limit as a mesh, with the texture coordinates of the mesh and, if `options.normals`, a
/// normal at each corner. `face_ids` of the result are the faces of the mesh that the triangles lie on; `warnings` says
/// why texture coordinates that the scheme cannot refine are left out.
/// @throws as `LimitSurface` and `tessellate` of a surface
[[nodiscard]] Mesh tessellate(const Mesh& mesh, const AnyScheme& scheme, const TessellationOptions& options);

/// Options of `flatten`.
struct FlattenOptions {
  /// Largest distance of triangles from the limit, in the unit of the scene; 0: the part of a mesh's diagonal below.
  double chord = 0;
  double relative_chord = 1e-3;                        ///< a part of the diagonal of each mesh's box
  double angle = 0;                                    ///< as in `TessellationOptions`
  std::int64_t max_triangles = std::int64_t{1} << 24;  ///< of each mesh
};

/// What `flatten` made of a scene.
struct [[nodiscard]] FlattenedScene {
  struct FlatMesh {
    std::string path;            ///< of the prim
    std::int64_t triangles = 0;  ///< 0 if it is left as it is
    double bound = 0;            ///< proved bound of the distance from the limit, in the space of the prim
    std::string why_not;         ///< why it is left as it is; empty if it is flattened
  };
  std::vector<FlatMesh> meshes;       ///< the meshes of the scene with a scheme, in its order
  std::vector<std::string> warnings;  ///< what is missing or left out, each with its place
};

/// Makes triangles near the limit of each subdivision mesh of a USD scene, with exact normals, and writes the scene
/// with them: as USD all else stays byte for byte, and points that move in time move on; as glTF or another format of
/// meshes all meshes of the scene, at the first time, in the space of the world.
/// @param scene  `.usda` or `.usdz`
/// @param path   `.usda`, `.usdz`, `.glb` or another format of meshes
/// @throws InvalidParameter           a negative chord or angle
/// @throws InvalidMesh, FormatError   a mesh or layer that cannot be read
/// @throws ResourceError              more triangles than allowed; IoError  unreadable, unwritable
/// @note  The bound holds for the first time: the same places of the limit are taken at all others.
FlattenedScene flatten(const std::filesystem::path& scene, const std::filesystem::path& path,
                       const FlattenOptions& options = {},
                       const std::function<void(const std::string&)>& progress = {});

/// Options of `fit`.
struct FitOptions {
  /// Energy to minimise among meshes that meet the targets. Default, all weights 0: the mesh stays near the given one.
  Fairness fairness = {};
  /// Range of the number of refinements before the fit, each of which adds control points. The least number that meets
  /// all targets is taken.
  int least_refinements = 0, most_refinements = 2;
};

/// A mesh whose limit meets targets at vertices.
struct [[nodiscard]] Fit {
  Mesh mesh;                       ///< the fitted mesh
  bool solved = false;             ///< true if all targets are met to rounding
  std::string why_not;             ///< which targets are not met, in words; empty if solved
  int refinements = 0;             ///< refinements of the given mesh
  Eigen::VectorXd position_error;  ///< distance of each target from the limit
  Eigen::VectorXd normal_error;    ///< angle to the normal of each target, in radians; NaN where none was given
};

/// Computes a mesh whose limit has given positions and normals at given vertices.
/// @throws InvalidParameter                  no targets; a vertex that does not exist, or with two targets; a target
///                                           with a curvature; numbers that are not finite
/// @throws InvalidMesh, UnsupportedTopology  the scheme cannot refine the mesh; the message says where
[[nodiscard]] Fit fit(const Mesh& mesh, const AnyScheme& scheme, const std::vector<VertexTarget>& targets,
                      const FitOptions& options = {});

/// Computes control points whose limit is as near as possible to given points at given places, by least squares.
/// @throws InvalidParameter  no targets, a place on no face, numbers that are not finite; the message says which
inline ScatteredFit fit_places(const LimitSurface& surface, const PlaceTargets& targets,
                               const ScatteredFitOptions& options = {}) {
  if (targets.places.empty()) throw InvalidParameter("no targets; one is needed at least");
  return fit_places(surface.map(), targets, surface.points(), options);
}

/// Computes control points whose limit is near to a cloud of points, by repeated projection and least squares.
/// @throws InvalidParameter  no points, numbers that are not finite
inline CloudFit fit_cloud(const LimitSurface& surface, const Cloud& cloud, const CloudFitOptions& options = {}) {
  return fit_cloud(surface.map(), cloud, surface.points(), options);
}

}  // namespace sublimit
