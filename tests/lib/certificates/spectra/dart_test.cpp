// SPDX-License-Identifier: Apache-2.0
#include "sublimit/certificates/spectra/dart.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "lib/certificates/spectra/exact_analyses.h"
#include "sublimit/certificates/spectra/spectral_verdicts.h"
#include "sublimit/limit/detail/limit_masks.h"
#include "support/tolerance.h"

namespace sublimit {
namespace {

using testing::analyzed;
using Answer = Verdict::Answer;

/// Conditioning of the eigenvalues of matrices this small.
constexpr double conditioning = 1e3;

bool mentions(const std::string& text, const std::string& part) { return text.find(part) != text.npos; }

ExactAnalysis dart(const Scheme<Algebraic>& scheme, int n) {
  return open_analysis(scheme, dart_patch(scheme, n).value());
}

/// The largest eigenvalue below 1 of a block.
const ExactEigenvalue& leading(const ExactAnalysis& analysis, int block) {
  for (const ExactEigenvalue& value : analysis.spectrum.values)
    if (value.rank > 0 && value.block == block) return value;
  throw std::runtime_error("the block has no such value");
}

/// Masks at vertex 0 of a fan with sharp edges, by vertex of the fan; from the one-ring matrix, in double.
struct MasksOfFan {
  LimitMasks masks;
  std::vector<Index> vertices;
};
MasksOfFan masks_of(const Scheme<double>& scheme, const Mesh& fan) {
  SubdivisionOptions options;
  options.boundary = Boundary::edge_only;
  const Level level = control_level(scheme, fan, options);
  const NeighborhoodAt at = neighborhood(level.topology(), level.sharpness, Vertex{0});
  return {limit_masks(scheme, at.type), at.vertices};
}

TEST(Dart, EvenAndOddModesAreThoseOfLimitMasks) {
  for (const char* name : {"catmull-clark", "loop", "loop-warren"})
    for (int n = 3; n <= 12; ++n) {
      const Scheme<double> scheme = find_scheme<double>(name).value();
      const LimitMasks::Side side =
          masks_of(scheme, creased_fan(n, n, scheme.face_size() == 3 ? 3 : 4)).masks.sides.at(0);
      const ExactAnalysis exact = dart(find_scheme<Algebraic>(name).value(), n);
      EXPECT_NEAR(leading(exact, 0).value.real_enclosure().mid(), side.lambda1, testing::eigen(conditioning))
          << name << n;
      EXPECT_NEAR(leading(exact, 1).value.real_enclosure().mid(), side.lambda2, testing::eigen(conditioning))
          << name << n;
      EXPECT_EQ(side.plane, LimitMasks::Plane::yes);
      const Verdict verdict = dart_tangent_plane(exact);
      EXPECT_EQ(verdict.answer, Answer::evidence_for) << name << ", n = " << n << ": " << verdict.because;
      for (const Hypothesis& h : verdict.hypotheses) EXPECT_NE(h.by, Hypothesis::By::floating) << h.says;
    }
}

TEST(Dart, RegularOnesHaveHalvesAndASemisimpleTie) {
  for (const auto& [name, n] : {std::pair{"catmull-clark", 4}, {"loop", 6}}) {
    const ExactAnalysis exact = dart(find_scheme<Algebraic>(name).value(), n);
    for (const int block : {0, 1}) {
      EXPECT_EQ(leading(exact, block).value, AlgebraicRoot(Algebraic::ratio(1, 2))) << name;
      EXPECT_EQ(leading(exact, block).multiplicity, 1);
    }
    EXPECT_EQ(leading(exact, 0).rank, leading(exact, 1).rank);
  }
}

TEST(Dart, ClosedFormsAtValenceThree) {
  // Odd modes have opposite values e, -e on the two smooth edges and f, -f on the faces beside the sharp edge, and zero
  // elsewhere. Loop: e' = (3/8 - 1/8) e. Catmull-Clark: f' = (e + f)/4, e' = (e + f')/4, so [[5/16, 1/16], [1/4, 1/4]].
  EXPECT_EQ(leading(dart(find_scheme<Algebraic>("loop").value(), 3), 1).value, AlgebraicRoot(Algebraic::ratio(1, 4)));
  const AlgebraicRoot cc = leading(dart(find_scheme<Algebraic>("catmull-clark").value(), 3), 1).value;
  EXPECT_EQ(cc.text(), "9/32+sqrt(17/1024)");
}

TEST(Dart, BilinearOnesHaveNoTangentPlane) {
  const Verdict verdict = dart_tangent_plane(dart(find_scheme<Algebraic>("bilinear").value(), 4));
  EXPECT_EQ(verdict.answer, Answer::disproved);
  EXPECT_TRUE(mentions(verdict.because, "three directions or more")) << verdict.because;
}

TEST(Dart, SpikesFold) {
  // Vertices that hardly move: the cap, an even mode, leads with the even one of the plane.
  Scheme<Algebraic> scheme = find_scheme<Algebraic>("loop").value();
  scheme.steps[0].masks.vertex = [](const Ring<Algebraic>& v) {
    return Algebraic::ratio(31, 32) * v.center() + Algebraic::ratio(1, 32) * v.neighbor_mean();
  };
  const Verdict verdict = dart_tangent_plane(dart(scheme, 5));
  EXPECT_EQ(verdict.answer, Answer::disproved) << verdict.because;
  EXPECT_TRUE(mentions(verdict.because, "two even modes lead")) << verdict.because;
}

TEST(Dart, OnlySchemesWithDartsHaveThem) {
  for (const char* name : {"butterfly", "kobbelt", "sqrt3", "doo-sabin"})
    EXPECT_FALSE(dart_patch(find_scheme<Algebraic>(name).value(), 5)) << name;
}

TEST(Crease, SidesHaveTheMatricesAndVerdictsOfBorders) {
  for (const char* name :
       {"catmull-clark", "loop", "loop-warren", "bilinear", "butterfly", "modified-butterfly", "kobbelt"})
    for (const int faces : {1, 2, 3}) {
      const Scheme<Algebraic> scheme = find_scheme<Algebraic>(name).value();
      const auto side = crease_patch(scheme, faces);
      const ExactAnalysis border = analyzed(scheme, {.faces = faces, .open = true}, -1);
      ASSERT_TRUE(side) << name;
      EXPECT_TRUE(is_same_matrix(*side, border.patch)) << name << ", " << faces;
      const Verdict here = tangent_plane(open_analysis(scheme, *side)), there = tangent_plane(border);
      EXPECT_EQ(here.answer, there.answer) << name;
      EXPECT_EQ(here.because, there.because) << name;
    }
  // It can fail.
  const Scheme<Algebraic> loop = find_scheme<Algebraic>("loop").value();
  const LocalType corner{.faces = 3, .open = true, .corner = true};
  EXPECT_FALSE(is_same_matrix(*crease_patch(loop, 3), *local_patch(loop, corner)));
  EXPECT_FALSE(is_same_matrix(*crease_patch(loop, 3), *crease_patch(loop, 2)));
  EXPECT_FALSE(crease_patch(find_scheme<Algebraic>("sqrt3").value(), 3));
}

TEST(Crease, MasksOfASideAreThoseOfTheBorder) {
  for (const char* name : {"catmull-clark", "loop"})
    for (const int faces : {2, 3}) {
      const Scheme<double> scheme = find_scheme<double>(name).value();
      const Index size = scheme.face_size() == 3 ? 3 : 4, step = size - 2;
      const auto [masks, vertices] = masks_of(scheme, creased_fan(faces + 4, faces, size));
      const IsolatedLimit border = isolated_limit(scheme, {.faces = faces, .open = true}).value();
      const LocalPatch<double> patch = local_patch(scheme, {.faces = faces, .open = true}).value();
      ASSERT_EQ(masks.sides.size(), 2u);
      const LimitMasks::Side& side = masks.sides[masks.sides[0].num_corners == faces ? 0 : 1];
      ASSERT_EQ(side.num_corners, faces);
      const auto weight = [&](const LimitMasks::Mask& mask, const SectorLabel& label) {
        const Index vertex = label.x2 == 0 ? 0 : 1 + label.sector * step + (label.y2 ? 1 : 0);
        const auto slot = std::find(vertices.begin(), vertices.end(), vertex) - vertices.begin();
        return mask[slot];
      };
      const LimitMasks::Side& there = border.masks.sides.at(0);
      Eigen::Matrix<double, Eigen::Dynamic, 4> tangents(patch.labels.size(), 4);
      for (size_t i = 0; i < patch.labels.size(); ++i) {
        const auto at = static_cast<Eigen::Index>(i);
        EXPECT_NEAR(weight(masks.position, patch.labels[i]), border.masks.position[at], testing::other_route) << name;
        tangents.row(at) << weight(side.tangent1, patch.labels[i]), weight(side.tangent2, patch.labels[i]),
            there.tangent1[at], there.tangent2[at];
      }
      // Tangents have scales of their own; directions they have in common.
      tangents.colwise().normalize();
      EXPECT_NEAR(tangents.col(0).dot(tangents.col(2)), 1, testing::other_route) << name << ", " << faces;
      EXPECT_NEAR(tangents.col(1).dot(tangents.col(3)), 1, testing::other_route) << name << ", " << faces;
      EXPECT_EQ(side.plane, there.plane);
    }
}

}  // namespace
}  // namespace sublimit
