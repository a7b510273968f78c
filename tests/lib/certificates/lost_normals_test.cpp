// SPDX-License-Identifier: Apache-2.0
// Each row of the table of lost normals is proved by an exact verdict, and not proved for the numbers of faces that it
// leaves out.
#include "support/lost_normals.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "lib/certificates/exact_analyses.h"
#include "sublimit/certificates/spectral_verdicts.h"

namespace sublimit::testing {
namespace {

using Where = LostNormals::Where;

/// Whether generic control points have a tangent plane at such a vertex, by exact eigenvalues.
Verdict verdict_of(const LostNormals& row, Index faces) {
  const Scheme<Algebraic> scheme = find_scheme<Algebraic>(row.scheme).value();
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
  EXPECT_GE(proved, 6);
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
