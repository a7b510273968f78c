// SPDX-License-Identifier: Apache-2.0
#include "sublimit/certificates/spectra/spectral_verdicts.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "laws/misreadings.h"
#include "lib/certificates/spectra/exact_analyses.h"

namespace sublimit {
namespace {

using testing::analyzed;
using Answer = Verdict::Answer;

/// mu/lambda^2 has three digits in the tables.
constexpr double ratio_digits = 0.501e-3;

bool mentions(const std::string& text, const std::string& part) { return text.find(part) != text.npos; }

SecondOrderGiven everything() {
  SecondOrderGiven given;
  given.c1.holds = given.bounded.holds = given.continuous.holds = true;
  given.c1.by = given.bounded.by = given.continuous.by = Hypothesis::By::exact;
  return given;
}

std::string finding(const Verdict& verdict, const std::string& name) {
  for (const auto& [key, value] : verdict.findings)
    if (key == name) return value;
  return "";
}

TEST(SpectralVerdicts, EverySchemeOfOursConverges) {
  for (const Scheme<Algebraic>& scheme : all_schemes<Algebraic>())
    for (const int n : {3, 5}) {
      const ExactAnalysis analysis = analyzed(scheme, n, 1);
      EXPECT_EQ(affine_invariance(analysis).answer, Answer::proved) << scheme.name;
      EXPECT_EQ(convergence(analysis).answer, Answer::proved) << scheme.name << ", n = " << n;
    }
}

TEST(SpectralVerdicts, GoodSpectraLeaveTheMapToBeLookedAt) {
  for (const char* name :
       {"catmull-clark", "loop", "doo-sabin", "doo-sabin-averaging", "mid-edge-habib-warren", "averaging"})
    for (int n = 3; n <= 9; ++n) {
      const Verdict c1 = spectral_c1(analyzed(name, n));
      EXPECT_EQ(c1.answer, Answer::unknown) << name << ", n = " << n << ": " << c1.because;
      EXPECT_EQ(answer_of(c1.hypotheses, false), Answer::proved) << name << ", n = " << n;
    }
}

TEST(SpectralVerdicts, ButterflyFailsAtThreeAndFromEightOn) {
  const Verdict three = spectral_c1(analyzed("butterfly", 3));
  EXPECT_EQ(three.answer, Answer::disproved);
  EXPECT_TRUE(mentions(three.because, "block 0 leads")) << three.because;
  for (int n = 4; n <= 7; ++n) EXPECT_EQ(spectral_c1(analyzed("butterfly", n)).answer, Answer::unknown) << n;
  for (int n = 8; n <= 12; ++n) {
    const Verdict c1 = spectral_c1(analyzed("butterfly", n));
    EXPECT_EQ(c1.answer, Answer::disproved) << n;
    EXPECT_TRUE(mentions(c1.because, "block 2 leads")) << c1.because;
  }
}

TEST(SpectralVerdicts, MidEdgeHasAJordanCase) {
  const Verdict c1 = spectral_c1(analyzed("mid-edge", 3));
  EXPECT_EQ(c1.answer, Answer::borderline);
  EXPECT_TRUE(mentions(c1.because, "Jordan case")) << c1.because;
  for (int n = 4; n <= 9; ++n) EXPECT_EQ(spectral_c1(analyzed("mid-edge", n)).answer, Answer::unknown) << n;
}

TEST(SpectralVerdicts, WithoutRelaxationSqrt3HasSpikes) {
  const Scheme<Algebraic> scheme = testing::misread::sqrt3_without_relaxation<Algebraic>();
  for (const int n : {3, 5, 6, 8}) {
    const Verdict c1 = spectral_c1(analyzed(scheme, n, 2));
    EXPECT_EQ(c1.answer, Answer::disproved) << n;
    EXPECT_TRUE(mentions(c1.because, "block 0 leads (4/9")) << "(2/3)^2 in two steps: " << c1.because;
  }
}

TEST(SpectralVerdicts, DooSabinWithMidpointsHasNoTangentPlane) {
  // New corners halfway between centroid and corner: all modes of a ring have 1/2.
  const Scheme<Algebraic> scheme = testing::misread::doo_sabin_halfway<Algebraic>();
  for (const int n : {4, 5, 6}) {
    const Verdict c1 = spectral_c1(analyzed(scheme, n, 2));
    EXPECT_EQ(c1.answer, Answer::disproved) << n << ": " << c1.because;
    EXPECT_TRUE(mentions(c1.because, "lead together (1/2 in block 1; 1/2 in block 2")) << c1.because;
  }
}

TEST(SpectralVerdicts, WeightsThatDoNotSumToOneAreFound) {
  Scheme<Algebraic> scheme = loop<Algebraic>({});
  scheme.steps[0].masks.vertex = [](const Ring<Algebraic>& v) {
    return Algebraic::ratio(5, 8) * v.center() + Algebraic::ratio(1, 4) * v.neighbor_mean();
  };
  const ExactAnalysis analysis = analyzed(scheme, 5, 1);
  EXPECT_EQ(affine_invariance(analysis).answer, Answer::disproved);
  EXPECT_TRUE(mentions(affine_invariance(analysis).because, "7/8"));
  EXPECT_EQ(convergence(analysis).answer, Answer::disproved);
  EXPECT_EQ(spectral_c1(analysis).answer, Answer::disproved);
}

struct SecondOrder {
  const char* scheme;
  int n;
  double ratio;  ///< mu/lambda^2
  const char* curvature;
  const char* shapes;
};

class SecondOrderTest : public ::testing::TestWithParam<SecondOrder> {};

TEST_P(SecondOrderTest, CurvatureAndShapesAreThoseOfTheTables) {
  const auto& [scheme, n, ratio, how, which] = GetParam();
  const ExactAnalysis analysis = analyzed(scheme, n);
  const std::optional<Subdominant> s = subdominant(analysis);
  ASSERT_TRUE(s);
  EXPECT_NEAR(s->ratio.mid(), ratio, ratio_digits);
  const Verdict verdict = curvature(analysis, everything());
  EXPECT_EQ(verdict.answer, Answer::proved);
  EXPECT_EQ(finding(verdict, "curvature"), how) << verdict.because;
  EXPECT_EQ(finding(shapes(analysis, everything()), "shapes"), which);
  EXPECT_EQ(curvature(analysis, {}).answer, Answer::unknown) << "C^1 was not given";
}

INSTANTIATE_TEST_SUITE_P(Schemes, SecondOrderTest,
                         ::testing::Values(SecondOrder{"catmull-clark", 3, 0.991, "flat", "elliptic"},
                                           SecondOrder{"catmull-clark", 4, 1, "bounded", "all"},
                                           SecondOrder{"catmull-clark", 5, 1.124, "divergent", "hyperbolic"},
                                           SecondOrder{"catmull-clark", 8, 1.339, "divergent", "hyperbolic"},
                                           SecondOrder{"catmull-clark", 12, 1.439, "divergent", "hyperbolic"},
                                           SecondOrder{"doo-sabin", 3, 1, "bounded", "all"},
                                           SecondOrder{"doo-sabin", 5, 1, "logarithmic", "hyperbolic"},
                                           SecondOrder{"doo-sabin", 9, 1, "logarithmic", "other"},
                                           SecondOrder{"doo-sabin-averaging", 3, 1.778, "divergent", "all"},
                                           SecondOrder{"doo-sabin-averaging", 5, 0.8935, "flat", "hyperbolic"},
                                           SecondOrder{"doo-sabin-averaging", 6, 0.96, "flat", "hyperbolic"},
                                           SecondOrder{"doo-sabin-averaging", 12, 1.217, "divergent", "hyperbolic"},
                                           SecondOrder{"loop", 3, 2, "divergent", "all"},
                                           SecondOrder{"loop", 4, 1, "bounded", "elliptic"},
                                           SecondOrder{"loop", 5, 1, "bounded", "elliptic"},
                                           SecondOrder{"loop", 6, 1, "bounded", "all"},
                                           SecondOrder{"loop", 7, 1.133, "divergent", "hyperbolic"},
                                           SecondOrder{"loop", 12, 1.429, "divergent", "hyperbolic"},
                                           SecondOrder{"loop-warren", 4, 1.778, "divergent", "elliptic"},
                                           SecondOrder{"loop-warren", 5, 1.222, "divergent", "elliptic"},
                                           SecondOrder{"mid-edge", 5, 0.584, "flat", "all"},
                                           SecondOrder{"mid-edge", 6, 0.444, "flat", "hyperbolic"},
                                           SecondOrder{"mid-edge", 8, 0.686, "flat", "hyperbolic"},
                                           SecondOrder{"mid-edge", 12, 0.862, "flat", "hyperbolic"},
                                           SecondOrder{"sqrt3", 3, 3.323, "divergent", "elliptic"},
                                           SecondOrder{"sqrt3", 7, 1.327, "divergent", "hyperbolic"},
                                           SecondOrder{"kobbelt", 5, 1.251, "divergent", "hyperbolic"},
                                           SecondOrder{"modified-butterfly", 4, 1, "bounded", "all"}),
                         [](const auto& of) {
                           std::string name = std::string(of.param.scheme) + "_" + std::to_string(of.param.n);
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

TEST(SpectralVerdicts, CurvatureIsIntegrableUpToAPower) {
  const auto p = [](int n) {
    return std::stod(finding(curvature_integrability(analyzed("catmull-clark", n), everything()), "p"));
  };
  constexpr double one_decimal = 0.05;  // as the figures are printed
  constexpr double two_decimals = 0.005;
  EXPECT_NEAR(p(5), 10.2, one_decimal);
  EXPECT_NEAR(p(8), 3.38, two_decimals);
  EXPECT_NEAR(p(12), 2.50, two_decimals);
  EXPECT_EQ(finding(curvature_integrability(analyzed("catmull-clark", 3), everything()), "p"), "null");
}

TEST(SpectralVerdicts, SecondDerivativesAreContinuousOnlyWhereTheSpectrumAllows) {
  EXPECT_EQ(spectral_c2(analyzed("catmull-clark", 5), everything()).answer, Answer::disproved);
  EXPECT_EQ(spectral_c2(analyzed("catmull-clark", 4), everything()).answer, Answer::unknown);
  EXPECT_EQ(spectral_c2(analyzed("catmull-clark", 3), everything()).answer, Answer::proved) << "a flat point";
  EXPECT_EQ(spectral_c2(analyzed("catmull-clark", 3), {}).answer, Answer::unknown)
      << "nothing is known of regular surfaces";
  EXPECT_EQ(spectral_c2(analyzed("doo-sabin", 5), everything()).answer, Answer::disproved);
}

struct Side {
  const char* scheme;
  int faces;
  Answer smooth, corner;
};

TEST(SpectralVerdicts, OneSidedTangentPlanesEndWhereAModeOvertakesTheTangent) {
  for (const auto& [name, faces, smooth, corner] :
       {Side{"catmull-clark", 1, Answer::evidence_for, Answer::evidence_for},
        Side{"catmull-clark", 2, Answer::evidence_for, Answer::borderline},
        Side{"catmull-clark", 3, Answer::evidence_for, Answer::disproved},
        Side{"catmull-clark", 4, Answer::borderline, Answer::disproved},
        Side{"catmull-clark", 5, Answer::disproved, Answer::disproved},
        Side{"loop", 1, Answer::evidence_for, Answer::evidence_for},
        Side{"loop", 2, Answer::evidence_for, Answer::evidence_for},
        Side{"loop", 3, Answer::evidence_for, Answer::borderline},
        Side{"loop", 4, Answer::evidence_for, Answer::disproved},
        Side{"loop", 5, Answer::evidence_for, Answer::disproved},
        Side{"loop", 6, Answer::borderline, Answer::disproved}, Side{"loop", 7, Answer::disproved, Answer::disproved},
        Side{"bilinear", 1, Answer::evidence_for, Answer::evidence_for},
        Side{"bilinear", 2, Answer::disproved, Answer::disproved}}) {
    const Scheme<Algebraic> scheme = find_scheme<Algebraic>(name).value();
    const Verdict along = tangent_plane(analyzed(scheme, {.faces = faces, .open = true}, 1));
    const Verdict at = tangent_plane(analyzed(scheme, {.faces = faces, .open = true, .corner = true}, 1));
    EXPECT_EQ(along.answer, smooth) << name << ", " << faces << " faces: " << along.because;
    EXPECT_EQ(at.answer, corner) << name << ", corner of " << faces << " faces: " << at.because;
  }
}

TEST(ExactAnalysis, ModesThatLeadAreSeen) {
  for (const char* name : {"catmull-clark", "loop", "doo-sabin", "butterfly", "sqrt3"}) {
    const ExactAnalysis analysis = analyzed(name, 5);
    for (const ExactEigenvalue& value : analysis.spectrum.of_rank(1)) EXPECT_EQ(is_seen(analysis, value), true) << name;
  }
  // Places next to the point have their limits in two rings: one is not enough to tell, nor to prove.
  const ExactAnalysis small = analyzed("catmull-clark", 5, 1);
  EXPECT_EQ(is_seen(small, small.spectrum.of_rank(2)[0]), std::nullopt);
  EXPECT_EQ(curvature(small, everything()).answer, Answer::unknown);
  // The limit of the mode of eigenvalue 1 is a constant.
  EXPECT_EQ(is_seen(analyzed("loop", 7), analyzed("loop", 7).spectrum.values[0]), true);
}

}  // namespace
}  // namespace sublimit
