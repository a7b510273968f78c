// SPDX-License-Identifier: Apache-2.0
#pragma once
// A depth buffer, which has the nearest face at every sample.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "sublimit/stencils/picture/camera.h"

namespace sublimit::picture {

class DepthBuffer {
 public:
  DepthBuffer(int width, int height)
      : width_(width),
        height_(height),
        near_(static_cast<std::size_t>(width) * height, -std::numeric_limits<float>::infinity()),
        face_(near_.size(), -1) {}

  void draw(const Projected& a, const Projected& b, const Projected& c, int face) {
    scan(a, b, c, [&](std::size_t pixel, float near) {
      if (near > near_[pixel]) near_[pixel] = near, face_[pixel] = face;
    });
  }
  /// Calls `use(pixel, nearness)` for every sample inside a triangle.
  template <class Use>
  void scan(const Projected& a, const Projected& b, const Projected& c, Use use) const {
    const double area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    if (area == 0) return;
    const int y0 = std::max(0, static_cast<int>(std::ceil(std::min({a.y, b.y, c.y}) - .5)));
    const int y1 = std::min(height_ - 1, static_cast<int>(std::floor(std::max({a.y, b.y, c.y}) - .5)));
    const int x0 = std::max(0, static_cast<int>(std::ceil(std::min({a.x, b.x, c.x}) - .5)));
    const int x1 = std::min(width_ - 1, static_cast<int>(std::floor(std::max({a.x, b.x, c.x}) - .5)));
    for (int y = y0; y <= y1; ++y) {
      for (int x = x0; x <= x1; ++x) {
        const double px = x + .5, py = y + .5;
        const double u = ((px - a.x) * (c.y - a.y) - (py - a.y) * (c.x - a.x)) / area;
        const double v = ((b.x - a.x) * (py - a.y) - (b.y - a.y) * (px - a.x)) / area;
        if (u < 0 || v < 0 || u + v > 1) continue;
        use(static_cast<std::size_t>(y) * width_ + x,
            static_cast<float>(a.near + u * (b.near - a.near) + v * (c.near - a.near)));
      }
    }
  }
  /// Returns for every sample the largest nearness of itself and its eight neighbours.
  std::vector<float> nearest_around() const {
    std::vector<float> rows = near_, result(near_.size());
    for (int y = 0; y < height_; ++y) {
      for (int x = 0; x < width_; ++x) {
        const std::size_t pixel = static_cast<std::size_t>(y) * width_ + x;
        rows[pixel] = std::max({near_[pixel - (x > 0)], near_[pixel], near_[pixel + (x + 1 < width_)]});
      }
    }
    for (int y = 0; y < height_; ++y) {
      const std::size_t above = y > 0 ? width_ : 0, below = y + 1 < height_ ? width_ : 0;
      for (int x = 0; x < width_; ++x) {
        const std::size_t pixel = static_cast<std::size_t>(y) * width_ + x;
        result[pixel] = std::max({rows[pixel - above], rows[pixel], rows[pixel + below]});
      }
    }
    return result;
  }
  float near(std::size_t pixel) const { return near_[pixel]; }
  int face(std::size_t pixel) const { return face_[pixel]; }
  /// Returns the fraction of the samples at and around (x, y) for which `open(face, nearness)` is true.
  template <class Open>
  double share_around(double x, double y, Open open) const {
    const int cx = static_cast<int>(std::floor(x)), cy = static_cast<int>(std::floor(y));
    int count = 0, all = 0;
    for (int j = std::max(0, cy - 1); j <= std::min(height_ - 1, cy + 1); ++j) {
      for (int i = std::max(0, cx - 1); i <= std::min(width_ - 1, cx + 1); ++i) {
        const std::size_t pixel = static_cast<std::size_t>(j) * width_ + i;
        count += open(face_[pixel], near_[pixel]);
        ++all;
      }
    }
    return all > 0 ? static_cast<double>(count) / all : 0;
  }

 private:
  int width_, height_;
  std::vector<float> near_;
  std::vector<int> face_;
};

}  // namespace sublimit::picture
