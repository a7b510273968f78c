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

#include "sublimit/limit/linear_source.h"
#include "sublimit/scheme/refine.h"

namespace sublimit {

class LimitTypes;
class LimitPatches;

/// The map from control points to the limit, without points: what it knows of a mesh is connectivity and tags. Copies
/// share it; threads may.
class LimitMap : public LinearSource {
 public:
  struct Parts;
  /// @param types  shared between surfaces of the same scheme, if given
  /// @throws InvalidMesh, UnsupportedTopology  as refinement does
  LimitMap(const Scheme<double>& scheme, const ControlMesh& mesh, const SubdivisionOptions& options = {},
           std::shared_ptr<LimitTypes> types = nullptr);
  /// Makes the map from the points of a level.
  LimitMap(const Scheme<double>& scheme, Level level, std::shared_ptr<LimitTypes> types = nullptr);
  // Moving copies: a moved-from object stays valid.
  LimitMap(const LimitMap&) = default;
  LimitMap& operator=(const LimitMap&) = default;

  const Addresses& addresses() const;
  const Level& level() const;

  /// Finds the types of all pieces now, in parallel; else they are found at the first use.
  void prepare() const;

  Index num_points() const override;
  FaceCount faces() const override { return addresses(); }
  FaceLengths lengths(Index address) const override;
  LimitStencil stencil(const Sample& sample, int order = 0) const override;
  /// @param points  of the level, #V x 3
  LimitSamples evaluate(const Points& points, std::span<const Sample> samples, int order = 0,
                        bool normals = true) const override;
  std::unique_ptr<BoundSource> bound(const Points& points) const& override;

  /// N x N samples per address, ends included, row-major, u fastest; triangles N (N + 1) / 2. Points that squares share
  /// have the same bits in all of them.
  LimitSamples evaluate_grid(const Points& points, int N, int order = 0, bool normals = true) const;

  /// Returns a box for each address that contains its part of the limit: around the Bernstein coefficients of
  /// polynomial pieces, elsewhere around the points, enlarged where weights are negative.
  std::vector<Eigen::AlignedBox3d> bounding_boxes(const Points& points) const;

 private:
  friend class LimitPatches;
  std::shared_ptr<const Parts> parts_;
};

/// Returns pairs of rows of a grid that are the same point: a later row and the first one.
/// @param dual  of a dual scheme, which keeps the sides of non-manifold edges and vertices apart
std::vector<std::pair<std::int64_t, std::int64_t>> shared_grid_places(const Topology& topology,
                                                                      const Addresses& addresses, int N, bool dual);

}  // namespace sublimit
