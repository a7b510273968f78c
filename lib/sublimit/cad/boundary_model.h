// SPDX-License-Identifier: Apache-2.0
#pragma once
// A boundary representation as plain data: what CAD programs exchange. Faces are parts of tensor B-splines, their
// borders are edges, which faces share, and these end at vertices, which edges share: by number, never by position.
#include <Eigen/Core>

#include <vector>

#include "sublimit/core/types.h"

namespace sublimit {

struct SplineEdge {
  Index start = 0, end = 0;  ///< vertices
  int degree = 1;
  std::vector<double> knots;  ///< ascending, each as often as it counts; poles + degree + 1 of them
  Points poles;
  bool is_sharp = false;  ///< a crease or border of the surface
  double gap = 0;         ///< of the curve and the borders of its faces, measured
};

/// An edge on the border of a face: a straight segment in the face's parameters, as long there as its own knots span.
struct EdgeUse {
  Index edge = 0;
  bool reversed = false;                       ///< the border runs against the edge
  Eigen::Vector2d from = {0, 0}, to = {0, 0};  ///< along the border
};

struct SplineFace {
  int degree = 1;  ///< in both directions
  std::vector<double> u_knots, v_knots;
  Points poles;                 ///< v fastest
  std::vector<EdgeUse> border;  ///< counter-clockwise
  bool is_exact = true;         ///< else it is fitted
  double volume = 0;            ///< that it adds to what a closed surface bounds
};

struct BoundaryModel {
  Points vertices;
  std::vector<SplineEdge> edges;
  std::vector<SplineFace> faces;
};

}  // namespace sublimit
