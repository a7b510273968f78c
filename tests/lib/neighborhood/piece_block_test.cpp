// SPDX-License-Identifier: Apache-2.0
#include "sublimit/neighborhood/piece_block.h"

#include <gtest/gtest.h>

#include <random>

#include "meshes/meshes.h"
#include "sublimit/neighborhood/piece_types.h"
#include "sublimit/schemes/schemes.h"
#include "support/tolerance.h"

namespace sublimit::testing {
namespace {

/// Rows of a few weights that sum to one.
SparseMatrix stencils(Index rows, Index columns, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_int_distribution<Index> column(0, columns - 1);
  std::uniform_real_distribution<double> weight(-0.2, 1);
  std::vector<Eigen::Triplet<double, Index>> entries;
  for (Index i = 0; i < rows; ++i) {
    double rest = 1;
    for (int k = 0; k < 5; ++k) {
      const double w = weight(random) / 5;
      entries.push_back({i, column(random), w});
      rest -= w;
    }
    entries.push_back({i, i % columns, rest});
  }
  SparseMatrix B(rows, columns);
  B.setFromTriplets(entries.begin(), entries.end());
  return B;
}

/// Blocks of few points are dense, of more sparse: the same numbers.
TEST(PieceBlock, IsWhatItsDifferencesSayOfAnySize) {
  for (const auto& [rows, columns] : {std::pair<Index, Index>{9, 12}, {32, 32}, {33, 20}, {40, 70}, {150, 400}}) {
    SCOPED_TRACE(std::to_string(rows) + " x " + std::to_string(columns));
    const SparseMatrix B = stencils(rows, columns, 7);
    const PieceBlock block(B);
    EXPECT_EQ(block.child_slots(), rows);
    EXPECT_EQ(block.is_large(), columns > 192);
    const RowMatrix dense(B), inner = dense.bottomRightCorner(rows - 1, columns - 1);
    const Eigen::RowVectorXd origin = dense.row(0).tail(columns - 1);
    EXPECT_EQ(block.origin(), origin);
    const RowMatrix D = inner.rowwise() - origin;
    EXPECT_EQ(block.differences(), D);
    const double allowed = rounding(int(rows));
    const RowMatrix derivatives = RowMatrix::Random(5, rows - 1), expected = derivatives * D;
    EXPECT_LE((block.derivatives_pulled_back(derivatives) - expected).cwiseAbs().maxCoeff(), allowed);
    RowMatrix positions = expected;
    positions.row(0) += origin;
    EXPECT_LE((block.pulled_back(derivatives) - positions).cwiseAbs().maxCoeff(), allowed);
    const Points points = Points::Random(columns - 1, 3);
    EXPECT_LE((block.apply(points) - D * points).cwiseAbs().maxCoeff(), allowed);
    const PieceBlock next(stencils(20, rows, 8)), both = block.then(next);
    EXPECT_LE((both.differences() - next.differences() * D).cwiseAbs().maxCoeff(), allowed);
  }
}

/// Halstead, Kass, DeRose 1993: n/(n + 5) of the vertex, 4/(n (n + 5)) of its neighbours, 1/(n (n + 5)) across faces.
/// From some 95 edges on blocks are large, and the limit is that of the points that matter.
TEST(PieceBlock, LimitsOfLargeBlocksAreThoseOfThePaper) {
  const Scheme<double> scheme = find_scheme("catmull-clark").value();
  for (const Index n : {5, 60, 130}) {
    const Level level = control_level(scheme, fan(n, 4, 2));
    const Topology& t = level.topology();
    PieceTypes types(scheme);
    PieceWalker walker;
    const Piece piece{Piece::Kind::quad, t.outgoing(Vertex{0})};
    const PieceType& type =
        *types.type(level, piece, walker.walk(t, level.sharpness, piece, types.rings(level.sharpness), 0));
    EXPECT_EQ(type.children()[0].block.is_large(), n > 100);
    const Eigen::RowVectorXd& row = type.corner_limit(0);
    const double unit = 1.0 / (double(n) * (n + 5.0));
    int edges = 0, faces = 0;
    for (const double w : row) {
      edges += std::abs(w - 4 * unit) < rounding(int(row.size()));
      faces += std::abs(w - unit) < rounding(int(row.size()));
    }
    EXPECT_EQ(edges, n);
    EXPECT_EQ(faces, n);
    EXPECT_NEAR(row.sum(), 5 * double(n) * unit, rounding(int(row.size())));
  }
}

/// What types take is counted, and grows as their points do: no block is square.
TEST(PieceTypes, MemoryGrowsLikeTheEdgesOfAPole) {
  const Scheme<double> scheme = find_scheme("kobbelt").value();
  double before = 0;
  for (const Index n : {20, 40, 80}) {
    const Level level = control_level(scheme, fan(n, 4, 6));
    const Topology& t = level.topology();
    PieceTypes types(scheme);
    PieceWalker walker;
    const Piece piece{Piece::Kind::quad, t.outgoing(Vertex{0})};
    const PieceType& type =
        *types.type(level, piece, walker.walk(t, level.sharpness, piece, types.rings(level.sharpness), 0));
    type.children();
    EXPECT_GT(types.memory(), 1000.0 * n);
    if (before > 0) {
      EXPECT_LT(types.memory(), 2.5 * before);
    }
    before = types.memory();
  }
}

}  // namespace
}  // namespace sublimit::testing
