// SPDX-License-Identifier: Apache-2.0
#pragma once
// Surfaces with their control points: what places are evaluated on, whatever it is.
#include <filesystem>
#include <memory>
#include <span>

#include "sublimit/io/free_form.h"
#include "sublimit/jobs/mesh_job.h"
#include "sublimit/limit/limit_surface.h"
#include "sublimit/patches/free_form_patches.h"
#include "sublimit/recipes/recipe.h"
#include "sublimit/recipes/recipe_sources.h"
#include "sublimit/search/searched_patches.h"
#include "sublimit/search/searched_surface.h"

namespace sublimit::python {

/// A surface with its control points.
class Source {
 public:
  virtual ~Source() = default;
  virtual const LinearSource& surface() const = 0;
  virtual const Points& points() const = 0;
  virtual std::unique_ptr<SearchedSurface> searched() const = 0;

  /// @param places  on its faces
  LimitSamples evaluate(std::span<const Sample> places, int order) const {
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
  Surface(const ControlMesh& mesh, const MeshRequest& request)
      : surface_([&] {
          const MeshJob job = mesh_job(request, mesh, "mesh");
          return LimitSurface(job.mesh, *job.scheme);
        }()) {}

  const LimitMap& surface() const override { return surface_.map(); }
  const Points& points() const override { return surface_.points(); }
  std::unique_ptr<SearchedSurface> searched() const override { return std::make_unique<SearchedLimit>(surface_); }

 private:
  const BoundSource& bound() const override { return surface_; }

  LimitSurface surface_;
};

/// Classical surfaces of a file. Columns are points, or homogeneous.
struct PatchData {
  PatchSet patches;
  Points columns;
};
inline PatchData read_patches(const std::filesystem::path& path) {
  if (path.extension() == ".json") {
    const std::vector<Recipe> recipes = read_recipes(path);
    RecipePatches found = recipe_patches(recipes, path);
    return {std::move(found.patches), std::move(found.columns)};
  }
  FreeFormPatches found = free_form_patches(read_free_form(path), path);
  return {std::move(found.patches), std::move(found.columns)};
}
class Patches : public Source {
 public:
  explicit Patches(const std::filesystem::path& path)
      : data_(read_patches(path)), bound_(data_.patches.bound(data_.columns)) {}

  const PatchSet& surface() const override { return data_.patches; }
  const Points& points() const override { return data_.columns; }
  std::unique_ptr<SearchedSurface> searched() const override {
    return std::make_unique<SearchedPatches>(data_.patches, data_.columns);
  }

 private:
  const BoundSource& bound() const override { return *bound_; }

  PatchData data_;
  std::unique_ptr<BoundSource> bound_;
};

}  // namespace sublimit::python
