// SPDX-License-Identifier: Apache-2.0
#pragma once
// Fields of single shapes and of blobs. Functions throw InvalidParameter, which names the parameter, if a number is not
// finite, or a radius or height is outside the range given below.
//
// Sources: Blinn 1982, "A generalization of algebraic surface drawing"; Nishimura et al. 1985, "Object modeling by
// distribution function and a method of image generation" (metaballs); Wyvill, McPheeters, Wyvill 1986, "Data structure
// for soft objects"; Bloomenthal 1997, "Introduction to implicit surfaces" (distance surfaces).
#include <vector>

#include "sublimit/core/types.h"
#include "sublimit/implicit/field.h"

namespace sublimit {

/// |x - c|^2 - r^2, r > 0.
FieldPointer sphere_field(const Eigen::Vector3d& center, double radius);

// Distance to a skeleton less a radius >= 0. Second derivatives jump where the nearest part of the skeleton changes
// from an edge to its end.
FieldPointer distance_to_point(const Eigen::Vector3d& point, double radius);
FieldPointer distance_to_line(const Eigen::Vector3d& point, const Eigen::Vector3d& direction, double radius);
FieldPointer distance_to_segment(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius);
/// |(x - p) . n| - offset, a slab; with `is_signed` (x - p) . n - offset, a half-space, whose offset may be any.
FieldPointer distance_to_plane(const Eigen::Vector3d& point, const Eigen::Vector3d& normal, double offset,
                               bool is_signed = false);
/// @param ring  the circle's radius > 0
FieldPointer distance_to_circle(const Eigen::Vector3d& center, const Eigen::Vector3d& normal, double ring,
                                double radius);
/// A plane polygon with its inside.
/// @param points  3 at least, #points x 3, in one plane to 1e-9 of their size
FieldPointer distance_to_polygon(const Points& points, double radius);

/// max |x_i - c_i| - half_i: its edges and corners are sharp.
FieldPointer box_field(const Eigen::Vector3d& center, const Eigen::Vector3d& half);

struct PolynomialTerm {
  double coefficient = 0;
  int i = 0, j = 0, k = 0;
};
/// Sum of c x^i y^j z^k.
FieldPointer polynomial_field(std::vector<PolynomialTerm> terms);
/// (x, 1)^T Q (x, 1).
FieldPointer quadric_field(const Eigen::Matrix4d& Q);

/// A blob; negative heights carve.
struct Blob {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  double height = 1;
  double size = 1;  ///< radius of influence, of Blinn's the decay; > 0
};
/// T - sum b exp(-a r^2).
FieldPointer blinn_field(double threshold, std::vector<Blob> blobs);
/// T - sum of b (1 - 3 r^2/R^2) up to R/3, 3/2 b (1 - r/R)^2 up to R: C^1.
FieldPointer metaballs_field(double threshold, std::vector<Blob> blobs);
/// T - sum of b (1 - 4/9 r^6/R^6 + 17/9 r^4/R^4 - 22/9 r^2/R^2) up to R: C^1.
FieldPointer soft_objects_field(double threshold, std::vector<Blob> blobs);

}  // namespace sublimit
