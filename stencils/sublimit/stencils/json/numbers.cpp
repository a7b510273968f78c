// SPDX-License-Identifier: Apache-2.0
#include "sublimit/stencils/json/numbers.h"

#include <charconv>
#include <cmath>

namespace sublimit::report {

Json drawn(double value, int digits) {
  if (!std::isfinite(value)) return nullptr;
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value, std::chars_format::scientific, digits - 1).ptr;
  double rounded = 0;
  std::from_chars(text, end, rounded);
  if (rounded == 0) rounded = 0;  // no minus
  if (rounded == std::trunc(rounded) && std::abs(rounded) < 1e6) return static_cast<long>(rounded);
  return rounded;
}

Json stated(double value) {
  if (!std::isfinite(value)) return nullptr;
  return value;
}

Json point(double x, double y) { return {drawn(x), drawn(y)}; }
Json point(double x, double y, double z) { return {drawn(x), drawn(y), drawn(z)}; }

Json to_json(const SectorLabel& label) {
  const auto half = [](int twice) { return twice % 2 == 0 ? Json(twice / 2) : Json(twice / 2.0); };
  return {label.sector, half(label.x2), half(label.y2)};
}

}  // namespace sublimit::report
