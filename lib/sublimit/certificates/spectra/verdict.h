// SPDX-License-Identifier: Apache-2.0
#pragma once
// Verdicts on mathematical properties with their reasons: a theorem, each of its hypotheses, and the arithmetic
// that decided it.
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sublimit {

/// A hypothesis of a theorem, with its answer.
struct Hypothesis {
  /// Arithmetic that the answer was computed in. Exact algebraic numbers and enclosures by balls prove it;
  /// floating-point numbers do not.
  enum class By { exact, enclosure, floating };
  std::string says;           ///< the statement: "eigenvalue 1 is simple"
  std::optional<bool> holds;  ///< nothing: undecided
  By by = By::floating;
  std::string value = {};  ///< the numbers that decided it, as text
};

/// An answer about a property.
struct [[nodiscard]] Verdict {
  enum class Answer {
    proved,
    disproved,
    evidence_for,
    evidence_against,
    borderline,  ///< a Jordan case, or one that the theorem does not cover
    unknown,
  };
  std::string property;  ///< name in report_format.md: "c1", "curvature" ...
  std::string says;      ///< the statement, a fragment: "C^1 at the extraordinary point"
  Answer answer = Answer::unknown;
  std::string theorem = {};  ///< theorem with its source
  std::vector<Hypothesis> hypotheses = {};
  std::string because = {};  ///< the reason in one sentence
  /// Further findings as name (see report_format.md) and value: {"curvature", "divergent"}.
  std::vector<std::pair<std::string, std::string>> findings = {};
  std::string witness = {};  ///< witness for the checker as JSON; empty if there is none
};

/// Returns the answer that follows from hypotheses which together are sufficient.
///
/// If all hold: `proved`, or `evidence_for` if floating-point numbers decided any of them. If one fails and
/// each is `necessary`: `disproved`, or `evidence_against` if floating-point numbers decided. Else, and without
/// hypotheses, `unknown`.
Verdict::Answer answer_of(const std::vector<Hypothesis>& hypotheses, bool necessary);

std::string to_string(Verdict::Answer answer);
std::string to_string(Hypothesis::By by);

}  // namespace sublimit
