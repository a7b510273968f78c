// SPDX-License-Identifier: Apache-2.0
#include "sublimit/stencils/files/numbers.h"

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

Json to_json(const Verdict& verdict) {
  Json hypotheses = Json::array();
  for (const Hypothesis& h : verdict.hypotheses)
    hypotheses.push_back({{"says", h.says},
                          {"holds", h.holds ? Json(*h.holds) : Json(nullptr)},
                          {"by", to_string(h.by)},
                          {"value", h.value}});
  Json json{{"property", verdict.property}, {"says", verdict.says}, {"verdict", to_string(verdict.answer)}};
  for (const auto& [name, value] : verdict.findings) {
    // Numbers stay numbers.
    double number = 0;
    const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), number);
    json[name] = error == std::errc() && end == value.data() + value.size() ? Json(number) : Json(value);
  }
  json["theorem"] = verdict.theorem;
  json["hypotheses"] = std::move(hypotheses);
  json["because"] = verdict.because;
  json["witness"] = verdict.witness.empty() ? Json(nullptr) : Json::parse(verdict.witness);
  return json;
}

}  // namespace sublimit::report
