// SPDX-License-Identifier: Apache-2.0
#pragma once
// Reading an SVG picture of panels: strokes as points in the picture, and the camera that maps known points to
// them.
#include <gtest/gtest.h>

#include <Eigen/Dense>

#include <charconv>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sublimit/core/detail/dense_decompositions.h"
#include "sublimit/core/types.h"

namespace sublimit::testing {

struct DrawnPanel {
  struct Stroke {
    int width = 0;                                     ///< tenths of a pixel
    std::vector<std::vector<Eigen::Vector2d>> pieces;  ///< tenths of a pixel; a dot is a piece of one point
  };
  std::string caption, note;
  int fills = 0;  ///< outlines of faces
  std::vector<Stroke> strokes;

  /// Returns the stroke of this width; empty if there is none.
  Stroke stroke(int width) const {
    for (const Stroke& s : strokes)
      if (s.width == width) return s;
    return {};
  }
  std::vector<Eigen::Vector2d> dots(int width) const {
    std::vector<Eigen::Vector2d> places;
    for (const auto& piece : stroke(width).pieces) places.push_back(piece.front());
    return places;
  }
};

/// Reads path data of relative moves and lines (m, implied l, h0 for a dot, z).
inline std::vector<std::vector<Eigen::Vector2d>> pieces_of(std::string_view data) {
  std::vector<std::vector<Eigen::Vector2d>> pieces;
  Eigen::Vector2d at(0, 0);
  bool moves = false;
  for (const char* c = data.data(); c < data.data() + data.size();) {
    const auto number = [&] {
      if (*c == ' ') ++c;
      int value = 0;
      const auto [end, error] = std::from_chars(c, data.data() + data.size(), value);
      if (error != std::errc{}) ADD_FAILURE() << "no number in path data: " << std::string(c, 10);
      c = error == std::errc{} ? end : data.data() + data.size();
      return value;
    };
    if (*c == 'm') {
      ++c;
      moves = true;
    } else if (*c == 'h') {  // the round cap of a line of no length
      ++c;
      EXPECT_EQ(number(), 0);
      continue;
    } else if (*c == 'z') {
      ++c;
      at = pieces.back().front();
      continue;
    }
    const int x = number(), y = number();
    at += Eigen::Vector2d(x, y);
    if (moves) pieces.emplace_back();
    moves = false;
    pieces.back().push_back(at);
  }
  return pieces;
}

inline std::vector<DrawnPanel> read_panels(std::string_view svg) {
  std::vector<DrawnPanel> panels;
  const auto attribute = [](std::string_view tag, std::string_view name) {
    const std::string opening = " " + std::string(name) + "=\"";
    const size_t at = tag.find(opening);
    return at == tag.npos ? std::string_view()
                          : tag.substr(at + opening.size(), tag.find('"', at + opening.size()) - at - opening.size());
  };
  for (size_t at = svg.find('<'); at != svg.npos; at = svg.find('<', at + 1)) {
    const std::string_view tag = svg.substr(at, svg.find('>', at) - at);
    if (tag.starts_with("<g transform=\"translate(")) panels.emplace_back();
    if (panels.empty()) continue;
    DrawnPanel& panel = panels.back();
    if (tag.starts_with("<text")) {
      const size_t begin = at + tag.size() + 1;
      (attribute(tag, "font-weight").empty() ? panel.note : panel.caption) =
          svg.substr(begin, svg.find('<', begin) - begin);
    } else if (tag.starts_with("<path")) {
      if (const std::string_view width = attribute(tag, "stroke-width"); attribute(tag, "fill") == "none")
        panel.strokes.push_back({std::stoi(std::string(width)), pieces_of(attribute(tag, "d"))});
      else
        ++panel.fills;
    }
  }
  return panels;
}

/// The camera of a picture with default azimuth and elevation, computed from points and their positions in the
/// picture. The other parameters (frame, scale, distance of the eye) are six numbers, determined by linear
/// equations.
class FoundCamera {
 public:
  FoundCamera(const Points& points, const std::vector<Eigen::Vector2d>& places) {
    Eigen::MatrixXd A(2 * points.rows(), 6);
    Eigen::VectorXd b(2 * points.rows());
    for (Index i = 0; i < points.rows(); ++i) {
      const Eigen::Vector3d q = axes() * points.row(i).transpose();
      const Eigen::Vector2d& p = places[size_t(i)];
      // p = shift + k ((q.x, -q.y) - centre)/(eye - q.z), times eye - q.z.
      A.row(2 * i) << p.x(), -1, 0, q.z(), 0, -q.x();
      A.row(2 * i + 1) << p.y(), 0, -1, 0, q.z(), q.y();
      b.segment(2 * i, 2) = p * q.z();
    }
    // Columns of very different lengths.
    const Eigen::RowVectorXd lengths = A.colwise().norm();
    const Eigen::MatrixXd scaled = A.array().rowwise() / lengths.array();
    x_ = (Eigen::VectorXd(PivotedQr(scaled).solve(b)).array() / lengths.transpose().array()).matrix();
    for (Index i = 0; i < points.rows(); ++i)
      error_ = std::max(error_, ((*this)(points.row(i)) - places[size_t(i)]).cwiseAbs().maxCoeff());
  }
  Eigen::Vector2d operator()(const Eigen::Vector3d& p) const {
    const Eigen::Vector3d q = axes() * p;
    return Eigen::Vector2d(x_[1] - x_[3] * q.z() + x_[5] * q.x(), x_[2] - x_[4] * q.z() - x_[5] * q.y()) /
           (x_[0] - q.z());
  }
  /// Returns the error at the points from which the camera was computed.
  double error() const { return error_; }

 private:
  static Eigen::Matrix3d axes() {
    const double azimuth = .6, elevation = .36;
    const Eigen::Vector3d eye(std::cos(elevation) * std::sin(azimuth), std::sin(elevation),
                              std::cos(elevation) * std::cos(azimuth));
    Eigen::Matrix3d rows;
    rows.row(2) = eye;
    rows.row(0) = Eigen::Vector3d::UnitY().cross(eye).normalized();
    rows.row(1) = eye.cross(Eigen::Vector3d(rows.row(0)));
    return rows;
  }
  Eigen::VectorXd x_;  // eye, two that stand for the centre, shift, k
  double error_ = 0;
};

}  // namespace sublimit::testing
