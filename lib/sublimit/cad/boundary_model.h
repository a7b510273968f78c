// SPDX-License-Identifier: Apache-2.0
#pragma once
// A boundary representation as plain data: what CAD programs exchange. Faces are parts of tensor B-splines, their
// borders are edges, which faces share, and these end at vertices, which edges share: by number, never by position.
#include <Eigen/Core>

#include <string>
#include <vector>

#include "sublimit/core/types.h"

namespace sublimit {

struct SplineEdge {
  Index start = 0, end = 0;  ///< vertices
  int degree = 1;
  std::vector<double> knots;  ///< ascending, each as often as it counts; poles + degree + 1 of them
  Points poles;
  Eigen::VectorXd weights = {};  ///< of the poles, > 0; empty: not rational
  bool is_sharp = false;         ///< a crease or border of the surface
  double gap = 0;                ///< of the curve and the borders of its faces, measured
  bool is_point = false;         ///< a side of a face that is one point: no curve, but the range of its knots
};

/// An edge on the border of a face: a straight segment in the face's parameters, linear in those of the edge.
struct EdgeUse {
  Index edge = 0;
  bool reversed = false;                       ///< the border runs against the edge
  Eigen::Vector2d from = {0, 0}, to = {0, 0};  ///< along the border
};

struct SplineFace {
  int u_degree = 1, v_degree = 1;
  std::vector<double> u_knots, v_knots;
  Points poles;                      ///< v fastest
  Eigen::VectorXd weights = {};      ///< of the poles, > 0; empty: not rational
  std::vector<EdgeUse> border = {};  ///< counter-clockwise; a face that is closed has its seam twice
  bool is_exact = true;              ///< else it is fitted
  double volume = 0;                 ///< that it adds to what a closed surface bounds, as seen from its front
  bool reversed = false;             ///< its front is where du x dv does not point
  std::string name = {};             ///< UTF-8; empty: none
};

struct BoundaryModel {
  Points vertices;
  std::vector<SplineEdge> edges;
  std::vector<SplineFace> faces;
};

}  // namespace sublimit
