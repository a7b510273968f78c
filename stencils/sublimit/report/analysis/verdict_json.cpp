// SPDX-License-Identifier: Apache-2.0
#include "sublimit/report/analysis/verdict_json.h"

#include <charconv>
#include <utility>

namespace sublimit::report {

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
