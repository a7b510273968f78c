// SPDX-License-Identifier: Apache-2.0
#include "sublimit/report/statements/finding.h"

#include <algorithm>

namespace sublimit::report {

Fate fate(const std::vector<bool>& is_so) {
  const auto yes = std::count(is_so.begin(), is_so.end(), true);
  if (yes == 0) return Fate::refuted;
  return yes == static_cast<std::ptrdiff_t>(is_so.size()) ? Fate::confirmed : Fate::depends;
}

Finding denied(Finding finding) {
  if (finding.fate != Fate::depends) finding.fate = fate(finding.fate == Fate::refuted);
  return finding;
}

Finding both(Finding a, const Finding& b) {
  if (a.fate != b.fate && a.fate != Fate::refuted) a.fate = b.fate == Fate::confirmed ? a.fate : b.fate;
  if (a.computed != b.computed) a.computed += "; " + b.computed;
  for (const auto& [name, value] : b.numbers.items()) a.numbers[name] = value;
  return a;
}

std::string to_string(Fate fate) {
  switch (fate) {
    case Fate::confirmed:
      return "confirmed";
    case Fate::refuted:
      return "refuted";
    default:
      return "depends";
  }
}

}  // namespace sublimit::report
