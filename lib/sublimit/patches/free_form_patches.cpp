// SPDX-License-Identifier: Apache-2.0
#include "sublimit/patches/free_form_patches.h"

#include <algorithm>

#include "sublimit/base/error.h"

namespace sublimit {
namespace {

std::string at(const std::string& name, std::int64_t line) { return name + ":" + std::to_string(line) + ": "; }

/// Knots of one direction of a surface.
Knots<double> knots_of(FreeFormBasis basis, const FreeFormDirection& direction) {
  const std::vector<double>& values = direction.parameters;
  if (basis == FreeFormBasis::bspline) return Knots<double>::open(direction.degree, direction.count, values);
  // Pieces side by side share a control point, so that inner ends are there once for each degree.
  std::vector<double> knots{values.front()};
  for (const double t : values) knots.insert(knots.end(), size_t(direction.degree), t);
  knots.push_back(values.back());
  return Knots<double>::open(direction.degree, direction.count, std::move(knots));
}

}  // namespace

FreeFormPatches free_form_patches(const FreeForm& shapes, const std::string& name) {
  if (shapes.surfaces.empty())
    throw UnsupportedTopology(name + ": " + std::to_string(shapes.curves.size()) +
                              " curves and no surfaces; give a file with `surf`");
  const bool rational =
      std::ranges::any_of(shapes.surfaces, [](const FreeFormSurface& surface) { return surface.rational; });
  std::vector<SplineSurface> patches;
  std::vector<std::int64_t> lines;
  Index num_points = 0;
  for (const FreeFormSurface& surface : shapes.surfaces) {
    if (surface.basis != FreeFormBasis::bezier && surface.basis != FreeFormBasis::bspline)
      throw UnsupportedTopology(at(name, surface.line) + "surfaces of cstype bezier and bspline are taken so far");
    try {
      patches.emplace_back(knots_of(surface.basis, surface.u), knots_of(surface.basis, surface.v));
    } catch (const InvalidParameter& error) {
      throw InvalidParameter(at(name, surface.line) + error.what());
    }
    lines.push_back(surface.line);
    num_points += static_cast<Index>(surface.points.size());
  }
  Points columns(num_points, rational ? 4 : 3);
  Index row = 0;
  for (const FreeFormSurface& surface : shapes.surfaces)
    for (const Index v : surface.points) {
      const double w = surface.rational ? shapes.weights[size_t(v)] : 1;
      columns.row(row).head(3) = (w == 0 ? 1 : w) * shapes.vertices.row(v);
      if (rational) columns(row, 3) = w;
      ++row;
    }
  return {PatchSet(std::move(patches), rational ? Coordinates::homogeneous : Coordinates::plain), std::move(columns),
          std::move(lines)};
}

}  // namespace sublimit
