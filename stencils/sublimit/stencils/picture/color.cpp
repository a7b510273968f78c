// SPDX-License-Identifier: Apache-2.0
#include "sublimit/stencils/picture/color.h"

#include <algorithm>
#include <cmath>
#include <string_view>

namespace sublimit {

Color mix(const Color& a, const Color& b, double t) {
  Color c;
  for (int i = 0; i < 3; ++i) c[i] = a[i] + t * (b[i] - a[i]);
  return c;
}

Color ramp(const Color& base, double t) {
  const Color dark = mix({.09, .10, .19}, base, .20), light = mix({1, .985, .95}, base, .04);
  Color c;
  for (int i = 0; i < 3; ++i) {
    const double middle = 2 * base[i] - (dark[i] + light[i]) / 2;  // the parabola passes through the colour at 1/2
    c[i] = std::clamp((1 - t) * (1 - t) * dark[i] + 2 * t * (1 - t) * middle + t * t * light[i], 0., 1.);
  }
  return c;
}

std::string hex(const Color& color) {
  constexpr std::string_view digits = "0123456789abcdef";
  std::string text = "#";
  for (double c : color) {
    const int byte = static_cast<int>(std::lround(255 * c));
    text += digits[byte / 16];
    text += digits[byte % 16];
  }
  return text;
}

}  // namespace sublimit
