// SPDX-License-Identifier: Apache-2.0
#include "sublimit/certificates/c1/all_valences.h"
#include "sublimit/certificates/spectra/exact_schemes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <type_traits>
#include <vector>

#include "sublimit/base/error.h"
#include "sublimit/certificates/c1/turned_map.h"
#include "sublimit/certificates/c1/valence_family.h"
#include "sublimit/schemes/doo_sabin.h"

namespace sublimit {
namespace {

using Labels = const std::vector<SectorLabel>&;
using Net = const std::vector<Ball>&;
static_assert(std::is_constructible_v<TurnedMap, Ball, Ball, const RegularMask<Algebraic>&, Labels, Net> &&
              !std::is_constructible_v<TurnedMap, Ball, Ball, RegularMask<Algebraic>, Labels, Net>);  // which it keeps

/// The first hypothesis that was not shown.
std::string open_one(const AllValences& all) {
  for (const Hypothesis& h : all.verdict.hypotheses)
    if (h.holds != true) return h.says;
  return "";
}

TEST(AllValences, ContainsTheCertificatesOfSingleValences) {
  for (const char* name : {"catmull-clark", "loop", "doo-sabin"}) {
    const C1Prover prover(*find_scheme<Algebraic>(name));
    const AllValences all = all_valences(prover);
    EXPECT_EQ(to_string(all.verdict.answer), "proved") << name;
    EXPECT_EQ(open_one(all), "") << name;
    ASSERT_FALSE(all.intervals.empty()) << name;
    for (size_t k = 1; k < all.intervals.size(); ++k)
      EXPECT_TRUE(all.intervals[k].h.overlaps(all.intervals[k - 1].h)) << name;
    EXPECT_GE(all.intervals.back().h.upper(), 1);
    for (const int n : {7, 11, 23}) {
      C1Certificate c = prover.certify(n);
      const Ball h = Number<Ball>::cos_2pi(1, 2 * n), s = sqrt(Ball(1) - h * h);
      const auto part = std::find_if(all.intervals.begin(), all.intervals.end(),
                                     [&](const ValenceInterval& own) { return own.h.contains(h); });
      ASSERT_NE(part, all.intervals.end()) << name << " " << n;
      EXPECT_TRUE(part->lambda.contains(c.map->lambda.re())) << name << " " << n;
      TurnedMap map(part->h, part->lambda, prover.mask(), block_labels(c.patch, 1), part->net);
      const int one = prover.mask().dual ? 1 : 2;
      for (const LatticePoint p : {LatticePoint{0, 0}, {2, 0}, {2, 2}, {4, 2}, {2, 4}, {4, -2}, {6, 2}}) {
        const LatticePoint q = prover.mask().dual ? p + LatticePoint{1, 1} : p;
        const auto z = map.at(q), d = map.at({one, one});
        const auto own = c.map->at(q), unit = c.map->at({one, one});
        ASSERT_TRUE(z && d && own && unit) << name << " " << q.x2 << " " << q.y2;
        // z/d of both: d lies on the middle of the sector
        const Ball x = d->b, re = (z->a * h + z->b * s * s) / x, im = (z->b * h - z->a) * s / x;
        const ComplexBall expected = *own / *unit;
        EXPECT_TRUE(re.contains(expected.re())) << name << " " << n << " " << q.x2 << " " << q.y2;
        EXPECT_TRUE(im.contains(expected.im())) << name << " " << n << " " << q.x2 << " " << q.y2;
      }
    }
  }
}

/// Loop's scheme from valence 7 on with the weight p/(q n^power) of the ring.
Scheme<Algebraic> loop_from_7(int p, int q, int power) {
  Scheme<Algebraic> scheme = *find_scheme<Algebraic>("loop");
  scheme.steps[0].masks.vertex = [=, loop = scheme.steps[0].masks.vertex](const Ring<Algebraic>& v) {
    const int n = v.valence();
    if (n < 7) return loop(v);
    const Algebraic b = v.ratio(p, power == 1 ? q * n : q * n * n);
    return (Algebraic(1) - b) * v.center() + b * v.neighbor_mean();
  };
  return scheme;
}

// Block 0 has 5/8 - b, and lambda is 3/8 + cos(2 pi/n)/4 = 5/8 - pi^2/(2 n^2) + ...: both tend to 5/8.
TEST(AllValences, BoundsBlocksThatMeetInTheLimit) {
  EXPECT_EQ(to_string(all_valences(C1Prover(loop_from_7(2, 1, 1))).verdict.answer), "proved");
  // 5/8 - 4.8/n^2 is below lambda for n = 7 to 10 only.
  const C1Prover prover(loop_from_7(24, 5, 2));
  EXPECT_EQ(to_string(prover.certify(9).verdict.answer), "proved");
  const AllValences all = all_valences(prover);
  EXPECT_EQ(to_string(all.verdict.answer), "unknown");
  EXPECT_EQ(open_one(all), "n >= 7: those of block 0 are smaller, but for a simple 1");
}

/// Rings of n >= 7 corners with eigenvalues 1, lambda = p/q of blocks 1 and n - 1, and r/s of the others.
Scheme<Algebraic> doo_sabin_from_7(int p, int q, int r, int s) {
  return doo_sabin_with<Algebraic>("doo-sabin with eigenvalues", "", [=](const FaceSite<Algebraic>& f, int j) {
    const int n = f.size();
    if (n < 7) return j == 0 ? f.ratio(n + 5, 4 * n) : (Algebraic(3) + 2 * f.cos_2pi(j, n)) / (4 * n);
    const Algebraic first = f.ratio(p, q), other = f.ratio(r, s);
    const Algebraic spread = (Algebraic(1) - other + 2 * (first - other) * f.cos_2pi(j, n)) / n;
    return j == 0 ? spread + other : spread;
  });
}

TEST(AllValences, SeesOtherBlocksLead) {
  EXPECT_EQ(to_string(all_valences(C1Prover(doo_sabin_from_7(1, 2, 2, 5))).verdict.answer), "proved");
  const AllValences all = all_valences(C1Prover(doo_sabin_from_7(1, 2, 3, 5)));
  EXPECT_EQ(to_string(all.verdict.answer), "unknown");
  EXPECT_EQ(open_one(all), "n >= 7: eigenvalues of blocks 2 to n - 2 are smaller");
}

// Peters, Reif 1998, section 5: regular exactly where 128 l^2 (1 - l) - 7 l - 2 + 9 l cos(2 pi/n) > 0; with l = 0.99
// that is from n = 12 on, with l = 0.97 from n = 7 on.
TEST(AllValences, SeesMapsFold) {
  EXPECT_EQ(to_string(all_valences(C1Prover(doo_sabin_from_7(97, 100, 0, 1))).verdict.answer), "proved");
  const AllValences all = all_valences(C1Prover(doo_sabin_from_7(99, 100, 0, 1)));
  EXPECT_EQ(to_string(all.verdict.answer), "unknown");
  EXPECT_EQ(open_one(all),
            "n >= 7: the Jacobian determinant of the characteristic map, divided by sin(pi/n), is positive, and the "
            "boundary curve winds once around the centre");
}

TEST(AllValences, TakesNoMaskThatChangesOnTheWay) {
  const Scheme<Algebraic> scheme = doo_sabin_with<Algebraic>("", "", [](const FaceSite<Algebraic>& f, int j) {
    const int n = f.size();
    const Algebraic lambda = n == 32 ? f.ratio(2, 5) : f.ratio(1, 2);
    if (n == 4) return f.ratio(j == 0 ? 9 : j == 2 ? 1 : 3, 16);
    return (Algebraic(1) + 2 * lambda * f.cos_2pi(j, n)) / n;
  });
  const AllValences all = all_valences(C1Prover(scheme));
  EXPECT_EQ(to_string(all.verdict.answer), "unknown");
  EXPECT_EQ(open_one(all), "blocks are polynomials in exp(2 pi i k/n) and 1/n: the same ones at all valences compared");
}

TEST(AllValences, KeepsWhatSingleValencesSay) {
  EXPECT_EQ(to_string(all_valences(C1Prover(*find_scheme<Algebraic>("bilinear"))).verdict.answer), "disproved");
  EXPECT_EQ(to_string(all_valences(C1Prover(*find_scheme<Algebraic>("mid-edge"))).verdict.answer), "unknown");
  EXPECT_THROW(all_valences(C1Prover(*find_scheme<Algebraic>("loop")), 6), InvalidParameter);
}

// 1/4 + h^2/4 and 1/4 on the diagonal: trace 5/8 + c/8 = 2 (5 + c)/16, as section 2.1 of the scheme's analysis has it.
TEST(ValenceFamily, FindsCatmullClarksBlockInTheHalfAngle) {
  const auto family = valence_family(C1Prover(*find_scheme<Algebraic>("catmull-clark")), {7, 8, 9});
  ASSERT_TRUE(family);
  EXPECT_TRUE(family->first == family->other);
  const auto R = real_block(family->labels, family->first);
  ASSERT_TRUE(R);
  std::map<SectorLabel, size_t> at;
  for (size_t i = 0; i < family->labels.size(); ++i) at[family->labels[i]] = i;
  const size_t e = at.at({0, 2, 0}), f = at.at({0, 2, 2});
  EXPECT_EQ(((*R)[e][e] + (*R)[f][f]).text(), "1/4*x^2+1/2");
  EXPECT_EQ(((*R)[e][e] * (*R)[f][f] - (*R)[e][f] * (*R)[f][e]).text(), "1/16");
}

}  // namespace
}  // namespace sublimit
