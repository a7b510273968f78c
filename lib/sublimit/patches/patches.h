// SPDX-License-Identifier: Apache-2.0
#pragma once
// Classical surfaces with their control points: Bezier patches, B-splines, NURBS, and surfaces made from curves.
//
//   const Patches patches = construct("sphere.json").surfaces();  // or Patches(PatchSet(...), points)
//   const LimitSamples samples = patches.evaluate({{.face = 0, .u = 0.5, .v = 0.5}}, 2);
//   const Patches next = patches.with(points_of_another_frame);
#include <initializer_list>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "sublimit/patches/patch_set.h"
#include "sublimit/source/place_stencils.h"

namespace sublimit {

struct ClosestPoints;
struct ClosestPointOptions;
struct Ray;
struct RayHits;
struct RayOptions;
struct Tessellation;
struct TessellationOptions;

/// Patches with their control points, which it owns. Faces are spans of knots, of one patch after the other; places
/// have u and v in [0, 1] from one knot to the next, and derivatives are by the patch's own parameters. It never
/// changes: threads may share it, and copies share all that it consists of.
class Patches : public BoundSource {
 public:
  /// Makes surfaces from patches and their control points.
  /// @param columns  #points x 3; for rational patches x 4, homogeneous: (w x, w y, w z, w)
  /// @throws InvalidParameter  columns of another size
  Patches(PatchSet set, Points columns);
  // Moving copies: a moved-from object stays valid.
  Patches(const Patches&) = default;
  Patches& operator=(const Patches&) = default;

  /// Returns the patches with other control points, as in another frame.
  /// @param columns  array of the same size as `points()`
  /// @throws InvalidParameter  columns of another size, or not finite
  Patches with(Points columns) const;

  const PatchSet& set() const;    ///< the patches without points
  const Points& points() const&;  ///< control points: #points x 3, or x 4 if they are rational
  Points points() && { return std::as_const(*this).points(); }  ///< a copy, from temporaries
  bool rational() const;                                        ///< points are homogeneous
  Index num_patches() const;
  Index first_face(Index patch) const;  ///< first face of a patch; for `num_patches()` the number of all faces
  FaceCount faces() const { return set().faces(); }
  /// Returns the places of a grid on every face: N x N, sides included, u fastest; on triangles N (N + 1) / 2.
  /// @throws InvalidParameter  N below 2
  /// @throws ResourceError     more places than memory holds
  std::vector<Place> grid(int N) const { return grid_places(faces(), N); }

  /// Evaluates places, in parallel.
  /// @param derivatives  0, 1 (du, dv, normals) or 2 (duu, duv, dvv too)
  /// @param normals      false: leave normals out
  /// @throws InvalidParameter  another number of derivatives
  /// @note  A place on no face, or outside of it, has the status `outside`; one where w = 0 `pole`.
  LimitSamples evaluate(std::span<const Place> places, int derivatives = 0, bool normals = true) const;
  /// Evaluates places that are listed: `evaluate({{.face = 0, .u = 0.5, .v = 0.5}}, 1)`.
  LimitSamples evaluate(std::initializer_list<Place> places, int derivatives = 0) const {
    return evaluate(std::span(places.begin(), places.size()), derivatives);
  }
  /// Evaluates places into `out`, whose memory is reused.
  void evaluate(std::span<const Place> places, int derivatives, bool normals, LimitSamples& out) const override;

  /// Returns the weights that control points are multiplied with, a row for each place; for rational patches they map
  /// homogeneous control points to homogeneous points.
  /// @throws InvalidParameter  a place on no face, parameters outside of it, another number of derivatives
  PlaceStencils stencils(std::span<const Place> places, int derivatives = 0) const {
    return place_stencils(set(), places, derivatives);
  }

  /// Returns nearest points; include search/closest_point.h, whose `closest` it calls.
  ClosestPoints closest(const Points& points) const;
  ClosestPoints closest(const Points& points, const ClosestPointOptions& options) const;
  /// Returns where rays meet the patches; include search/intersect.h, whose `intersect` it calls.
  RayHits intersect(const std::vector<Ray>& rays) const;
  RayHits intersect(const std::vector<Ray>& rays, const RayOptions& options) const;
  /// Returns triangles; include tessellation/tessellate.h, whose `tessellate` it calls.
  Tessellation tessellate(const TessellationOptions& options) const;

 private:
  struct Bound;
  std::shared_ptr<const Bound> bound_;
};

}  // namespace sublimit
