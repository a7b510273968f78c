// SPDX-License-Identifier: Apache-2.0
// The mask of regular meshes against the matrix of a mesh that is regular everywhere. Its symbols are in
// certificates/regularity/regular_mask_test.cpp, where numbers are exact.
#include "sublimit/neighborhood/regular_mask.h"

#include <gtest/gtest.h>

#include "meshes/meshes.h"
#include "sublimit/schemes/schemes.h"
#include "support/tolerance.h"

namespace sublimit {
namespace {

/// Vertices by where they lie around a centre.
std::map<LatticePoint, Index> by_place(const Topology& topology, const Centre& centre, int reach, bool triangular) {
  std::map<LatticePoint, Index> places;
  for (const auto& [vertex, label] : sector_labels(topology, centre, reach))
    places.emplace(unrolled(label, triangular), vertex);
  return places;
}

TEST(RegularMask, IsThatOfTheMatrixOnATorus) {
  for (const Scheme<double>& scheme : all_schemes()) {
    const RegularMask<double> mask = regular_mask(scheme);
    constexpr int m = 20, reach = 8, near = 3;  // nothing is seen from both sides
    const Mesh mesh = mask.triangular ? testing::triangle_torus(m, m) : testing::torus(m, m);
    const std::vector<Level> levels = refine(scheme, mesh, scheme.period);
    const SparseMatrix P = refinement_matrix(levels);
    const Topology* before = &levels[0].topology();
    const Centre parent{mask.dual ? Centre::Kind::face : Centre::Kind::vertex, before->outgoing(Vertex{m + 1})};
    Centre centre = parent;
    for (int k = 1; k <= scheme.period; ++k)
      for (const Refinement& step : levels[k].steps) {
        centre = child(centre, *before, step, k - 1);
        before = &step.topology;
      }
    const auto old = by_place(levels[0].topology(), parent, reach, mask.triangular);
    std::map<Offset, double> seen;  // each weight is somewhere
    for (const auto& [place, vertex] : by_place(*before, centre, near, mask.triangular)) {
      std::map<Index, double> row;
      for (SparseMatrix::InnerIterator it(P, vertex); it; ++it)
        if (std::abs(it.value()) > testing::rounding(8)) row[static_cast<Index>(it.col())] = it.value();
      size_t count = 0;
      for (const auto& [key, weight] : mask.weights) {
        const auto from = mask.parent(place, mask.doubled(key));
        if (!from) continue;
        ASSERT_TRUE(old.contains(*from)) << scheme.name;
        EXPECT_NEAR(row[old.at(*from)], weight, testing::rounding(8)) << scheme.name << " " << key[0] << " " << key[1];
        seen[key] = weight;
        ++count;
      }
      EXPECT_EQ(row.size(), count) << scheme.name;
    }
    EXPECT_EQ(seen, mask.weights) << scheme.name;
  }
}

}  // namespace
}  // namespace sublimit
