// SPDX-License-Identifier: Apache-2.0
#pragma once
// Comparison of the rows of a report's summary with the verdicts that they summarise.
#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>
#include <string>

namespace sublimit::testing {

/// Adds a verdict at valences like "3, 8-12". Fails if a valence has a verdict already.
inline void add_valences(std::map<int, std::string>& verdicts, const std::string& valences,
                         const std::string& verdict) {
  static const std::regex range(R"((\d+)(?:-(\d+))?)");
  for (std::sregex_iterator at(valences.begin(), valences.end(), range), end; at != end; ++at) {
    const int first = std::stoi((*at)[1]), last = (*at)[2].matched ? std::stoi((*at)[2]) : first;
    for (int n = first; n <= last; ++n)
      EXPECT_TRUE(verdicts.try_emplace(n, verdict).second) << "two verdicts at valence " << n;
  }
}

/// Returns the verdicts of a row on "C^1" or "C^0", by valence.
inline std::map<int, std::string> verdicts_of_row(const nlohmann::ordered_json& row, const std::string& continuity) {
  std::map<int, std::string> verdicts;
  if (row["extraordinary"] == continuity) add_valences(verdicts, row["valences"], row["extraordinary_verdict"]);
  static const std::regex note(R"((C\^\d) (\S+) at valence (.*))");
  std::istringstream notes(row["notes"].get<std::string>());
  for (std::string text; std::getline(notes, text, ';');) {
    std::smatch parts;
    if (std::regex_search(text, parts, note) && parts[1] == continuity) add_valences(verdicts, parts[3], parts[2]);
  }
  return verdicts;
}

/// Returns the verdicts of a scheme's neighbourhoods on a property, by valence; "unknown" without a verdict.
inline std::map<int, std::string> verdicts_of_scheme(const nlohmann::ordered_json& scheme,
                                                     const std::string& property) {
  std::map<int, std::string> verdicts;
  for (const auto& n : scheme["neighborhoods"]) {
    if (n["kind"] != "vertex" && n["kind"] != "face") continue;
    std::string& verdict = verdicts[n["n"]] = "unknown";
    for (const auto& v : n["verdicts"])
      if (v["property"] == property) verdict = v["verdict"];
  }
  return verdicts;
}

/// Expects that every row of a report gives each verdict for exactly the valences that have it.
inline void expect_rows_name_their_valences(const nlohmann::ordered_json& report) {
  ASSERT_EQ(report["summary"].size(), report["schemes"].size());
  ASSERT_GT(report["summary"].size(), 0u);
  for (size_t i = 0; i < report["summary"].size(); ++i) {
    const nlohmann::ordered_json &row = report["summary"][i], &scheme = report["schemes"][i];
    SCOPED_TRACE(row.dump());
    EXPECT_EQ(verdicts_of_row(row, "C^1"), verdicts_of_scheme(scheme, "c1"));
    EXPECT_NE(row["regular_verdict"], "disproved");  // of the continuity that is shown
    if (row["extraordinary"] == "C^0") {
      EXPECT_EQ(verdicts_of_row(row, "C^0"), verdicts_of_scheme(scheme, "convergence"));
    }
  }
}

}  // namespace sublimit::testing
