// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "sublimit/base/version.h"
#include "sublimit/stencils/json/numbers.h"

namespace sublimit::report {
namespace {

/// Objects with no other object in them, and arrays of numbers, stay on one line.
bool is_small(const Json& json) {
  if (!json.is_structured()) return true;
  if (json.is_array() && !json.empty() && json.front().is_object()) return false;
  if (json.is_object() && json.size() > 8) return false;
  return std::all_of(json.begin(), json.end(), [](const Json& part) { return !part.is_object() && is_small(part); });
}

void write(const Json& json, std::string indent, std::string& out) {
  if (is_small(json)) {
    out += json.dump();
    return;
  }
  const bool is_object = json.is_object();
  out += is_object ? "{" : "[";
  const std::string inner = indent + " ";
  bool first = true;
  for (auto it = json.begin(); it != json.end(); ++it) {
    out += first ? "\n" : ",\n";
    out += inner;
    if (is_object) out += Json(it.key()).dump() + ": ";
    write(*it, inner, out);
    first = false;
  }
  out += "\n" + indent + (is_object ? "}" : "]");
}

}  // namespace

Json report_head(const std::string& kind) {
  return {{"format", "sublimit-report"}, {"version", 1}, {"program", SUBLIMIT_VERSION}, {"kind", kind}};
}

std::string report_text(const Json& report) {
  std::string text;
  write(report, "", text);
  return text + "\n";
}

}  // namespace sublimit::report
