// SPDX-License-Identifier: Apache-2.0
#include "sublimit/scheme/detail/subdivision_rows.h"

#include <gtest/gtest.h>

#include "meshes/hard_meshes.h"
#include "meshes/meshes.h"
#include "sublimit/scheme/refine.h"
#include "sublimit/schemes/schemes.h"

namespace sublimit::testing {
namespace {

TEST(SubdivisionRows, HaveTheBitsOfTheMatrix) {
  for (const Scheme<double>& scheme : all_schemes()) {
    if (scheme.steps.size() > 1 || !scheme.preparation.empty()) continue;
    SCOPED_TRACE(scheme.name);
    const Mesh mesh = scheme.face_size() == 3 ? jittered(triangle_grid(4, 3)) : jittered(grid(4, 3));
    const Level parent = control_level(scheme, mesh), child = next_level(scheme, parent);
    for (const Index every : {1, 3}) {
      std::vector<Index> rows;
      for (Index r = 0; r < child.S.rows(); r += every) rows.push_back(r);
      const SparseMatrix some = subdivision_rows(scheme, scheme.steps[0], parent.topology(), child.steps[0],
                                                 parent.sharpness, child.sharpness, parent.number, rows);
      ASSERT_EQ(some.rows(), child.S.rows());
      ASSERT_EQ(some.cols(), child.S.cols());
      for (Index r = 0; r < some.rows(); ++r) {
        const Eigen::RowVectorXd row = some.row(r), whole = child.S.row(r);
        EXPECT_EQ(row, r % every == 0 ? whole : Eigen::RowVectorXd::Zero(whole.size()).eval()) << "row " << r;
      }
    }
  }
}

}  // namespace
}  // namespace sublimit::testing
