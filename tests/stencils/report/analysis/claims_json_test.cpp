// SPDX-License-Identifier: Apache-2.0
// Claims of schemes against the report: one that is false by a single derivative is contradicted.
#include "sublimit/report/analysis/claims_json.h"

#include <gtest/gtest.h>

#include "stencils/summary_rows.h"
#include "sublimit/report/analysis/regular_json.h"
#include "sublimit/schemes/schemes.h"

namespace sublimit {
namespace {

using report::Json;

TEST(ClaimsJson, OneDerivativeTooManyIsContradicted) {
  // Exponents are whole numbers here, C^(k-1,1): they do not tell it.
  for (const char* name : {"catmull-clark", "doo-sabin", "butterfly", "kobbelt"}) {
    const Json scheme{{"regular", report::regular_json(name)}, {"neighborhoods", Json::array()}};
    Claims claims = find_scheme<double>(name)->claims;
    EXPECT_EQ(report::claims_json(claims, scheme)[0]["verdict"], "proved") << name;
    ++claims.regular;
    const Json claim = report::claims_json(claims, scheme)[0];
    EXPECT_EQ(claim["claim"], "regular");
    EXPECT_EQ(claim["verdict"], "disproved") << name << " " << claim.dump();
  }
}

/// A scheme of which this was found at valences 3, 4, ...: of C^1, and of convergence.
Json scheme_with(const std::vector<const char*>& c1, const std::vector<const char*>& convergence = {}) {
  Json neighborhoods = Json::array();
  for (size_t i = 0; i < c1.size(); ++i) {
    Json verdicts = Json::array({{{"property", "c1"}, {"verdict", c1[i]}}});
    if (i < convergence.size()) verdicts.push_back({{"property", "convergence"}, {"verdict", convergence[i]}});
    neighborhoods.push_back({{"kind", "vertex"}, {"n", 3 + i}, {"verdicts", verdicts}});
  }
  return {{"name", "own"}, {"mesh", "any"}, {"neighborhoods", neighborhoods}};
}

TEST(SummaryRow, NamesTheValencesThatItsVerdictHoldsFor) {
  const char *yes = "proved", *no = "disproved", *likely = "evidence-for", *open = "unknown";
  struct Case {
    Json scheme;
    const char *continuity, *verdict, *valences, *notes;
  };
  for (const Case& c :
       {Case{scheme_with({yes, yes, yes, yes}), "C^1", yes, "3-6", ""},
        // The butterfly.
        Case{scheme_with({no, yes, yes, yes, yes, no}), "C^1", yes, "4-7", "C^1 disproved at valence 3, 8"},
        // sqrt(3): regular vertices are proved.
        Case{scheme_with({likely, likely, likely, yes, likely}), "C^1", likely, "3-5, 7", "C^1 proved at valence 6"},
        Case{scheme_with({likely, yes}), "C^1", yes, "4", "C^1 evidence-for at valence 3"},
        Case{scheme_with({no, no, no, yes}), "C^1", yes, "6", "C^1 disproved at valence 3-5"},
        Case{scheme_with({no, open, no}, {yes, yes, open}), "C^0", yes, "3, 4",
             "C^0 unknown at valence 5; C^1 disproved at valence 3, 5; C^1 unknown at valence 4"},
        Case{scheme_with({no, no}), "C^0", open, "3, 4", "C^1 disproved at valence 3, 4"}}) {
    const Json row = report::summary_row(c.scheme);
    EXPECT_EQ(row["extraordinary"], c.continuity);
    EXPECT_EQ(row["extraordinary_verdict"], c.verdict);
    EXPECT_EQ(row["valences"], c.valences);
    EXPECT_EQ(row["notes"], c.notes);
    testing::expect_rows_name_their_valences({{"schemes", {c.scheme}}, {"summary", {row}}});
  }
  EXPECT_EQ(report::summary_row(scheme_with({}))["valences"], "");
}

TEST(SummaryRow, VerdictOnRegularMeshesIsThatOfTheContinuityBesideIt) {
  const auto verdict = [](const char* property, const char* says, const char* answer) {
    return Json{{"property", property}, {"says", says}, {"verdict", answer}};
  };
  Json scheme = scheme_with({});
  Json& regular = scheme["regular"];
  regular = {
      {"smoothness", {{"continuity", 0}}},
      {"verdicts",
       {verdict("convergence", "the levels converge", "proved"), verdict("regular-smoothness", "C^1", "disproved")}}};
  EXPECT_EQ(report::summary_row(scheme)["regular"], "C^0");  // bilinear
  EXPECT_EQ(report::summary_row(scheme)["regular_verdict"], "proved");
  regular["smoothness"]["continuity"] = 1;
  regular["verdicts"] = {verdict("regular-smoothness", "C^1", "evidence-for"),
                         verdict("regular-smoothness", "C^2", "disproved")};
  EXPECT_EQ(report::summary_row(scheme)["regular_verdict"], "evidence-for");
}

}  // namespace
}  // namespace sublimit
