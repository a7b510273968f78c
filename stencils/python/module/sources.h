// SPDX-License-Identifier: Apache-2.0
#pragma once
// Surfaces with their control points, as one interface for evaluation and search.
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "sublimit/patches/patches.h"
#include "sublimit/search/closest_point.h"
#include "sublimit/search/intersect.h"
#include "sublimit/stencils/jobs/detail/mesh_job.h"
#include "sublimit/surface/limit_surface.h"
#include "sublimit/tessellation/tessellate.h"

namespace sublimit::python {

/// A surface with its control points.
class Source {
 public:
  virtual ~Source() = default;
  virtual const LinearSource& surface() const = 0;
  virtual const Points& points() const = 0;
  virtual ClosestPoints closest(const Points& queries, const ClosestPointOptions& options) const = 0;
  virtual RayHits intersect(const std::vector<Ray>& rays, const RayOptions& options) const = 0;
  virtual Tessellation tessellate(const TessellationOptions& options) const = 0;

  /// Evaluates places on faces of the surface, with derivatives up to `order` and normals.
  LimitSamples evaluate(std::span<const Place> places, int order) const {
    LimitSamples samples;
    bound().evaluate(places, order, true, samples);
    return samples;
  }

 protected:
  virtual const BoundSource& bound() const = 0;
};

/// The limit of a mesh.
class Surface : public Source {
 public:
  Surface(const Mesh& mesh, const MeshRequest& request)
      : surface_([&] {
          const MeshJob job = mesh_job(request, mesh, "mesh");
          return LimitSurface(job.mesh, *job.scheme);
        }()) {}
  explicit Surface(LimitSurface surface) : surface_(std::move(surface)) {}

  const LimitMap& surface() const override { return surface_.map(); }
  const Points& points() const override { return surface_.points(); }
  ClosestPoints closest(const Points& queries, const ClosestPointOptions& options) const override {
    return surface_.closest(queries, options);
  }
  RayHits intersect(const std::vector<Ray>& rays, const RayOptions& options) const override {
    return surface_.intersect(rays, options);
  }
  Tessellation tessellate(const TessellationOptions& options) const override { return surface_.tessellate(options); }
  const LimitSurface& limit_surface() const { return surface_; }

 private:
  const BoundSource& bound() const override { return surface_; }

  LimitSurface surface_;
};

/// Classical surfaces of a file. Their points are plain or homogeneous.
class PatchSurfaces : public Source {
 public:
  explicit PatchSurfaces(Patches patches) : patches_(std::move(patches)) {}

  const PatchSet& surface() const override { return patches_.set(); }
  const Points& points() const override { return patches_.points(); }
  ClosestPoints closest(const Points& queries, const ClosestPointOptions& options) const override {
    return patches_.closest(queries, options);
  }
  RayHits intersect(const std::vector<Ray>& rays, const RayOptions& options) const override {
    return patches_.intersect(rays, options);
  }
  Tessellation tessellate(const TessellationOptions& options) const override { return patches_.tessellate(options); }
  const Patches& patches() const { return patches_; }

 private:
  const BoundSource& bound() const override { return patches_; }

  Patches patches_;
};

}  // namespace sublimit::python
