// SPDX-License-Identifier: Apache-2.0
#pragma once
// The exact limit anywhere. A piece of the surface depends on the points around it alone; where it is a polynomial, its
// basis is evaluated, elsewhere the place is followed through the children of the piece:
//
//   x(f,u,v) = b T_m ... T_1 x_0      T_i: blocks of S on the path; b: basis of a polynomial piece, or a limit mask
//
// Pieces are computed once a type of neighbourhood (piece_types.h).
#include <Eigen/Geometry>

#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "sublimit/limit/address.h"
#include "sublimit/limit/limit_status.h"
#include "sublimit/scheme/refine.h"

namespace sublimit {

class LimitTypes;
class LimitPatches;

/// Weights over control vertices of one place.
struct LimitStencil {
  LimitStatus status = LimitStatus::regular;
  std::vector<Index> vertices;  ///< ascending
  /// Rows: position, then du, dv, then duu, duv, dvv, as far as asked for and existing; one column per vertex. Position
  /// weights sum to 1, derivatives' to 0.
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> weights;
  /// Two rows along the tangent plane, their cross product along the normal: du and dv where these exist,
  /// characteristic tangents at extraordinary vertices, followed by the next modes, for points that make them
  /// degenerate; none where there is no plane.
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> tangents;
};

/// What `evaluate` gives, row by row. Absent quantities are zero; `order` and `status` say what is there; a place
/// outside the domain has the status `outside` and nothing else.
struct LimitSamples {
  Points position;       ///< #samples x 3
  Points du, dv;         ///< order >= 1
  Points duu, duv, dvv;  ///< order 2
  Points normal;         ///< unit length, by the winding of faces, zero where undefined; order >= 1
  std::vector<LimitStatus> status;
  std::vector<std::int8_t> order;  ///< derivatives that this row has: 0, 1 or 2
};

/// Curvature of the surface, by its first and second derivatives.
struct Curvature {
  double gauss = 0, mean = 0;              ///< mean > 0 where the surface bends towards its normal
  double k1 = 0, k2 = 0;                   ///< principal ones, k1 >= k2
  Eigen::Vector3d direction1, direction2;  ///< of k1, k2: unit length, in the tangent plane
};

class LimitSurface {
 public:
  struct Parts;
  /// @param types  shared between surfaces of the same scheme, if given
  /// @throws InvalidMesh, UnsupportedTopology  as refinement does
  LimitSurface(const Scheme<double>& scheme, const ControlMesh& mesh, const SubdivisionOptions& options = {},
               std::shared_ptr<LimitTypes> types = nullptr);
  /// Of a level, with stencils over its vertices.
  LimitSurface(const Scheme<double>& scheme, Level level, std::shared_ptr<LimitTypes> types = nullptr);
  ~LimitSurface();
  LimitSurface(LimitSurface&&) noexcept;
  LimitSurface& operator=(LimitSurface&&) noexcept;

  const Addresses& addresses() const;
  const Level& level() const;

  /// Finds the types of all pieces now, in parallel; else they are found at the first use.
  void prepare() const;

  /// Stencil of one place. Every request has an answer: what does not exist there is told by the status.
  /// @param order  of derivatives: 0, 1 or 2
  /// @throws InvalidParameter  a face that does not exist, parameters outside the domain or not finite, another order
  LimitStencil stencil(const Sample& sample, int order = 0) const;

  /// Points of the surface with derivatives and normals; in parallel.
  /// @param points  of the level, #V x 3
  /// @param normals  whether order >= 1 has them too
  LimitSamples evaluate(const Points& points, std::span<const Sample> samples, int order = 0,
                        bool normals = true) const;

  /// N x N samples per address, ends included, row-major, u fastest; triangles N (N + 1) / 2. Points that squares share
  /// have the same bits in all of them.
  LimitSamples evaluate_grid(const Points& points, int N, int order = 0, bool normals = true) const;
  /// Their places.
  /// @throws InvalidParameter  N < 2
  /// @throws ResourceError     more samples than memory can hold
  std::vector<Sample> grid(int N) const;

  /// For each address a box that holds its part of the limit: of the Bernstein coefficients of polynomial pieces, of
  /// the points elsewhere, widened where weights are negative.
  std::vector<Eigen::AlignedBox3d> bounding_boxes(const Points& points) const;

 private:
  friend class LimitPatches;
  friend class BoundLimitSurface;
  std::unique_ptr<Parts> parts_;
};

/// Pairs of rows of a grid, a later one and the first one, that are the same point.
/// @param dual  of a dual scheme, which keeps the sides of non-manifold edges and vertices apart
std::vector<std::pair<std::int64_t, std::int64_t>> shared_grid_places(const Topology& topology,
                                                                      const Addresses& addresses, int N, bool dual);

/// A surface with its points, for many evaluations.
class BoundLimitSurface {
 public:
  /// @param surface  which must stay
  BoundLimitSurface(const LimitSurface& surface, Points points);
  ~BoundLimitSurface();
  LimitSamples evaluate(std::span<const Sample> samples, int order = 0, bool normals = true) const;
  /// The same into memory that is kept from call to call.
  void evaluate(std::span<const Sample> samples, int order, bool normals, LimitSamples& out) const;

 private:
  Points points_;
  std::unique_ptr<LimitPatches> patches_;
};

/// Curvature where first and second derivatives exist and the first ones span a plane; nothing elsewhere.
std::optional<Curvature> curvature(const LimitSamples& samples, Index row);

}  // namespace sublimit
