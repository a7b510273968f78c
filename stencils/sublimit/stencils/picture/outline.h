// SPDX-License-Identifier: Apache-2.0
#pragma once
// Outlines: the union of many polygons as one path.
#include <string>
#include <vector>

#include "sublimit/stencils/picture/svg.h"

namespace sublimit::picture {

using svg::Spot;

/// Outline of the union of polygons that do not overlap and have the same orientation. Edges that are used in
/// both directions cancel.
class Outline {
 public:
  void add(const std::vector<Spot>& polygon) {
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Spot a = polygon[i], b = polygon[(i + 1) % polygon.size()];
      if (a < b) segments_.push_back({a, b, 1});
      if (b < a) segments_.push_back({b, a, -1});
    }
  }
  std::string data();

 private:
  struct Segment {
    Spot low, high;
    int uses = 1;  // number of uses from low to high, minus those from high to low
  };
  struct Step {
    Spot from, to;
    auto operator<=>(const Step&) const = default;
  };

  std::vector<Step> what_is_left();

  std::vector<Segment> segments_;
};

}  // namespace sublimit::picture
