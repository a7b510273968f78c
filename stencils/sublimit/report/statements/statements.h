// SPDX-License-Identifier: Apache-2.0
#pragma once
// Sentences of lecture notes, each with the experiment that decides it: `statements` of report_format.md. Where a
// sentence stands, what it says and what is right are words; what becomes of it is computed every time.
#include <functional>
#include <span>

#include "sublimit/report/statements/finding.h"

namespace sublimit::report {

struct Statement {
  const char* where;
  const char* says;
  const char* right;  ///< empty where the sentence says it all
  std::function<Finding()> experiment;
};

/// All of them, in the order of the lecture notes.
std::span<const Statement> all_statements();

/// @note  Deterministic for any number of threads.
Json to_json(std::span<const Statement> statements);
inline Json statements_json() { return to_json(all_statements()); }

}  // namespace sublimit::report
