// SPDX-License-Identifier: Apache-2.0
#include "sublimit/report/free_form/spline_patches.h"

#include "sublimit/io/detail/free_form_counts.h"
#include "sublimit/patches/detail/free_form_patches.h"
#include "sublimit/patches/detail/spline_rows.h"

namespace sublimit {
namespace {

/// Sets the part of the domain that is meant to all of it.
/// @return  whether it was less
bool take_whole(FreeFormBasis basis, FreeFormDirection& direction) {
  const auto [first, last] = free_form_domain(basis, direction);
  const bool is_part = direction.first != first || direction.last != last;
  direction.first = first, direction.last = last;
  return is_part;
}

}  // namespace

SplinePatches spline_patches(const FreeForm& shapes, const std::string& name) {
  FreeForm whole = shapes;
  std::vector<bool> is_part;
  for (FreeFormSurface& surface : whole.surfaces) {
    const bool in_u = take_whole(surface.basis, surface.u), in_v = take_whole(surface.basis, surface.v);
    is_part.push_back(in_u || in_v);
  }
  const FreeFormPatches found = free_form_patches(whole, name);
  SplinePatches result;
  result.coordinates = found.patches.coordinates();
  for (size_t p = 0; p < found.patches.members().size(); ++p) {
    const FreeFormSurface& surface = shapes.surfaces[p];
    const std::shared_ptr<const Patch>& patch = found.patches.members()[p].patch;
    Points columns = found.patches.columns_of(p, found.columns);
    auto spline = std::dynamic_pointer_cast<const SplineSurface>(patch);
    result.is_converted.push_back(is_part[p] || !spline);
    if (!spline) {
      const Patch::Refined refined = patch->refined();
      spline = std::dynamic_pointer_cast<const SplineSurface>(refined.patch);
      columns = refined.S * columns;
      // Control points of such a basis may be vectors: their weights are not those of the pieces.
      if (columns.cols() == 4 && !surface.rational) columns.col(3).setOnes();
    }
    if (is_part[p]) {
      const Knots<double> u = part_knots(spline->u(), surface.u.first, surface.u.last),
                          v = part_knots(spline->v(), surface.v.first, surface.v.last);
      columns = kronecker(part_matrix(spline->v(), v), part_matrix(spline->u(), u)) * columns;
      spline = std::make_shared<const SplineSurface>(u, v);
    }
    result.surfaces.push_back(spline);
    result.patches.push_back({spline.get(), std::move(columns)});
  }
  return result;
}

}  // namespace sublimit
