// SPDX-License-Identifier: Apache-2.0
// Claims of schemes against the report: one that is false by a single derivative is contradicted.
#include "sublimit/report/analysis/claims_json.h"

#include <gtest/gtest.h>

#include "sublimit/report/analysis/regular_json.h"
#include "sublimit/schemes.h"

namespace sublimit {
namespace {

using report::Json;

TEST(ClaimsJson, OneDerivativeTooManyIsContradicted) {
  // Exponents are whole numbers here, C^(k-1,1): they do not tell it.
  for (const char* name : {"catmull-clark", "doo-sabin", "butterfly", "kobbelt"}) {
    const Json scheme{{"regular", report::regular_json(name)}, {"neighborhoods", Json::array()}};
    Claims claims = find_scheme<double>(name)->claims;
    EXPECT_EQ(report::claims_json(claims, scheme, {})[0]["verdict"], "proved") << name;
    ++claims.regular;
    const Json claim = report::claims_json(claims, scheme, {})[0];
    EXPECT_EQ(claim["claim"], "regular");
    EXPECT_EQ(claim["verdict"], "disproved") << name << " " << claim.dump();
  }
}

}  // namespace
}  // namespace sublimit
