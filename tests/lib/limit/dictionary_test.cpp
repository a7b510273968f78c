// SPDX-License-Identifier: Apache-2.0
// A dictionary of types is of one scheme: with levels or surfaces of another it is refused, whatever the schemes claim.
#include <gtest/gtest.h>

#include "meshes/meshes.h"
#include "sublimit/limit/detail/limit_cache.h"
#include "sublimit/limit/detail/limit_points.h"
#include "sublimit/limit/detail/limit_rows.h"
#include "sublimit/schemes/schemes.h"
#include "sublimit/surface/limit_map.h"
#include "support/expect_error.h"

namespace sublimit::testing {
namespace {

void expect_refused(const Scheme<double>& scheme, const Scheme<double>& other, const Mesh& mesh,
                    std::initializer_list<std::string_view> parts) {
  const auto types = std::make_shared<LimitCache>(other);
  expect_error<InvalidParameter>([&] { LimitMap(scheme, mesh, {}, types); }, parts);
  const std::vector<Level> levels = refine(scheme, mesh, 2);
  for (const Level& level : levels) expect_error<InvalidParameter>([&] { limit_matrices(level, *types); }, parts);
  expect_error<InvalidParameter>([&] { limit_matrices(levels, *types); }, parts);
  expect_error<InvalidParameter>([&] { LimitMap(scheme, levels[2], types); }, parts);
  expect_error<InvalidParameter>([&] { LimitMap(other, levels[2]); }, parts);
}

TEST(LimitDictionary, OfAnotherSchemeIsRefused) {
  expect_refused(*find_scheme("catmull-clark"), *find_scheme("bilinear"), cube(), {"'catmull-clark'", "'bilinear'"});
  expect_refused(*find_scheme("loop"), *find_scheme("loop-warren"), icosahedron(), {"'loop'", "'loop-warren'"});
  expect_refused(*find_scheme("doo-sabin"), *find_scheme("doo-sabin-averaging"), cube(), {"'doo-sabin'"});
}

TEST(LimitDictionary, OfOtherOptionsIsRefused) {
  expect_refused(*find_scheme("kobbelt"), *find_scheme("kobbelt", {{"tension", "1/2"}}), cube(), {"tension=1/2"});
}

TEST(LimitDictionary, OfOtherMasksUnderTheSameNameIsRefused) {
  const auto tense = [](double w) {
    Scheme<double> scheme = *find_scheme("catmull-clark");
    scheme.steps[0].masks.face = [w](const FaceSite<double>& f) {
      return f.centroid() + w * (f.corner(0) - f.corner(2));
    };
    return scheme;
  };
  expect_refused(tense(0), tense(1e-9), cube(), {"a scheme of this name with other masks"});
}

TEST(LimitDictionary, OfTheSameSchemeMadeAgainIsTaken) {
  for (const Scheme<double>& scheme : all_schemes()) {
    const Mesh mesh = scheme.face_size() == 3 ? icosahedron() : prism(5);
    const auto types = std::make_shared<LimitCache>(*find_scheme(scheme.name));
    const std::vector<Level> levels = refine(scheme, mesh, 2);
    EXPECT_NO_THROW(limit_matrices(levels, *types)) << scheme.name;
    EXPECT_NO_THROW(LimitMap(scheme, mesh, {}, types)) << scheme.name;
    EXPECT_NO_THROW(LimitMap(scheme, levels[2], types)) << scheme.name;
  }
}

TEST(LimitDictionary, OfALevelThatTwoSchemesMadeIsOfTheLast) {
  const Scheme<double> first = *find_scheme("bilinear"), last = *find_scheme("catmull-clark");
  std::vector<Level> levels = refine(first, cube(), 1);
  levels = refine(last, levels[1], 1);
  LimitCache of_first(first), of_last(last);
  EXPECT_NO_THROW(limit_matrices(levels[1], of_last));
  expect_error<InvalidParameter>([&] { limit_matrices(levels[1], of_first); }, {"'bilinear'", "'catmull-clark'"});
}

}  // namespace
}  // namespace sublimit::testing
