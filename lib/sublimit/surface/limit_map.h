// SPDX-License-Identifier: Apache-2.0
#pragma once
// The map from control points to the limit surface: what LimitSurface does, for points that are given with each call.
//
//   const LimitMap map(*AnyScheme("loop"), mesh);
//   const LimitSamples samples = map.evaluate(mesh.positions, map.grid(5), 1);
//   const LimitStencil weights = map.stencil({.face = 0, .u = 0.25, .v = 0.25});
//   const LimitSurface surface(map, mesh.positions);
//
// A piece of the surface depends on the points around it alone. On a polynomial piece the basis is evaluated; elsewhere
// the place is followed through the children of the piece: x(f,u,v) = b T_m ... T_1 x_0, where T_i are blocks of S on
// the path, and b is the basis of a polynomial piece, or a limit mask. Pieces are computed once for each type of
// neighbourhood.
#include <Eigen/Geometry>

#include <complex>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "sublimit/scheme/refine.h"
#include "sublimit/source/linear_source.h"

namespace sublimit {

class LimitCache;
class LimitPatches;

/// The way to the limit at a place, from the face down to a polynomial or to a corner whose neighbourhood repeats
/// itself: for people who debug a scheme, and for teachers.
struct [[nodiscard]] LimitPath {
  /// A piece of a level, and which of its children has the place.
  struct Step {
    int level = 0;         ///< number of the level
    std::string piece;     ///< "quadrilateral", "triangle", "corner of a face" (dual schemes), "corner of a polygon"
    double u = 0, v = 0;   ///< the place in the piece
    Index num_points = 0;  ///< number of points of the level that the piece depends on
    int child = -1;        ///< number of the child that has the place; -1 for the last piece
    int times = 1;         ///< number of levels that the step goes down, if the child is like its parent
  };
  /// What gives the limit in the last piece.
  enum class End {
    polynomial,  ///< a polynomial of degree `degree`
    corner,      ///< an eigenvector of the neighbourhood of a corner, which repeats itself
  };
  std::vector<Step> steps;  ///< at least one
  End end = End::polynomial;
  int degree = 0;  ///< of the polynomial: in u and in v, or in both together if `is_total`
  bool is_total = false;
  /// Eigenvalues at the corner by descending modulus, of a matrix between all points that its piece depends on; empty
  /// for a polynomial, and if the matrix is too large.
  std::vector<std::complex<double>> spectrum;
  /// The vertex of the level that the place is, whose limit gives the position; -1: none.
  Index vertex = -1;
  std::string rule;      ///< of that vertex: "smooth", "dart", "crease" or "corner"
  LimitStencil stencil;  ///< the weights, as `stencil` returns them
};

/// The limit of a mesh without points: connectivity, tags and scheme. It never changes: threads may share it, and
/// copies share all that it consists of.
class LimitMap : public LinearSource {
 public:
  struct Parts;
  /// Makes the map of a mesh, whose positions are not used.
  /// @param types  cache shared between surfaces of the same scheme, if given (`limit_cache`)
  /// @throws InvalidMesh, UnsupportedTopology  a mesh that the scheme cannot refine: says where
  /// @throws InvalidParameter                  a cache of another scheme
  LimitMap(const Scheme<double>& scheme, const Mesh& mesh, const SubdivisionOptions& options = {},
           std::shared_ptr<LimitCache> types = nullptr);
  /// Makes the map from the points of a refined level.
  LimitMap(const Scheme<double>& scheme, Level level, std::shared_ptr<LimitCache> types = nullptr);
  // Moving copies: a moved-from object stays valid.
  LimitMap(const LimitMap&) = default;
  LimitMap& operator=(const LimitMap&) = default;

  /// Returns the numbers of the faces that places are on.
  const Addresses& addresses() const;
  /// Returns the level whose points are the control points.
  const Level& level() const;

  /// Computes all pieces now, in parallel, instead of each at its first use.
  void prepare() const;
  /// Returns what the map consists of, for the rooms that divide the surface in other ways; not installed
  /// (surface/detail/limit_map_parts.h).
  const Parts& parts() const& { return *parts_; }
  const Parts& parts() const&& = delete;

  Index num_points() const override;
  FaceCount faces() const override { return addresses(); }
  FaceLengths lengths(Index address) const override;
  LimitStencil stencil(const Place& place, int order = 0) const override;
  /// Returns how the stencil of a place comes about.
  /// @throws as `stencil`
  LimitPath explain(const Place& place, int order = 0) const;
  /// Returns points of the surface with derivatives and normals; in parallel.
  /// @param points   control points, #V x 3
  /// @param normals  compute normals too, if order >= 1
  LimitSamples evaluate(const Points& points, std::span<const Place> places, int order = 0,
                        bool normals = true) const override;
  std::unique_ptr<BoundSource> bound(const Points& points) const& override;

  /// Evaluates the places of `grid(N)`: N x N on every square, sides included, u fastest; N (N + 1) / 2 on every
  /// triangle. Points that faces share have the same bits in all of them.
  LimitSamples evaluate_grid(const Points& points, int N, int order = 0, bool normals = true) const;

  /// Returns a box for each address that contains its part of the limit: around the Bernstein coefficients of
  /// polynomial pieces, elsewhere around the points, enlarged where weights are negative.
  std::vector<Eigen::AlignedBox3d> bounding_boxes(const Points& points) const;

 private:
  std::shared_ptr<const Parts> parts_;
};

/// Returns pairs of rows of a grid that are the same point: a later row and the first one.
/// @param dual  true for a dual scheme, which separates the sides of non-manifold edges and vertices
std::vector<std::pair<std::int64_t, std::int64_t>> shared_grid_places(const Topology& topology,
                                                                      const Addresses& addresses, int N, bool dual);

}  // namespace sublimit
