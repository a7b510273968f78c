// SPDX-License-Identifier: Apache-2.0
#include "sublimit/certificates/c1/regular_pieces.h"
#include "sublimit/certificates/spectra/exact_schemes.h"

#include <gtest/gtest.h>

namespace sublimit {
namespace {

std::optional<RegularPieces> pieces_of(const std::string& name, const SchemeOptions& options = {}) {
  return regular_pieces(regular_mask(*find_scheme<Algebraic>(name, options)));
}

TEST(RegularPieces, AreThoseOfTheSplinesThatSchemesGeneralise) {
  struct Known {
    const char* name;
    size_t pieces;
    int degree, continuity;
    size_t controls;
  };
  // Bicubic and biquadratic B-splines, the quartic box spline, the element of Zwart and Powell.
  for (const Known& k :
       {Known{"catmull-clark", 1, 3, 2, 16}, Known{"loop", 2, 4, 2, 12}, Known{"doo-sabin", 1, 2, 1, 9},
        Known{"mid-edge", 4, 2, 1, 7}, Known{"bilinear", 1, 1, 0, 4}}) {
    const auto found = pieces_of(k.name);
    ASSERT_TRUE(found) << k.name;
    EXPECT_EQ(found->pieces.size(), k.pieces) << k.name;
    EXPECT_EQ(found->degree, k.degree) << k.name;
    EXPECT_EQ(found->continuity, k.continuity) << k.name;
    EXPECT_EQ(found->pieces[0].controls.size(), k.controls) << k.name;
  }
}

TEST(RegularPieces, OfRepeatedAveragingHaveItsDegree) {
  const auto found = pieces_of("averaging", {{"degree", "4"}});
  ASSERT_TRUE(found);
  EXPECT_EQ(found->degree, 4);
  EXPECT_EQ(found->continuity, 3);
  // The middle weight of a quartic B-spline at a knot is 11/24, so the corner of a piece has (11/24)^2.
  Algebraic greatest;
  for (const auto& f : found->pieces[0].functions)
    if (static_cast<double>(f(0, 0)) > static_cast<double>(greatest)) greatest = f(0, 0);
  EXPECT_EQ(greatest.text(), "121/576");
}

TEST(RegularPieces, AreNotFoundWhereThereAreNone) {
  for (const char* name : {"butterfly", "sqrt3"}) EXPECT_FALSE(pieces_of(name)) << name;
}

TEST(RegularPieces, OfAMaskThatIsSlightlyOffAreNotFound) {
  RegularMask<Algebraic> mask = regular_mask(*find_scheme<Algebraic>("catmull-clark"));
  ASSERT_TRUE(regular_pieces(mask));
  // Rows still sum to one, and the mask keeps its support.
  mask.weights[{0, 0}] += Algebraic::ratio(1, 1000000);
  mask.weights[{2, 0}] -= Algebraic::ratio(1, 1000000);
  EXPECT_FALSE(regular_pieces(mask));
}

}  // namespace
}  // namespace sublimit
