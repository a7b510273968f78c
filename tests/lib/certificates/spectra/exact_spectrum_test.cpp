// SPDX-License-Identifier: Apache-2.0
// Exact spectra against closed forms and against 256-bit floats.
#include "sublimit/certificates/spectra/exact_spectrum.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "lib/certificates/spectra/exact_analyses.h"
#include "truth/local_spectrum.h"

namespace sublimit {
namespace {

using testing::analyzed;
using testing::LocalSpectrum;

/// Digits of the tables; butterfly's last ones are cut off, not rounded.
constexpr double table_digits = 1e-8;

Algebraic cosine(int k, int n) { return Number<Algebraic>::cos_2pi(k, n); }
Algebraic ratio(int p, int q) { return Algebraic::ratio(p, q); }

const ExactEigenvalue* find(const ExactSpectrum& spectrum, int block, const AlgebraicRoot& value) {
  for (const ExactEigenvalue& known : spectrum.values)
    if (known.block == block && known.value == value) return &known;
  return nullptr;
}
const ExactEigenvalue* find(const ExactSpectrum& spectrum, int block, const Algebraic& value) {
  return find(spectrum, block, AlgebraicRoot(value));
}
std::vector<int> jordan(const ExactSpectrum& spectrum, int block, const Algebraic& value) {
  const ExactEigenvalue* known = find(spectrum, block, value);
  return known ? known->jordan : std::vector<int>{};
}
/// Largest modulus of block k below 1.
double leading(const ExactSpectrum& spectrum, int k) {
  for (const ExactEigenvalue& value : spectrum.values)
    if (value.block == k && value.rank > 0) return abs(value.value.enclosure()).mid();
  return 0;
}

TEST(ExactSpectrum, LambdaIsThatOfTheTables) {
  const std::map<std::string, std::vector<double>> tables{
      {"catmull-clark",
       {.41009705, .5, .54998835, .57968233, .59851028, .61111653, .61993922, .62634127, .63112759, .63479641}},
      {"loop", {.25, .375, .45225425, .5, .53087245, .55177670, .56651111, .57725425, .58531338, .59150635}},
      {"doo-sabin", {.5, .5, .5, .5, .5, .5, .5, .5, .5, .5}},
      {"mid-edge-habib-warren", {.5, .5, .5, .5, .5, .5, .5, .5, .5, .5}},
      {"modified-butterfly", {.5, .5, .5, .5, .5, .5, .5, .5, .5, .5}},
      {"doo-sabin-averaging",
       {.375, .5, .57725425, .625, .65587245, .67677670, .69151111, .70225425, .71031338, .71650635}},
      {"mid-edge", {.25, .5, .65450850, .75, .81174490, .85355339, .88302222, .90450850, .92062677, .93301270}},
      {"sqrt3",
       {.11111111, .22222222, .29089267, .33333333, .36077551, .37935706, .39245432, .40200378, .40916745, .41467231}},
      {"kobbelt",
       {.42633091, .5, .53794386, .55968452, .57319704, .58213430, .58833903, .59281631, .59615014, .59869791}},
      {"butterfly", {.25, .46904152, .50667561, .5, .48191070, .46241777, .44442935, .42859991, .41487400, .40299786}}};
  for (const auto& [name, lambdas] : tables)
    for (int n = 3; n <= 12; ++n)
      EXPECT_NEAR(leading(analyzed(name, n, 1).spectrum, 1), lambdas[n - 3], table_digits) << name << ", n = " << n;
}

TEST(ExactSpectrum, EigenvaluesAreTheClosedForms) {
  for (const int n : {3, 5, 8, 11}) {
    const ExactSpectrum cc = analyzed("catmull-clark", n, 1).spectrum;
    for (int k = 1; 2 * k <= n; ++k) {
      // x^2 - (5 + c_k)/8 x + 1/16
      const Polynomial p({ratio(1, 16), (5 + cosine(k, n)) * ratio(-1, 8), 1});
      for (const PolynomialFactor& factor : squarefree_factors(p))
        for (const AlgebraicRoot& root : AlgebraicRoot::all(factor.factor)) {
          const ExactEigenvalue* known = find(cc, k, root);
          ASSERT_TRUE(known) << n << ", " << k;
          EXPECT_EQ(known->multiplicity, factor.multiplicity);
        }
    }
    const ExactSpectrum loop = analyzed("loop", n, 1).spectrum;
    const Algebraic lambda = ratio(3, 8) + cosine(1, n) * ratio(1, 4);
    EXPECT_TRUE(find(loop, 0, lambda * lambda)) << n << ": Loop's beta is made for it";
    for (int k = 1; 2 * k <= n; ++k) EXPECT_TRUE(find(loop, k, ratio(3, 8) + cosine(k, n) * ratio(1, 4)));
    const ExactSpectrum ds = analyzed("doo-sabin-averaging", n, 0).spectrum;
    for (int k = 1; 2 * k <= n; ++k) EXPECT_TRUE(find(ds, k, ratio(1, 2) + cosine(k, n) * ratio(1, 4)));
  }
}

TEST(ExactSpectrum, KnowsJordanBlocks) {
  for (int n = 5; n <= 12; ++n)
    EXPECT_EQ(jordan(analyzed("doo-sabin", n, 2).spectrum, 2, ratio(1, 4)), std::vector<int>{2}) << n;
  EXPECT_EQ(jordan(analyzed("mid-edge-habib-warren", 7, 1).spectrum, 2, ratio(1, 4)), (std::vector<int>{2, 1}));
  const ExactSpectrum butterfly3 = analyzed("butterfly", 3).spectrum;
  EXPECT_EQ(jordan(butterfly3, 0, ratio(1, 4)), std::vector<int>{3});
  EXPECT_EQ(jordan(butterfly3, 1, ratio(1, 4)), std::vector<int>{2});
  const ExactSpectrum butterfly6 = analyzed("butterfly", 6).spectrum;
  EXPECT_EQ(jordan(butterfly6, 0, ratio(1, 4)), std::vector<int>{3});
  EXPECT_EQ(jordan(butterfly6, 2, ratio(1, 4)), std::vector<int>{2});
  const ExactSpectrum mid_edge3 = analyzed("mid-edge", 3, 1).spectrum;
  EXPECT_EQ(jordan(mid_edge3, 0, ratio(1, 4)), (std::vector<int>{1, 1}));
  EXPECT_EQ(jordan(mid_edge3, 1, ratio(1, 4)), (std::vector<int>{2, 1}));
}

TEST(ExactSpectrum, RanksHoldEqualModuli) {
  for (const char* name : {"catmull-clark", "butterfly", "kobbelt", "interpolatory-sqrt3"}) {
    const ExactSpectrum spectrum = analyzed(name, 7).spectrum;
    const PrecisionScope scope(128);
    for (size_t i = 1; i < spectrum.values.size(); ++i) {
      const ExactEigenvalue &a = spectrum.values[i - 1], &b = spectrum.values[i];
      const Ball difference = abs(a.value.enclosure()) - abs(b.value.enclosure());
      if (a.rank == b.rank)
        EXPECT_TRUE(difference.contains_zero()) << name << ", " << i;
      else
        EXPECT_TRUE(certainly_positive(difference)) << name << ", " << i;
    }
  }
}

/// Multiplicities and Jordan structure, counted by rank decisions in 256-bit floats at the enclosures' midpoints.
TEST(ExactSpectrum, EnclosuresHoldWhatLongFloatsFind) {
  for (const char* name : {"catmull-clark", "doo-sabin", "butterfly", "sqrt3"})
    for (const int n : {3, 5, 6}) {
      const ExactSpectrum spectrum = analyzed(name, n).spectrum;
      const LocalSpectrum truth(name, n, 2);
      std::vector<int> count(n / 2 + 1);
      for (const ExactEigenvalue& value : spectrum.values) {
        count[value.block] += value.multiplicity;
        if (!value.value.is_real()) continue;
        const std::unique_ptr<char, decltype(&flint_free)> digits(
            arf_get_str(arb_midref(value.value.real_enclosure(300).get()), 80), flint_free);
        std::vector<int> staircase;
        for (int j = 1; j <= value.largest_jordan(); ++j) {
          staircase.push_back(0);
          for (const int size : value.jordan) staircase.back() += std::min(size, j);
        }
        EXPECT_EQ(truth.staircase(value.block, testing::Precise(digits.get())), staircase)
            << name << ", n = " << n << ", block " << value.block << ", " << value.value.text();
      }
      for (int k = 0; 2 * k <= n; ++k) EXPECT_EQ(count[k], truth.size(k)) << name << ", n = " << n << ", block " << k;
    }
}

TEST(ExactSpectrum, BordersDoubleTheValence) {
  // A smooth border point with m faces: 1, 1/2, 1/4 and the sine modes, which are those of valence 2m.
  // In the mirror that swaps both ends: even (block 0) are 1, 1/4 and sines of odd j, odd the tangent and the others.
  const Scheme<Algebraic> cc = find_scheme<Algebraic>("catmull-clark").value();
  const Scheme<Algebraic> loop = find_scheme<Algebraic>("loop").value();
  for (const int m : {2, 3, 4, 5}) {
    const ExactSpectrum quads = analyzed(cc, {.faces = m, .open = true}, 1).spectrum;
    const ExactSpectrum triangles = analyzed(loop, {.faces = m, .open = true}, 1).spectrum;
    for (const ExactSpectrum* spectrum : {&quads, &triangles})
      for (const auto& [block, value] : {std::pair{0, Algebraic(1)}, {1, ratio(1, 2)}, {0, ratio(1, 4)}})
        EXPECT_TRUE(find(*spectrum, block, value)) << m << ", " << value.text();
    for (int j = 1; j < m; ++j) {
      const int block = (j + 1) % 2;
      for (const AlgebraicRoot& root :
           AlgebraicRoot::all(Polynomial({ratio(1, 16), (5 + cosine(j, 2 * m)) * ratio(-1, 8), 1})))
        EXPECT_TRUE(find(quads, block, root)) << m << ", " << j;
      EXPECT_TRUE(find(triangles, block, ratio(3, 8) + cosine(j, 2 * m) * ratio(1, 4))) << m << ", " << j;
    }
  }
  EXPECT_EQ(jordan(analyzed(cc, {.faces = 1, .open = true}, 1).spectrum, 0, ratio(1, 4)), std::vector<int>{2});
  EXPECT_EQ(jordan(analyzed(cc, {.faces = 4, .open = true}, 1).spectrum, 1, ratio(1, 2)), std::vector<int>{2});
  EXPECT_EQ(jordan(analyzed(loop, {.faces = 6, .open = true}, 1).spectrum, 1, ratio(1, 2)), std::vector<int>{2});
}

TEST(ExactSpectrum, AsksForTheSymmetryThatItUses) {
  LocalPatch<Algebraic> patch = *local_patch(find_scheme<Algebraic>("loop").value(), {.faces = 5}, 1);
  patch.A(1, 2) += ratio(1, 1000000);
  EXPECT_THROW(exact_spectrum(patch), AnalysisError);
  patch = *local_patch(find_scheme<Algebraic>("loop").value(), {.faces = 5}, 1);
  patch.A(0, 0) += Algebraic::root_of_unity(1, 5);
  EXPECT_THROW(exact_spectrum(patch), AnalysisError);
}

TEST(ExactKernel, EigenvectorsAreExact) {
  for (const char* name : {"catmull-clark", "butterfly", "doo-sabin"}) {
    const ExactSpectrum spectrum = analyzed(name, 5).spectrum;
    for (const ExactEigenvalue& value : spectrum.values) {
      const DenseMatrix<Algebraic>& B = spectrum.blocks.blocks[value.block];
      const ExactKernel kernel = exact_eigenvectors(B, value.value);
      EXPECT_EQ(kernel.vectors.size(), value.jordan.size()) << name << ", " << value.value.text();
      const Polynomial x = Polynomial::x();
      for (const std::vector<Polynomial>& v : kernel.vectors)
        for (Eigen::Index i = 0; i < B.rows(); ++i) {
          Polynomial sum;
          for (Eigen::Index j = 0; j < B.cols(); ++j) sum += B(i, j) * v[j];
          EXPECT_TRUE(divide(sum - x * v[i], kernel.modulus).remainder.is_zero()) << name << ", row " << i;
        }
    }
  }
}

/// Of 128 bits, 38 digits, elimination of small matrices leaves more than half.
constexpr double enclosed_well = 1e-20;

/// Where there is one, its balls hold a multiple of the exact one, and are small.
TEST(ExactKernel, OneEigenvectorIsEnclosed) {
  const PrecisionScope scope(128);
  for (const char* name : {"catmull-clark", "butterfly", "doo-sabin"}) {
    const ExactSpectrum spectrum = analyzed(name, 5).spectrum;
    int found = 0;
    for (const ExactEigenvalue& value : spectrum.values) {
      const DenseMatrix<Algebraic>& B = spectrum.blocks.blocks[value.block];
      const auto enclosed = enclosed_eigenvector(B, value.value);
      EXPECT_EQ(enclosed.has_value(), value.jordan.size() == 1) << name << ", " << value.value.text();
      if (!enclosed) continue;
      ++found;
      const std::vector<ComplexBall> exact = exact_eigenvectors(B, value.value).enclosure(0);
      ASSERT_EQ(enclosed->size(), exact.size());
      size_t largest = 0;
      for (size_t i = 0; i < exact.size(); ++i)
        if (abs(exact[i]).lower() > abs(exact[largest]).lower()) largest = i;
      const ComplexBall scale = (*enclosed)[largest] / exact[largest];
      for (size_t i = 0; i < exact.size(); ++i) {
        const ComplexBall off = (*enclosed)[i] - scale * exact[i];
        EXPECT_TRUE(off.contains_zero()) << name << ", " << value.value.text() << ", entry " << i;
        EXPECT_LT(abs(off).upper(), enclosed_well) << name << ", " << value.value.text() << ", entry " << i;
      }
    }
    EXPECT_GT(found, 3) << name;
  }
  // What is no eigenvalue has no eigenvector.
  DenseMatrix<Algebraic> B(2, 2);
  B << ratio(1, 2), ratio(0, 1), ratio(0, 1), ratio(1, 4);
  EXPECT_FALSE(enclosed_eigenvector(B, AlgebraicRoot(ratio(1, 3))));
}

}  // namespace
}  // namespace sublimit
