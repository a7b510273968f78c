// SPDX-License-Identifier: Apache-2.0
// Documents of fields: every kind, and what becomes of documents that are spoilt.
#include "sublimit/stencils/recipes/detail/field_recipe.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "stencils/recipes/field_samples.h"
#include "sublimit/base/error.h"
#include "sublimit/implicit/detail/field_grid.h"

namespace sublimit::testing {
namespace {

constexpr int sampled_cells = 6;

/// Samples the field as `implicit` does.
void sample(const FieldJob& job) {
  const Eigen::AlignedBox3d box = job.box ? *job.box : padded_extent(*job.field, sampled_cells);
  const FieldGrid grid = sample_field(*job.field, box, sampled_cells);
  for (const size_t at : {size_t{0}, grid.values.size() / 2, grid.values.size() - 1}) {
    const auto nx = size_t(grid.size[0]), ny = size_t(grid.size[1]);
    const FieldJet jet = job.field->jet(grid.place(int(at % nx), int(at / nx % ny), int(at / nx / ny)));
    EXPECT_TRUE(jet.order >= 0 && jet.order <= 2);
    constexpr double of_samples = 1e-9;  // grids are sampled in bulk, in another order
    EXPECT_NEAR(jet.value, grid.values[at], of_samples * std::max(1., std::abs(jet.value)));
  }
}

TEST(FieldRecipes, EveryDocumentIsAField) {
  for (const std::string& text : field_documents()) {
    SCOPED_TRACE(text);
    const FieldJob job = parse_field_job(text, "f.json");
    const std::vector<std::string> names = field_names();
    EXPECT_NE(std::ranges::find(names, job.name), names.end());
    EXPECT_NO_THROW(sample(job));
  }
}

TEST(FieldRecipes, SpoiltDocumentsAreRefusedOrAreFields) {
  std::mt19937 random(19);
  int fields = 0, refused = 0;
  for (int round = 0; round < 150; ++round)
    for (const std::string& document : field_documents()) {
      const std::string text = spoilt(document, random);
      SCOPED_TRACE(text);
      FieldJob job;
      try {
        job = parse_field_job(text, "f.json");
      } catch (const FormatError& error) {
        EXPECT_EQ(std::string(error.what()).substr(0, 7), "f.json:");
        ++refused;
        continue;
      }
      ++fields;
      try {
        sample(job);
      } catch (const InvalidParameter&) {  // nothing inside, too large for its box, not finite
      } catch (const ResourceError&) {
      }
    }
  EXPECT_GT(fields, 100);  // both happen
  EXPECT_GT(refused, 100);
}

}  // namespace
}  // namespace sublimit::testing
