// SPDX-License-Identifier: Apache-2.0
#include "sublimit/stencils/picture/svg.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace sublimit::svg {

std::string escaped(std::string_view text) {
  std::string result;
  for (char c : text) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += static_cast<unsigned char>(c) < 32 ? ' ' : c;
    }
  }
  return result;
}

int nearest(double value) {
  if (std::isnan(value)) return 0;
  return static_cast<int>(std::lround(std::clamp(value, -1. * farthest, 1. * farthest)));
}

std::string pixels(double value) {
  const int tenths = nearest(value * units);
  std::string text = std::to_string(std::abs(tenths) / units);
  if (tenths % units != 0) text += "." + std::to_string(std::abs(tenths) % units);
  return tenths < 0 ? "-" + text : text;
}

Spot spot(double x, double y) { return {nearest(x * units), nearest(y * units)}; }

}  // namespace sublimit::svg
