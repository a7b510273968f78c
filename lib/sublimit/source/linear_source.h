// SPDX-License-Identifier: Apache-2.0
#pragma once
// Interface of surfaces that are linear in their control points: limits of schemes (LimitMap), classical patches
// (PatchSet). Each has control points, faces, and for each place a stencil with a status; evaluation, tables, fits and
// reports use nothing else.
//
//   const LimitMap map(*AnyScheme("catmull-clark"), mesh);
//   const LinearSource& surface = map;
//   const LimitSamples samples = surface.evaluate(mesh.positions, surface.grid(5), 1);
//   const LimitStencil stencil = surface.stencil({.face = 0, .u = 0.5, .v = 0.5});
#include <memory>
#include <span>
#include <vector>

#include "sublimit/source/address.h"
#include "sublimit/source/limit_stencil.h"

namespace sublimit {

/// A source with its control points, for many evaluations. It never changes: threads may share it.
class BoundSource {
 public:
  virtual ~BoundSource() = default;
  /// Evaluates places into `out`, whose memory is reused.
  /// @param order    number of derivatives: 0, 1 or 2
  /// @param normals  compute normals too, if order >= 1
  virtual void evaluate(std::span<const Place> places, int order, bool normals, LimitSamples& out) const = 0;
};

/// Returns the places of a grid on every face: N x N, sides included, u fastest; on triangles N (N + 1) / 2.
/// @throws InvalidParameter  N < 2
/// @throws ResourceError     more places than memory can hold
std::vector<Place> grid_places(FaceCount faces, int N);

/// A surface that is linear in its control points, without these. It never changes: threads may share it.
class LinearSource {
 public:
  virtual ~LinearSource() = default;

  /// Returns the number of control points.
  virtual Index num_points() const = 0;
  /// Returns the faces that places may be on.
  virtual FaceCount faces() const = 0;
  /// Returns the lengths of a face's sides in the surface's own parameters: knot spans for patches; for meshes 1 on
  /// quadrilaterals and triangles, and 1/2 on the square at a corner of any other polygon.
  virtual FaceLengths lengths(Index) const { return {}; }

  /// Returns the stencil of a place. The status says what does not exist there.
  /// @param order  number of derivatives: 0, 1 or 2
  /// @throws InvalidParameter  a face that does not exist, parameters outside the domain or not finite, another order
  virtual LimitStencil stencil(const Place& place, int order = 0) const = 0;

  /// Returns points of the surface with derivatives and normals; in parallel.
  /// @param points   control points, #control points x 3, or x 4 if they are homogeneous
  /// @param normals  compute normals too, if order >= 1
  virtual LimitSamples evaluate(const Points& points, std::span<const Place> places, int order = 0,
                                bool normals = true) const = 0;

  /// Returns `grid_places` of these faces.
  std::vector<Place> grid(int N) const { return grid_places(faces(), N); }

  /// Returns this source with its control points, for many evaluations. The result refers to this source, so it cannot
  /// be had of temporaries: a class whose results refer to it and that overrides this deletes the overload for
  /// temporaries again.
  virtual std::unique_ptr<BoundSource> bound(const Points& points) const&;
  std::unique_ptr<BoundSource> bound(const Points& points) const&& = delete;

 protected:
  LinearSource() = default;
  LinearSource(const LinearSource&) = default;
  LinearSource(LinearSource&&) = default;
  LinearSource& operator=(const LinearSource&) = default;
  LinearSource& operator=(LinearSource&&) = default;
};

}  // namespace sublimit
