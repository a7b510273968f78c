// SPDX-License-Identifier: Apache-2.0
#include "sublimit/report/svg.h"

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

std::string pixels(double value) {
  const long tenths = std::lround(value * units);
  std::string text = std::to_string(std::abs(tenths) / units);
  if (tenths % units != 0) text += "." + std::to_string(std::abs(tenths) % units);
  return tenths < 0 ? "-" + text : text;
}

Spot spot(double x, double y) {
  return {static_cast<int>(std::lround(x * units)), static_cast<int>(std::lround(y * units))};
}

}  // namespace sublimit::svg
