// SPDX-License-Identifier: Apache-2.0
#include "sublimit/certificates/numbers/algebraic.h"
#include "sublimit/certificates/spectra/exact_schemes.h"

#include <gtest/gtest.h>

#include <random>
#include <thread>
#include <vector>

#include "sublimit/base/error.h"
#include "truth/precise_schemes.h"

namespace sublimit {
namespace {

using testing::Precise;

Algebraic cosine(int k, int n) { return Number<Algebraic>::cos_2pi(k, n); }

/// What is left of rounding in numbers of 77 digits.
const double rounding_of_precise = 1e-70;

/// |x - y| is small by enclosures, so at least the ball meets it.
bool encloses(const Algebraic& x, const Precise& y) {
  const PrecisionScope scope(300);
  arb_t other;
  arb_init(other);
  arb_set_str(other, y.str().c_str(), 300);
  arb_add_error_2exp_si(other, -232);  // 1e-70
  const bool meets = arb_overlaps(x.real_enclosure().get(), other);
  arb_clear(other);
  return meets && x.real_enclosure().radius() < rounding_of_precise;
}

TEST(Algebraic, KnowsIdentitiesOfCosines) {
  EXPECT_EQ(cosine(1, 5) + cosine(2, 5), Algebraic::ratio(-1, 2));
  EXPECT_EQ(cosine(1, 8) * cosine(1, 8), Algebraic::ratio(1, 2));
  EXPECT_EQ(cosine(1, 6), Algebraic::ratio(1, 2));
  EXPECT_EQ(2 * cosine(1, 12) * cosine(1, 12) - 1, cosine(1, 6)) << "fields meet";
  EXPECT_EQ(cosine(3, 7) + cosine(4, 7), 2 * cosine(3, 7)) << "even about the half turn";
  for (int n = 3; n <= 50; ++n) {
    Algebraic sum, product(1);
    for (int k = 1; k < n; ++k) {
      sum += cosine(k, n);
      product *= 1 - Algebraic::root_of_unity(k, n);
    }
    EXPECT_EQ(sum, Algebraic(-1)) << n;
    EXPECT_EQ(product, Algebraic(n)) << n;
  }
  EXPECT_FALSE(cosine(1, 7) == cosine(2, 7));
  EXPECT_FALSE(cosine(1, 5) == cosine(1, 7));
}

TEST(Algebraic, IsAField) {
  std::mt19937 random(5);
  const auto any = [&](int n) {
    Algebraic x;
    for (int k = 0; k < n; ++k)
      x += Algebraic::ratio(int(random() % 19) - 9, int(random() % 9) + 1) * Algebraic::root_of_unity(k, n);
    return x;
  };
  for (const int n : {1, 5, 7, 8, 9, 12, 15, 36, 40}) {
    const Algebraic a = any(n), b = any(9), c = any(n);
    EXPECT_EQ(a * (b + c), a * b + a * c) << n;
    EXPECT_EQ(a - a, Algebraic(0)) << n;
    EXPECT_EQ(a / b * b, a) << n;
    EXPECT_EQ((a * b).conj(), a.conj() * b.conj()) << n;
    EXPECT_TRUE((a * a.conj()).is_real()) << n;
    EXPECT_TRUE(norm(a.enclosure()).overlaps((a * a.conj()).real_enclosure())) << n;
    EXPECT_TRUE((a.enclosure() * b.enclosure()).overlaps((a * b).enclosure())) << n;
  }
  EXPECT_THROW(Algebraic(1) / Algebraic(0), AnalysisError);
  EXPECT_THROW(Algebraic::root_of_unity(1, 5).real_enclosure(), AnalysisError);
}

TEST(Algebraic, IsWrittenForPeopleAndReadBack) {
  EXPECT_EQ(Algebraic::ratio(18, 128).text(), "9/64");
  EXPECT_EQ((Algebraic::ratio(5, 8) + Algebraic::ratio(1, 4) * cosine(1, 5)).text(), "5/8+1/4*cos(2pi/5)");
  EXPECT_EQ((-cosine(1, 8)).text(), "-cos(pi/4)");
  EXPECT_EQ((1 - cosine(3, 7)).text(), "1-cos(6pi/7)");
  EXPECT_EQ(Algebraic(0).text(), "0");
  EXPECT_EQ(Algebraic(0.375), Algebraic::ratio(3, 8));
  EXPECT_EQ(Algebraic(-1e30), Algebraic::parse("-1000000000000000019884624838656")) << "the double next to -1e30";
  for (const Algebraic& x : {Algebraic::ratio(-7, 3), cosine(1, 5), cosine(2, 9) + Algebraic::root_of_unity(1, 7)})
    EXPECT_EQ(Algebraic::parse(x.exact_text()), x) << x.exact_text();
  EXPECT_EQ(Algebraic::parse("[5] 0 0 0 0 1"), Algebraic::root_of_unity(4, 5));
  for (const char* bad : {"", "x", "1/0", "1 2", "[5]", "[5 1", "[6] 1 2", "[5] 1 y", "[-5] 1"})
    EXPECT_THROW(Algebraic::parse(bad), FormatError) << bad;
}

TEST(Algebraic, MasksAreTheSameAsInFloatingNumbers) {
  for (const Scheme<Algebraic>& exact : all_schemes<Algebraic>()) {
    const Scheme<Precise> precise = find_scheme<Precise>(exact.name).value();
    const LocalType type{.kind = exact.is_dual() ? Centre::Kind::face : Centre::Kind::vertex, .faces = 5};
    const auto a = local_patch(exact, type);
    const auto b = local_patch(precise, type);
    ASSERT_TRUE(a && b) << exact.name;
    ASSERT_EQ(a->A.rows(), b->A.rows()) << exact.name;
    for (Eigen::Index i = 0; i < a->A.rows(); ++i) {
      EXPECT_EQ(a->A.row(i).sum(), Algebraic(1)) << exact.name << ", row " << i;
      for (Eigen::Index j = 0; j < a->A.cols(); ++j)
        EXPECT_TRUE(encloses(a->A(i, j), b->A(i, j))) << exact.name << ", " << i << ", " << j;
    }
  }
}

TEST(Algebraic, ThreadsKeepTheirOwn) {
  std::vector<Algebraic> sums(4);
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t)
    threads.emplace_back([&, t] {
      for (int n = 3; n < 60; ++n) sums[t] += cosine(1, n) * cosine(1, n) - (1 + cosine(2, n)) / 2;
    });
  for (std::thread& thread : threads) thread.join();
  for (const Algebraic& sum : sums) EXPECT_EQ(sum, Algebraic(0));
}

}  // namespace
}  // namespace sublimit
