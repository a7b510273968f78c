// SPDX-License-Identifier: Apache-2.0
#include "sublimit/certificates/c1/c1_certificate.h"
#include "sublimit/certificates/spectra/exact_schemes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "sublimit/schemes/doo_sabin.h"
#include "truth/precise_schemes.h"

namespace sublimit {
namespace {

using Answer = Verdict::Answer;
using testing::Precise;

Precise midpoint(const Ball& b) {
  Precise x;
  arf_get_mpfr(x.backend().data(), arb_midref(b.get()), MPFR_RNDN);
  return x;
}

/// The value of 256-bit arithmetic, give or take its own last digits, lies in the ball.
bool encloses(const Ball& b, const Precise& x) {
  return abs(midpoint(b) - x) <= Precise(b.radius()) + Precise("1e-70");
}

const Hypothesis* failed(const Verdict& v) {
  for (const Hypothesis& h : v.hypotheses)
    if (h.holds == false) return &h;
  return nullptr;
}

TEST(C1Certificate, ProvesPolynomialSchemes) {
  for (const char* name : {"catmull-clark", "loop", "loop-warren", "doo-sabin", "doo-sabin-averaging", "mid-edge",
                           "mid-edge-habib-warren"}) {
    C1Prover prover(*find_scheme<Algebraic>(name));
    for (const int n : {3, 4, 5, 7, 12}) {
      if (name == std::string("mid-edge") && n == 3) continue;
      const C1Certificate c = prover.certify(n);
      EXPECT_EQ(to_string(c.verdict.answer), "proved") << name << " " << n;
      EXPECT_TRUE(certainly_positive(c.proof->least)) << name << " " << n;
    }
  }
}

TEST(C1Certificate, ProvesRepeatedAveragingOfEveryDegreeAsked) {
  for (const char* degree : {"2", "3", "4", "5"}) {
    C1Prover prover(*find_scheme<Algebraic>("averaging", {{"degree", degree}}));
    for (const int n : {3, 5}) EXPECT_EQ(to_string(prover.certify(n).verdict.answer), "proved") << degree << " " << n;
  }
}

TEST(C1Certificate, DoesNotDisproveWhatItDoesNotSpeakOf) {
  // Faces of five corners: block 1 has the eigenvalue -1/2, simple and dominant. Two steps have a positive one, so that
  // the theorem's lambda > 0 is no necessary condition.
  const auto scheme = doo_sabin_with<Algebraic>("negative", "", [](const FaceSite<Algebraic>& f, int j) {
    const int n = f.size();
    const Algebraic one = f.ratio(1, n), c = f.cos_2pi(j, n);
    return n == 4 ? (j == 0 ? f.ratio(9, 16) : f.ratio(j == 2 ? 1 : 3, 16)) : one - c * one;
  });
  const C1Certificate c = C1Prover(scheme).certify(5);
  ASSERT_TRUE(c.map);
  EXPECT_TRUE(certainly_negative(c.map->lambda.re()));
  EXPECT_EQ(to_string(c.verdict.answer), "unknown");
}

TEST(C1Certificate, LeavesTheJordanCaseOpen) {
  C1Prover prover(*find_scheme<Algebraic>("mid-edge"));
  EXPECT_EQ(to_string(prover.certify(3).verdict.answer), "unknown");
}

TEST(C1Certificate, EnclosesTheNetOf256Bits) {
  for (const char* name : {"catmull-clark", "loop", "mid-edge"}) {
    const int n = 5;
    C1Prover prover(*find_scheme<Algebraic>(name));
    C1Certificate c = prover.certify(n);
    ASSERT_TRUE(c.map);
    // The power method on block 1: after each step the other sectors are sector 0 turned, lest other blocks creep in.
    const auto scheme = *find_scheme<Precise>(name);
    const auto patch = *local_patch(scheme, c.patch.type, 2);
    const auto size = patch.A.rows();
    std::map<SectorLabel, Eigen::Index> at;
    for (Eigen::Index i = 0; i < size; ++i) at[patch.labels[static_cast<size_t>(i)]] = i;
    const auto is_middle = [](const SectorLabel& l) { return l.sector == 0 && l.x2 > 0 && l.x2 == l.y2; };
    const Eigen::Index one =
        std::find_if(at.begin(), at.end(), [&](const auto& p) { return is_middle(p.first); })->second;
    DenseMatrix<Precise> z(size, 2);
    for (Eigen::Index i = 0; i < size; ++i) {
      z(i, 0) = patch.labels[static_cast<size_t>(i)].x2;
      z(i, 1) = patch.labels[static_cast<size_t>(i)].y2;
    }
    Precise lambda = 0;
    for (int k = 0; k < 300; ++k) {
      const DenseMatrix<Precise> own = z;
      for (const auto& [l, i] : at) {
        const Precise co = Number<Precise>::cos_2pi(l.sector, n),
                      si = Number<Precise>::cos_2pi(4 * l.sector - n, 4 * n);
        const Eigen::Index from = at.at({0, l.x2, l.y2});
        const bool centre = l.x2 == 0 && l.y2 == 0;
        z(i, 0) = centre ? Precise(0) : Precise(co * own(from, 0) - si * own(from, 1));
        z(i, 1) = centre ? Precise(0) : Precise(si * own(from, 0) + co * own(from, 1));
      }
      const DenseMatrix<Precise> next = patch.A * z;
      lambda = next(one, 0) / z(one, 0);
      z = next / lambda;
    }
    const Precise x = z(one, 0), y = z(one, 1), r = x * x + y * y;
    for (Eigen::Index i = 0; i < size; ++i) {
      const SectorLabel& l = patch.labels[static_cast<size_t>(i)];
      if (l.sector != 0) continue;
      const auto ball = c.map->at({l.x2, l.y2});
      ASSERT_TRUE(ball);
      EXPECT_TRUE(encloses(ball->re(), (z(i, 0) * x + z(i, 1) * y) / r)) << name << " " << l.x2 << " " << l.y2;
      EXPECT_TRUE(encloses(ball->im(), (z(i, 1) * x - z(i, 0) * y) / r)) << name << " " << l.x2 << " " << l.y2;
    }
  }
}

/// Doo-Sabin with any subdominant eigenvalue p/q: rings of n corners have 1, p/q twice, and 0.
Scheme<Algebraic> doo_sabin_with_lambda(int p, int q) {
  return doo_sabin_with<Algebraic>("doo-sabin with a lambda", "", [=](const FaceSite<Algebraic>& f, int j) {
    const int n = f.size();
    if (n == 4) return f.ratio(j == 0 ? 9 : j == 2 ? 1 : 3, 16);
    return (Algebraic(1) + 2 * f.ratio(p, q) * f.cos_2pi(j, n)) / n;
  });
}

// Peters, Reif 1998, section 5: these maps are regular exactly where 128 l^2 (1 - l) - 7 l - 2 + 9 l cos(2 pi/n) > 0.
TEST(C1Certificate, SeesMapsFoldWhereTheClosedFormSaysSo) {
  for (const int n : {3, 5, 9})
    for (const int percent : {30, 60, 80, 86, 90, 95, 99}) {
      C1Prover prover(doo_sabin_with_lambda(percent, 100));
      const Verdict v = prover.certify(n).verdict;
      const double l = percent / 100.0, c = Number<double>::cos_2pi(1, n);
      const bool regular = 128 * l * l * (1 - l) - 7 * l - 2 + 9 * l * c > 0;
      EXPECT_EQ(to_string(v.answer), regular ? "proved" : "disproved") << n << " " << percent;
      if (regular) continue;
      ASSERT_TRUE(failed(v));
      EXPECT_EQ(failed(v)->says, "the Jacobian determinant of the characteristic map is positive");
    }
}

TEST(C1Certificate, DisprovesSchemesThatAreNotEvenRegularlySmooth) {
  C1Prover prover(*find_scheme<Algebraic>("bilinear"));
  const Verdict v = prover.certify(5).verdict;
  EXPECT_EQ(to_string(v.answer), "disproved");
  EXPECT_EQ(failed(v)->says, "the regular limit consists of polynomials and is C^1");
}

}  // namespace
}  // namespace sublimit
