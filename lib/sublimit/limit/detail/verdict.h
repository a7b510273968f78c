// SPDX-License-Identifier: Apache-2.0
#pragma once
// What is known of a property, and why: a theorem, its hypotheses one by one, and what each of them rests on.
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sublimit {

struct Hypothesis {
  /// Arithmetic that the answer was computed in. Exact algebraic numbers and enclosures by balls prove it;
  /// floating-point numbers do not.
  enum class By { exact, enclosure, floating };
  std::string says;           ///< "eigenvalue 1 is simple"
  std::optional<bool> holds;  ///< nothing: not decided
  By by = By::floating;
  std::string value = {};  ///< the numbers that decided, as text
};

struct [[nodiscard]] Verdict {
  enum class Answer {
    proved,
    disproved,
    evidence_for,
    evidence_against,
    borderline,  ///< a Jordan case, or one that the theorem does not speak of
    unknown,
  };
  std::string property;  ///< a word of report_format.md: "c1", "curvature" ...
  std::string says;      ///< what is proved or disproved, a fragment: "C^1 at the extraordinary point"
  Answer answer = Answer::unknown;
  std::string theorem = {};  ///< with its source
  std::vector<Hypothesis> hypotheses = {};
  std::string because = {};  ///< one sentence, for people
  /// Further findings, each under the name that report_format.md has for it: {"curvature", "divergent"}.
  std::vector<std::pair<std::string, std::string>> findings = {};
  std::string witness = {};  ///< JSON for the checker; empty without one
};

/// The verdict that hypotheses allow which together are sufficient: proved if all hold without floating numbers; if one
/// fails, disproved where each is `necessary` too (by what the failing one rests on), else unknown. Without hypotheses
/// it is unknown.
Verdict::Answer answer_of(const std::vector<Hypothesis>& hypotheses, bool necessary);

std::string to_string(Verdict::Answer answer);
std::string to_string(Hypothesis::By by);

}  // namespace sublimit
