// SPDX-License-Identifier: Apache-2.0
#pragma once
// A report, read with suspicion: every witness in it goes through the checker, which shares nothing with the prover but
// arithmetic, and its rows are held against the scheme's file where the registry has the scheme.
#include <functional>
#include <string>
#include <vector>

namespace sublimit::report {

struct ReportVerification {
  std::string kind;                   ///< of the report: "schemes", "mesh", "curve", "sweep"
  int verdicts = 0;                   ///< of all neighbourhoods and regular parts
  int seen_again = 0;                 ///< proved by a witness that the checker accepts
  int seen_with_scheme = 0;           ///< of these, those whose rows are the registered scheme's too
  int by_nets = 0;                    ///< C^1 proved by refined nets, of which there are no witnesses
  int decided = 0;                    ///< other verdicts that say proved or disproved, and carry no witness
  std::vector<std::string> findings;  ///< what is wrong and where, in the order of the report; empty: nothing
};

/// Checks that witnesses prove what they say, at the neighbourhood that they stand in; that C^1 is nowhere said to be
/// proved without one; that no verdict contradicts its own hypotheses; and that the summary says what the verdicts do.
/// @param text      of report.json
/// @param progress  witnesses done and witnesses in all; by one thread at a time
/// @throws FormatError  no JSON, no report, a version or a kind that is not known, a part that is missing
ReportVerification verify_report(const std::string& text, const std::function<void(int, int)>& progress = {});

}  // namespace sublimit::report
