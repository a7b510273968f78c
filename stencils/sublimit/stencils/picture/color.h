// SPDX-License-Identifier: Apache-2.0
#pragma once
// Colours of pictures, and the ramp from shadow to light through a base colour.
#include <array>
#include <string>

namespace sublimit {

/// Red, green, blue in 0..1 (sRGB).
using Color = std::array<double, 3>;

/// Returns the colour a at t = 0, b at t = 1, linear between them.
Color mix(const Color& a, const Color& b, double t);

/// Returns a colour of a smooth ramp from a cool shadow (t = 0) through the base colour to a warm white (t = 1).
Color ramp(const Color& base, double t);

/// Returns a colour in the notation of SVG and CSS: "#6b99b3".
std::string hex(const Color& color);

}  // namespace sublimit
