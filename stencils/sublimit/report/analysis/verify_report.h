// SPDX-License-Identifier: Apache-2.0
#pragma once
// Independent verification of a report. Witnesses are checked by a checker that shares only arithmetic with the
// prover, and their rows are compared with those of the registered scheme, if there is one.
#include <functional>
#include <string>
#include <vector>

namespace sublimit::report {

struct ReportVerification {
  std::string kind;                   ///< kind of the report: "schemes", "mesh", "curve", "sweep"
  int verdicts = 0;                   ///< number of verdicts on neighbourhoods and regular parts
  int seen_again = 0;                 ///< number of verdicts proved by a witness that the checker accepts
  int seen_with_scheme = 0;           ///< number of those whose rows equal the registered scheme's
  int masks_again = 0;                ///< regular parts and neighbourhoods whose masks were checked
  int by_nets = 0;                    ///< number of proofs of C^1 by refined nets, which have no witness
  int decided = 0;                    ///< number of other proofs and disproofs without a witness
  std::vector<std::string> findings;  ///< errors and where they are, in the order of the report
};

struct ReportVerificationOptions {
  /// If given, called by one thread at a time with the numbers of parts done and in all.
  std::function<void(int, int)> progress = {};
  /// True: analyse the masks of regular meshes again, which takes a second or two each. False: only compare
  /// them with those of the registered schemes.
  bool analyse_masks = true;
};

/// Verifies a report. Checks that
/// - witnesses prove their statements for the neighbourhoods that they belong to, and no proof of C^1 lacks one
/// (except
///   by refined nets);
/// - no verdict contradicts its own hypotheses;
/// - verdicts on convergence, tangent planes and C^1 agree with the spectra of a registered scheme's masks,
/// where these
///   decide;
/// - the regular part, the weights of neighbourhoods, the type (interpolating or not) and the verdicts on
/// claims follow
///   from the masks: those of the registered scheme, else those in the report;
/// - the summary agrees with the verdicts.
/// @param text  contents of report.json
/// @throws FormatError  not JSON, not a report, an unknown version or kind, a missing part
ReportVerification verify_report(const std::string& text, const ReportVerificationOptions& options = {});

}  // namespace sublimit::report
