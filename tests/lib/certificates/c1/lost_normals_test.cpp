// SPDX-License-Identifier: Apache-2.0
// Rows of the table of lost normals are proved by exact verdicts, or have evidence by them, and are not proved for the
// numbers of faces that they leave out.
#include "laws/lost_normals.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "lib/certificates/spectra/exact_analyses.h"
#include "sublimit/certificates/spectra/spectral_verdicts.h"
#include "sublimit/limit/detail/limit_masks.h"
#include "sublimit/schemes/schemes.h"

namespace sublimit::testing {
namespace {

using Where = LostNormals::Where;

/// Whether generic control points have a tangent plane at such a vertex, by exact eigenvalues.
Verdict verdict_of(const LostNormals& row, Index faces) {
  const Scheme<Algebraic> scheme = find_scheme<Algebraic>(row.scheme).value();
  if (row.before) return tangent_plane(analyzed(scheme, {.kind = Centre::Kind::border, .faces = 0}, 1));
  if (row.where == Where::inside) return spectral_c1(analyzed(scheme, int(faces), 2));
  return tangent_plane(analyzed(scheme, {.faces = faces, .open = true, .corner = row.where == Where::corner}, 1));
}

bool is_inside(const LostNormals& row) { return row.where == Where::inside; }

TEST(LostNormals, AreProvedByExactVerdicts) {
  int proved = 0;
  for (const LostNormals& row : lost_normals()) {
    if (!row.exact) continue;
    ++proved;
    const Index first = is_inside(row) ? std::max<Index>(row.least, 3) : row.least;
    for (Index faces = first; faces <= (row.most > 0 ? row.most : first + 2); ++faces) {
      const Verdict verdict = verdict_of(row, faces);
      EXPECT_EQ(verdict.answer, Verdict::Answer::disproved)
          << row.scheme << ", " << faces << " faces, " << int(row.where) << ": " << verdict.because;
    }
  }
  EXPECT_GE(proved, 8);
}

TEST(LostNormals, AreNowhereSaidToBeThereByExactVerdicts) {
  int looked_at = 0;
  for (const LostNormals& row : lost_normals()) {
    if (row.exact) continue;
    ++looked_at;
    const Verdict verdict = verdict_of(row, row.least);
    EXPECT_EQ(verdict.answer, Verdict::Answer::evidence_against)
        << row.scheme << ", " << row.least << " faces: " << verdict.because;
  }
  EXPECT_GE(looked_at, 4);
}

TEST(LostNormals, AreToldAlikeByMasksAndByExactVerdictsOnBorders) {
  for (const std::string name : {"catmull-clark", "loop", "butterfly", "modified-butterfly", "kobbelt"})
    for (const Index faces : {2, 3, 4, 5}) {
      const LocalType border{.faces = faces, .open = true};
      const std::optional<IsolatedLimit> limit = isolated_limit(*find_scheme(name), border);
      const Verdict verdict = tangent_plane(analyzed(find_scheme<Algebraic>(name).value(), border, 1));
      ASSERT_TRUE(limit);
      const bool by_masks = limit->masks.sides[0].plane == LimitMasks::Plane::no;
      EXPECT_EQ(verdict.answer == Verdict::Answer::disproved, by_masks)
          << name << ", " << faces << " faces: " << verdict.because;
    }
}

TEST(LostNormals, AreNotClaimedWhereVerdictsAllowNormals) {
  for (const LostNormals& row : lost_normals())
    for (const Index faces : {row.least - 1, row.most + 1}) {
      const bool covered = std::ranges::any_of(lost_normals(), [&](const LostNormals& other) {
        return other.scheme == row.scheme && other.where == row.where && faces >= other.least &&
               (other.most == 0 || faces <= other.most);
      });
      if (!row.exact || covered || faces < (is_inside(row) ? 3 : 1)) continue;
      const Verdict verdict = verdict_of(row, faces);
      EXPECT_NE(verdict.answer, Verdict::Answer::disproved)
          << row.scheme << ", " << faces << " faces, " << int(row.where) << ": " << verdict.because;
    }
}

}  // namespace
}  // namespace sublimit::testing
