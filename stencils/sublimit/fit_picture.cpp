// SPDX-License-Identifier: Apache-2.0
#include "sublimit/fit_picture.h"

#include "sublimit/refined_mesh.h"
#include "sublimit/report/picture_mesh.h"
#include "sublimit/sparse_product.h"

namespace sublimit {
namespace {

constexpr Index most_faces = 30'000;
constexpr double needle = .07;  // of the targets' diagonal

/// The limit, on a level fine enough to look smooth.
PictureMesh limit_picture(const Scheme<double>& scheme, Level level, Points points) {
  while (level.topology().num_faces() * 4 <= most_faces) {
    level = next_level(scheme, level);
    points = apply(level.S, points);
  }
  LimitMaskCache cache(scheme);
  const LimitMatrices limit = limit_matrices(level, cache);
  return surface_picture(limit_mesh(level, limit, limit_points(limit, level.topology(), points), Normals::per_corner));
}

/// Dots, and needles along the normals.
PictureMesh target_picture(const FitPicture& words) {
  PictureMesh picture;
  const Index count = static_cast<Index>(words.targets.rows());
  const double length = needle * (words.targets.colwise().maxCoeff() - words.targets.colwise().minCoeff()).norm();
  const bool normals = words.normals.rows() > 0;
  picture.faces = false;
  picture.positions.resize(normals ? 2 * count : count, 3);
  picture.positions.topRows(count) = words.targets;
  for (Index i = 0; i < count; ++i) {
    picture.dots.push_back(i);
    if (!normals) continue;
    picture.positions.row(count + i) = words.targets.row(i) + length * words.normals.row(i).normalized();
    if (!words.normals.row(i).isZero(0)) picture.creases.push_back({i, count + i, .5});
  }
  return picture;
}

}  // namespace

std::string fit_picture(const Scheme<double>& scheme, const Level& given, const Points& given_points,
                        const Level& fitted, const Points& fitted_points, const FitPicture& words) {
  PictureMesh cage = wire_picture(given, given_points);
  cage.creases.clear();
  const PictureMesh targets = target_picture(words);
  return svg_picture({{{cage, targets}, words.before, words.before_note},
                      {{limit_picture(scheme, given, given_points), targets}, words.between, words.between_note},
                      {{limit_picture(scheme, fitted, fitted_points), targets}, words.after, words.after_note}});
}

}  // namespace sublimit
