// SPDX-License-Identifier: Apache-2.0
#pragma once
// Fields of simple shapes and of blobs. Functions throw InvalidParameter, which names the parameter, if a
// number is not finite, or a radius or height is outside the range given below.
//
// Sources: Blinn 1982, "A generalization of algebraic surface drawing"; Nishimura et al. 1985, "Object modeling by
// distribution function and a method of image generation" (metaballs); Wyvill, McPheeters, Wyvill 1986, "Data structure
// for soft objects"; Bloomenthal 1997, "Introduction to implicit surfaces" (distance surfaces).
#include <vector>

#include "sublimit/core/types.h"
#include "sublimit/implicit/field.h"

namespace sublimit {

/// Returns the sphere |x - c|^2 - r^2, r > 0.
FieldPointer sphere_field(const Eigen::Vector3d& center, double radius);

// Distances to a skeleton minus a radius >= 0. Second derivatives jump where the nearest part of the skeleton
// changes from an edge to its end.
FieldPointer distance_to_point(const Eigen::Vector3d& point, double radius);
FieldPointer distance_to_line(const Eigen::Vector3d& point, const Eigen::Vector3d& direction, double radius);
FieldPointer distance_to_segment(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius);
/// Returns the slab |(x - p) . n| - offset, or with `is_signed` the half-space (x - p) . n - offset with any
/// offset.
FieldPointer distance_to_plane(const Eigen::Vector3d& point, const Eigen::Vector3d& normal, double offset,
                               bool is_signed = false);
/// @param ring  radius > 0 of the circle
FieldPointer distance_to_circle(const Eigen::Vector3d& center, const Eigen::Vector3d& normal, double ring,
                                double radius);
/// Returns the distance from a planar polygon with its interior.
/// @param points  #points x 3, at least 3, coplanar to 1e-9 of their size
FieldPointer distance_to_polygon(const Points& points, double radius);

/// Returns the box max_i (|x_i - c_i| - half_i), with sharp edges and corners.
FieldPointer box_field(const Eigen::Vector3d& center, const Eigen::Vector3d& half);

struct PolynomialTerm {
  double coefficient = 0;
  int i = 0, j = 0, k = 0;
};
/// Returns the polynomial, a sum of terms c x^i y^j z^k.
FieldPointer polynomial_field(std::vector<PolynomialTerm> terms);
/// Returns the quadric (x, 1)^T Q (x, 1).
FieldPointer quadric_field(const Eigen::Matrix4d& Q);

/// A blob; one with a negative height subtracts.
struct Blob {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  double height = 1;
  double size = 1;  ///< radius R of influence, for Blinn's blobs the decay a; > 0
};
/// Returns Blinn's field T - sum b exp(-a r^2).
FieldPointer blinn_field(double threshold, std::vector<Blob> blobs);
/// Returns the metaballs T - sum of b (1 - 3 r^2/R^2) up to R/3, 3/2 b (1 - r/R)^2 up to R: C^1.
FieldPointer metaballs_field(double threshold, std::vector<Blob> blobs);
/// Returns the soft objects T - sum of b (1 - 4/9 r^6/R^6 + 17/9 r^4/R^4 - 22/9 r^2/R^2) up to R: C^1.
FieldPointer soft_objects_field(double threshold, std::vector<Blob> blobs);

}  // namespace sublimit
