// SPDX-License-Identifier: Apache-2.0
// A dictionary of patterns is of one scheme: levels of another are refused.
#include "sublimit/stencils/patterns/patterns.h"

#include <gtest/gtest.h>

#include "meshes/meshes.h"
#include "sublimit/scheme/refine.h"
#include "sublimit/schemes/schemes.h"
#include "support/expect_error.h"

namespace sublimit::testing {
namespace {

Piece whole_face(const Level& level) { return {.kind = Piece::Kind::quad, .start = level.topology().first(Face{0})}; }

TEST(Patterns, RefuseLevelsOfAnotherScheme) {
  const Scheme<double> scheme = *find_scheme("catmull-clark"), other = *find_scheme("bilinear");
  const std::vector<Level> own = refine(scheme, cube(), 1), theirs = refine(other, cube(), 1);
  Patterns patterns(scheme);
  const Patterns::Match match = patterns.match(own[1], whole_face(own[1]));
  for (const Level& level : theirs) {
    const auto parts = {std::string_view("'catmull-clark'"), std::string_view("'bilinear'")};
    Patterns::Match found;
    expect_error<InvalidParameter>([&] { (void)patterns.match(level, whole_face(level)); }, parts);
    expect_error<InvalidParameter>([&] { (void)patterns.find(level, whole_face(level), found); }, parts);
  }
  EXPECT_TRUE(match.pattern);
  EXPECT_NO_THROW((void)patterns.match(own[0], whole_face(own[0])));
  Patterns of_other(other);
  EXPECT_NO_THROW((void)of_other.match(theirs[1], whole_face(theirs[1])));
}

}  // namespace
}  // namespace sublimit::testing
