// SPDX-License-Identifier: Apache-2.0
#pragma once
// A report, read with suspicion: every witness in it goes through the checker, which shares nothing with the prover but
// arithmetic, and its rows are held against the scheme's file where the registry has the scheme.
#include <functional>
#include <string>
#include <vector>

namespace sublimit::report {

struct ReportVerification {
  std::string kind;                   ///< kind of the report: "schemes", "mesh", "curve", "sweep"
  int verdicts = 0;                   ///< number of verdicts on neighbourhoods and regular parts
  int seen_again = 0;                 ///< proved by a witness that the checker accepts
  int seen_with_scheme = 0;           ///< number of those whose rows equal the registered scheme's
  int masks_again = 0;                ///< regular parts and neighbourhoods whose masks were looked at again
  int by_nets = 0;                    ///< C^1 proved by refined nets, of which there are no witnesses
  int decided = 0;                    ///< other verdicts that say proved or disproved, and carry no witness
  std::vector<std::string> findings;  ///< errors and where they are, in the order of the report
};

struct ReportVerificationOptions {
  /// Parts done and parts in all; by one thread at a time.
  std::function<void(int, int)> progress = {};
  /// Analyse the masks of regular meshes once more, which takes a second or two each; else they are only compared with
  /// those of the schemes' files.
  bool analyse_masks = true;
};

/// Checks that witnesses prove what they say, at the neighbourhood that they stand in; that C^1 is nowhere said to be
/// proved without one; that no verdict contradicts its own hypotheses; that convergence, tangent planes and C^1 are
/// what the spectra of a registered scheme's masks say, where these decide; that the regular part, the weights of
/// neighbourhoods, the type (interpolating or not) and what became of claims are what masks give, those of the scheme's
/// file if the registry has it, else those in the report; and that the summary says what the verdicts do.
/// @param text  of report.json
/// @throws FormatError  no JSON, no report, a version or a kind that is not known, a part that is missing
ReportVerification verify_report(const std::string& text, const ReportVerificationOptions& options = {});

}  // namespace sublimit::report
