// SPDX-License-Identifier: Apache-2.0
#pragma once
// The limit surface of a mesh: points, derivatives, normals and stencils anywhere.
//
//   const LimitSurface surface(read_mesh("torus.obj"), "catmull-clark");
//   const LimitSamples samples = surface.evaluate({{.face = 7, .u = 0.25, .v = 0.5}}, 2);
//   const std::optional<Curvature> bend = curvature(samples, 0);
#include <initializer_list>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "sublimit/scheme/any_scheme.h"
#include "sublimit/source/curvature.h"
#include "sublimit/source/place_stencils.h"
#include "sublimit/surface/limit_map.h"

namespace sublimit {

struct ClosestPoints;
struct ClosestPointOptions;
struct Ray;
struct RayHits;
struct RayOptions;
struct Tessellation;
struct TessellationOptions;

/// A limit surface with its control points, which it owns. It never changes: threads may share it, and copies share all
/// that it consists of.
class LimitSurface : public BoundSource {
 public:
  /// Makes the limit of a mesh under a scheme, by the mesh's rules for boundaries, creases and triangles.
  /// @param cache  shared between surfaces of the same scheme, if given, so that each type of neighbourhood is computed
  ///               once (`limit_cache`)
  /// @throws InvalidMesh, UnsupportedTopology  a mesh that the scheme cannot refine, coordinates that are not finite:
  ///                                           says where
  /// @throws InvalidParameter                  a cache of another scheme
  LimitSurface(const Mesh& mesh, const AnyScheme& scheme, std::shared_ptr<LimitCache> cache = nullptr);
  /// Makes a surface from its map and control points.
  /// @param points  #V x 3
  /// @throws InvalidParameter  another number of rows or columns
  LimitSurface(const LimitMap& map, Points points);
  // Moving copies: a moved-from object stays valid.
  LimitSurface(const LimitSurface&) = default;
  LimitSurface& operator=(const LimitSurface&) = default;

  /// Returns the surface with other control points, as in another frame. All that depends on connectivity is shared.
  /// @param points  #V x 3
  /// @throws InvalidParameter  another number of rows or columns
  /// @throws InvalidMesh       a coordinate that is not finite: says of which control point
  LimitSurface with(Points points) const;

  const LimitMap& map() const;                                  ///< the surface without points
  const Points& points() const&;                                ///< control points, #V x 3
  Points points() && { return std::as_const(*this).points(); }  ///< a copy, from temporaries
  FaceCount faces() const { return map().faces(); }             ///< faces that places may be on
  /// Returns the places of a grid on every face: N x N, sides included, u fastest; on triangles N (N + 1) / 2.
  /// @throws InvalidParameter  N below 2
  /// @throws ResourceError     more places than memory holds
  std::vector<Place> grid(int N) const { return grid_places(faces(), N); }

  /// Evaluates places, in parallel.
  /// @param derivatives  0, 1 (du, dv, normals) or 2 (duu, duv, dvv too)
  /// @param normals      false: leave normals out
  /// @throws InvalidParameter  another number of derivatives
  /// @note  A place on no face, or outside of it, has the status `outside`.
  LimitSamples evaluate(std::span<const Place> places, int derivatives = 0, bool normals = true) const;
  /// Evaluates places that are listed: `evaluate({{.face = 0, .u = 0.5, .v = 0.5}}, 1)`.
  LimitSamples evaluate(std::initializer_list<Place> places, int derivatives = 0) const {
    return evaluate(std::span(places.begin(), places.size()), derivatives);
  }
  /// Evaluates places into `out`, whose memory is reused.
  void evaluate(std::span<const Place> places, int derivatives, bool normals, LimitSamples& out) const override;

  /// Returns the weights that `evaluate` multiplies the control points with, a row for each place.
  /// @throws InvalidParameter  a place on no face, parameters outside of it, another number of derivatives
  /// @throws ResourceError     more weights than 32-bit indices count
  PlaceStencils stencils(std::span<const Place> places, int derivatives = 0) const {
    return place_stencils(map(), places, derivatives);
  }
  /// Returns the stencils of places that are listed.
  PlaceStencils stencils(std::initializer_list<Place> places, int derivatives = 0) const {
    return stencils(std::span(places.begin(), places.size()), derivatives);
  }

  /// Returns how the limit at a place comes about: pieces, blocks, polynomial or eigenvector, weights.
  /// @throws InvalidParameter  a place on no face, parameters outside of it
  LimitPath explain(const Place& place) const { return map().explain(place); }

  /// Returns nearest points; include search/closest_point.h, whose `closest` it calls.
  ClosestPoints closest(const Points& points) const;
  ClosestPoints closest(const Points& points, const ClosestPointOptions& options) const;
  /// Returns where rays meet the surface; include search/intersect.h, whose `intersect` it calls.
  RayHits intersect(const std::vector<Ray>& rays) const;
  RayHits intersect(const std::vector<Ray>& rays, const RayOptions& options) const;
  /// Returns triangles near the surface; include tessellation/tessellate.h, whose `tessellate` it calls.
  Tessellation tessellate(const TessellationOptions& options) const;

 private:
  struct Bound;
  std::shared_ptr<const Bound> bound_;
};

}  // namespace sublimit
