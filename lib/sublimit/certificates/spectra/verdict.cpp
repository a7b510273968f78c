// SPDX-License-Identifier: Apache-2.0
#include "sublimit/certificates/spectra/verdict.h"

#include <algorithm>

namespace sublimit {

Verdict::Answer answer_of(const std::vector<Hypothesis>& hypotheses, bool necessary) {
  using Answer = Verdict::Answer;
  if (hypotheses.empty()) return Answer::unknown;
  const auto is_firm = [](const Hypothesis& h) { return h.by != Hypothesis::By::floating; };
  const auto fails = [](const Hypothesis& h) { return h.holds == false; };
  if (std::any_of(hypotheses.begin(), hypotheses.end(), fails)) {
    if (!necessary) return Answer::unknown;
    const bool firmly =
        std::any_of(hypotheses.begin(), hypotheses.end(), [&](const Hypothesis& h) { return fails(h) && is_firm(h); });
    return firmly ? Answer::disproved : Answer::evidence_against;
  }
  if (std::any_of(hypotheses.begin(), hypotheses.end(), [](const Hypothesis& h) { return !h.holds; }))
    return Answer::unknown;
  return std::all_of(hypotheses.begin(), hypotheses.end(), is_firm) ? Answer::proved : Answer::evidence_for;
}

std::string to_string(Verdict::Answer answer) {
  switch (answer) {
    case Verdict::Answer::proved:
      return "proved";
    case Verdict::Answer::disproved:
      return "disproved";
    case Verdict::Answer::evidence_for:
      return "evidence-for";
    case Verdict::Answer::evidence_against:
      return "evidence-against";
    case Verdict::Answer::borderline:
      return "borderline";
    default:
      return "unknown";
  }
}

std::string to_string(Hypothesis::By by) {
  return by == Hypothesis::By::exact ? "exact" : by == Hypothesis::By::enclosure ? "enclosure" : "floating";
}

}  // namespace sublimit
