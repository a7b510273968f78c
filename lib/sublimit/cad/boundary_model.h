// SPDX-License-Identifier: Apache-2.0
#pragma once
// Boundary representations as plain data, as exchanged by CAD programs. Faces are parts of tensor-product
// B-splines. Their borders are edges, which faces share; edges end at vertices, which edges share. Sharing is
// by index, never by position.
#include <Eigen/Core>

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "sublimit/cad/step.h"
#include "sublimit/core/types.h"

namespace sublimit {

/// An edge with its curve.
struct SplineEdge {
  Index start = 0, end = 0;  ///< vertices
  int degree = 1;
  std::vector<double> knots;  ///< #poles + degree + 1 knots, ascending, repeated by multiplicity
  Points poles;
  Eigen::VectorXd weights = {};  ///< weights of the poles, > 0; empty: not rational
  bool is_sharp = false;         ///< true for a crease or border of the surface
  double gap = 0;                ///< measured distance between the curve and the borders of its faces
  bool is_point = false;         ///< true for a collapsed side of a face: no curve, only the range of its knots
};

/// An edge as a part of the border of a face: a straight segment in the parameters of the face, linear in that
/// of the edge.
struct EdgeUse {
  Index edge = 0;
  bool reversed = false;                       ///< true if the border runs against the edge
  Eigen::Vector2d from = {0, 0}, to = {0, 0};  ///< (u, v) of its ends, along the border
};

/// A face with its surface.
struct SplineFace {
  int u_degree = 1, v_degree = 1;
  std::vector<double> u_knots, v_knots;
  Points poles;                      ///< v fastest
  Eigen::VectorXd weights = {};      ///< weights of the poles, > 0; empty: not rational
  std::vector<EdgeUse> border = {};  ///< counter-clockwise; a closed face has its seam twice
  bool is_exact = true;              ///< false if the surface is fitted
  double volume = 0;                 ///< contribution to the volume of a closed surface, outward from its front
  bool reversed = false;             ///< true if its front is opposite to du x dv
  std::string name = {};             ///< UTF-8; empty: none
  /// Red, green and blue, 0 to 1.
  std::optional<std::array<double, 3>> colour = {};
};

/// A model.
struct BoundaryModel {
  Points vertices;
  std::vector<SplineEdge> edges;
  std::vector<SplineFace> faces;
  LengthUnit unit = LengthUnit::mm;
};

}  // namespace sublimit
