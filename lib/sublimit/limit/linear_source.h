// SPDX-License-Identifier: Apache-2.0
#pragma once
// A surface that is linear in its control points, whatever it is: control points, faces, and for each place a stencil
// with a status. Samples, tables, fits and reports know this and nothing else of their source.
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
  /// Into memory that is kept from call to call.
  virtual void evaluate(std::span<const Sample> samples, int order, bool normals, LimitSamples& out) const = 0;
};

/// Places of a grid on every face: N x N, ends included, row-major, u fastest; triangles N (N + 1) / 2.
/// @throws InvalidParameter  N < 2
/// @throws ResourceError     more samples than memory can hold
std::vector<Sample> grid_places(FaceCount faces, int N);

class LinearSource {
 public:
  virtual ~LinearSource() = default;

  /// Control points.
  virtual Index num_points() const = 0;
  virtual FaceCount faces() const = 0;
  /// Of the own parameters of a patch; of a mesh, whose quadrilaterals have sides of 1, the square at a corner of any
  /// other polygon has sides of 1/2.
  virtual FaceLengths lengths(Index) const { return {}; }

  /// Stencil of one place. Every request has an answer: what does not exist there is told by the status.
  /// @param order  of derivatives: 0, 1 or 2
  /// @throws InvalidParameter  a face that does not exist, parameters outside the domain or not finite, another order
  virtual LimitStencil stencil(const Sample& sample, int order = 0) const = 0;

  /// Points of the surface with derivatives and normals; in parallel.
  /// @param points  the control points' columns
  /// @param normals  whether order >= 1 has them too
  virtual LimitSamples evaluate(const Points& points, std::span<const Sample> samples, int order = 0,
                                bool normals = true) const = 0;

  /// `grid_places` of these faces.
  std::vector<Sample> grid(int N) const { return grid_places(faces(), N); }

  /// This source with its control points, for many evaluations.
  /// @return  which needs this source to stay: a temporary one has none. A source that overrides it deletes the
  /// overload
  ///          for temporaries again, which its own function hides.
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
