// SPDX-License-Identifier: Apache-2.0
#pragma once
// Surfaces that are linear in their control points: limits of schemes, classical patches. Each has control points,
// faces, and for each place a stencil with a status; samples, tables, fits and reports use nothing else.
#include <memory>
#include <span>
#include <vector>

#include "sublimit/limit/address.h"
#include "sublimit/limit/limit_stencil.h"

namespace sublimit {

/// A source with its control points, for many evaluations.
class BoundSource {
 public:
  virtual ~BoundSource() = default;
  /// Evaluates places into `out`, whose memory is reused.
  virtual void evaluate(std::span<const Sample> samples, int order, bool normals, LimitSamples& out) const = 0;
};

/// Returns the places of a grid on every face: N x N, ends included, row-major, u fastest; triangles N (N + 1) / 2.
/// @throws InvalidParameter  N < 2
/// @throws ResourceError     more samples than memory can hold
std::vector<Sample> grid_places(FaceCount faces, int N);

class LinearSource {
 public:
  virtual ~LinearSource() = default;

  /// Returns the number of control points.
  virtual Index num_points() const = 0;
  virtual FaceCount faces() const = 0;
  /// Returns the lengths of a face's sides in the surface's own parameters: those of a patch's knots; for meshes 1 on
  /// quadrilaterals and triangles, and 1/2 on the square at a corner of any other polygon.
  virtual FaceLengths lengths(Index) const { return {}; }

  /// Returns the stencil of a place. The status says what does not exist there.
  /// @param order  of derivatives: 0, 1 or 2
  /// @throws InvalidParameter  a face that does not exist, parameters outside the domain or not finite, another order
  virtual LimitStencil stencil(const Sample& sample, int order = 0) const = 0;

  /// Returns points of the surface with derivatives and normals; in parallel.
  /// @param points  the control points' columns
  /// @param normals  whether order >= 1 has them too
  virtual LimitSamples evaluate(const Points& points, std::span<const Sample> samples, int order = 0,
                                bool normals = true) const = 0;

  /// Returns `grid_places` of these faces.
  std::vector<Sample> grid(int N) const { return grid_places(faces(), N); }

  /// Returns this source with its control points, for many evaluations. It refers to this source, so temporaries have
  /// none: a source that overrides this and is referred to deletes the overload for temporaries again.
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
