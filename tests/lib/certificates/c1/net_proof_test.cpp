// SPDX-License-Identifier: Apache-2.0
// C^1 of schemes whose limits are no polynomials.
#include <gtest/gtest.h>

#include "sublimit/certificates/c1/c1_certificate.h"
#include "sublimit/certificates/spectra/exact_schemes.h"

namespace sublimit {
namespace {

TEST(DerivativeTail, BoundsDerivativesOfKnownLimits) {
  // Of x^2 all second differences along e1, e1 are 2 (steps of 1), and the derivative at the far end of a piece is 2,
  // the difference 1: no bound below 1/2 of them could be true.
  for (const char* name : {"catmull-clark", "kobbelt"}) {
    const auto tail = derivative_tail(regular_mask(*find_scheme<Algebraic>(name)));
    ASSERT_TRUE(tail) << name;
    EXPECT_TRUE(certainly_less(tail->contraction, Ball(1))) << name;
    EXPECT_GE(tail->factor[0].upper(), 0.5) << name;
  }
  // Bicubic splines: each of the second differences has the norm 1/4 in a step, twice that is 1/2.
  EXPECT_EQ(derivative_tail(regular_mask(*find_scheme<Algebraic>("catmull-clark")), 1)->contraction.mid(), 0.5);
}

TEST(DerivativeTail, IsNotFoundForSchemesThatAreNotC1) {
  EXPECT_FALSE(derivative_tail(regular_mask(*find_scheme<Algebraic>("bilinear"))));
}

TEST(NetProof, ProvesInterpolatingSchemes) {
  for (const char* name : {"butterfly", "modified-butterfly", "kobbelt"}) {
    C1Prover prover(*find_scheme<Algebraic>(name));
    for (const int n : {5, 6, 7}) {
      const C1Certificate c = prover.certify(n);
      EXPECT_EQ(to_string(c.verdict.answer), "proved") << name << " " << n;
    }
  }
}

TEST(NetProof, AgreesWithPolynomials) {
  // The bound of the nets must lie below the determinants that the polynomials have.
  C1Prover prover(*find_scheme<Algebraic>("catmull-clark"));
  C1Certificate c = prover.certify(5);
  const auto tail = derivative_tail(prover.mask());
  const auto ring = regular_ring(c.patch, tail->pieces);
  ASSERT_TRUE(ring);
  const MapProof nets = prove_map(*c.map, *tail, *ring, 7),
                 splines = prove_map(*c.map, *prover.pieces(), prover.functions(), *ring);
  EXPECT_EQ(nets.regular, MapProof::Regular::yes);
  EXPECT_EQ(splines.regular, MapProof::Regular::yes);
  EXPECT_LE(nets.least.lower(), splines.greatest.upper());
  EXPECT_GE(nets.greatest.upper(), splines.least.lower());
  EXPECT_FALSE(nets.winds_once) << "the net of a spline is not on it";
}

TEST(NetProof, LeavesOthersToEvidence) {
  C1Prover prover(*find_scheme<Algebraic>("sqrt3"));
  const C1Certificate c = prover.certify(5);
  EXPECT_EQ(to_string(c.verdict.answer), "evidence-for");
  EXPECT_EQ(to_string(c.verdict.hypotheses.back().by), "floating");
}

TEST(NetProof, DoesNotProveWhatTheSpectrumForbids) {
  C1Prover prover(*find_scheme<Algebraic>("butterfly"));
  for (const int n : {3, 8, 9}) EXPECT_EQ(to_string(prover.certify(n).verdict.answer), "unknown") << n;
}

}  // namespace
}  // namespace sublimit
