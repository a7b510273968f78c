// SPDX-License-Identifier: Apache-2.0
#include "sublimit/certificates/spectra/mirror.h"

#include <gtest/gtest.h>

#include "lib/certificates/spectra/exact_analyses.h"
#include "sublimit/certificates/spectra/dart.h"

namespace sublimit {
namespace {

TEST(Mirror, ImagesOfImagesAreTheLabelsThemselves) {
  for (const auto& [scheme, closed] : {std::pair{"catmull-clark", false}, {"catmull-clark", true}, {"loop", true}}) {
    const Scheme<Algebraic> exact = find_scheme<Algebraic>(scheme).value();
    const LocalPatch<Algebraic> patch =
        closed ? dart_patch(exact, 5, 2).value() : local_patch(exact, {.faces = 5, .open = true}, 2).value();
    for (const SectorLabel& label : patch.labels) EXPECT_EQ(mirrored(mirrored(label, 5, closed), 5, closed), label);
    EXPECT_EQ(mirrored({1, 2, 0}, 5, closed), (SectorLabel{4, 2, 0}));
    EXPECT_EQ(mirrored({0, 4, 2}, 5, closed), (SectorLabel{4, 2, 4}));
    EXPECT_EQ(mirrored({0, 2, 0}, 5, closed), (SectorLabel{closed ? 0 : 5, 2, 0}));
  }
}

TEST(Mirror, HalvesHaveTheSpectrumOfTheWhole) {
  for (const char* name : {"catmull-clark", "loop", "butterfly"}) {
    const ExactAnalysis analysis =
        testing::analyzed(find_scheme<Algebraic>(name).value(), {.faces = 4, .open = true}, 1);
    ASSERT_EQ(analysis.spectrum.blocks.blocks.size(), 2u) << name;
    for (const ExactEigenvalue& whole : exact_eigenvalues(analysis.patch.A)) {
      int multiplicity = 0, largest = 0, geometric = 0;
      for (const ExactEigenvalue& half : analysis.spectrum.values)
        if (half.value == whole.value) {
          multiplicity += half.multiplicity;
          geometric += half.geometric();
          largest = std::max(largest, half.largest_jordan());
        }
      EXPECT_EQ(multiplicity, whole.multiplicity) << name << ", " << whole.value.text();
      EXPECT_EQ(geometric, whole.geometric()) << name << ", " << whole.value.text();
      EXPECT_EQ(largest, whole.largest_jordan()) << name << ", " << whole.value.text();
    }
  }
}

TEST(Mirror, LopsidedMatricesHaveNone) {
  LocalPatch<Algebraic> patch = local_patch(find_scheme<Algebraic>("loop").value(), {.faces = 4, .open = true}).value();
  EXPECT_TRUE(mirror_rows(patch));
  patch.A(0, 1) += Algebraic::ratio(1, 1'000'000);
  EXPECT_FALSE(mirror_rows(patch));
  EXPECT_EQ(exact_blocks(patch).blocks.size(), 1u);
}

}  // namespace
}  // namespace sublimit
