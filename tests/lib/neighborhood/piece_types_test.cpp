// SPDX-License-Identifier: Apache-2.0
#include "sublimit/neighborhood/piece_types.h"

#include <gtest/gtest.h>

#include "meshes/hard_meshes.h"
#include "sublimit/schemes/schemes.h"

namespace sublimit::testing {
namespace {

/// Calls visit(type) for faces of level 1, where all of them are of one kind.
template <class Visit>
void visit_types(const std::string& name, const Mesh& mesh, Creasing creasing, const Visit& visit) {
  const Scheme<double> scheme = find_scheme(name).value();
  const Level level = next_level(scheme, control_level(scheme, mesh, {.boundary = {}, .creasing = creasing}));
  const Topology& t = level.topology();
  const auto kind = t.uniform_face_size() == 3 ? Piece::Kind::triangle : Piece::Kind::quad;
  PieceTypes types(scheme);
  PieceWalker walker;
  for (Index f = 0; f < t.num_faces(); ++f) {
    const Piece piece{kind, t.first(Face{f})};
    visit(*types.type(level, piece, walker.walk(t, level.sharpness, piece, types.rings(level.sharpness), 0)));
  }
}

class ChildCorners : public ::testing::TestWithParam<std::string> {};

TEST_P(ChildCorners, AreThoseOfTheBlocksToTheBit) {
  const bool triangles = GetParam() == "loop";
  for (const Creasing creasing : {Creasing::uniform, Creasing::chaikin}) {
    const Hardness hardness{.open = true, .sharp = false, .semi_sharp = true};
    const Mesh mesh = triangles ? hard_triangles(5, hardness) : hard_polygons(5, hardness);
    visit_types(GetParam(), mesh, creasing, [&](const PieceType& type) {
      const PieceType::ChildCorners corners = type.child_corners();
      const auto& links = type.children();
      ASSERT_EQ(corners.maps.size(), links.size());
      const Eigen::Index sides = triangles ? 3 : 4, slots = type.num_slots();
      ASSERT_EQ(corners.rows.rows(), sides * std::ssize(links));
      ASSERT_EQ(corners.rows.cols(), slots);
      for (size_t c = 0; c < links.size(); ++c) {
        const RowMatrix own = corners.rows.middleRows(Eigen::Index(c) * sides, sides).rightCols(slots - 1);
        const PieceBlock& block = links[c].block;
        EXPECT_EQ(Eigen::RowVectorXd(own.row(0)), block.origin());
        const RowMatrix D = block.differences();
        for (Eigen::Index k = 1; k < sides; ++k)
          EXPECT_EQ(RowMatrix(own.row(k) - own.row(0)), RowMatrix(D.row(k - 1))) << "child " << c << " corner " << k;
        for (const PieceCoordinates place : {triangles ? triangle_place(0.25, 0.125) : quad_place(0.25, 0.125)})
          EXPECT_EQ(corners.maps[c].contains(place), links[c].map.contains(place));
      }
    });
  }
}

INSTANTIATE_TEST_SUITE_P(Schemes, ChildCorners, ::testing::Values("catmull-clark", "loop"));

}  // namespace
}  // namespace sublimit::testing
