// SPDX-License-Identifier: Apache-2.0
// Pieces on sheets that meet: what they depend on does not grow with the number of sheets.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "meshes/meshes.h"
#include "sublimit/neighborhood/piece_types.h"
#include "sublimit/schemes/schemes.h"
#include "sublimit/surface/limit_map.h"
#include "support/tolerance.h"

namespace sublimit::testing {
namespace {

constexpr Index page_size = 4;  // quads along the spine and away from it

/// The pages of a book, each a bent square of quads or of triangles; all share one side, the spine: vertices
/// 0 .. page_size. The first page has the same points in all books.
Mesh book(Index pages, bool triangles) {
  std::vector<Eigen::Vector3d> positions;
  for (Index j = 0; j <= page_size; ++j) positions.push_back({0.2 * j * j, 1.0 * j, 0.1 * j});
  std::vector<std::vector<Index>> faces;
  for (Index page = 0; page < pages; ++page) {
    const auto first = static_cast<Index>(positions.size());
    const auto at = [&](Index i, Index j) { return i == 0 ? j : first + (i - 1) * (page_size + 1) + j; };
    for (Index i = 1; i <= page_size; ++i)
      for (Index j = 0; j <= page_size; ++j) {
        const double angle = 0.7 * page + 0.1 * i;
        positions.push_back({i * std::cos(angle) + 0.2 * j * j, 1.0 * j, i * std::sin(angle) + 0.1 * i * j});
      }
    for (Index i = 0; i < page_size; ++i)
      for (Index j = 0; j < page_size; ++j) {
        const Index a = at(i, j), b = at(i + 1, j), c = at(i + 1, j + 1), d = at(i, j + 1);
        if (triangles)
          faces.insert(faces.end(), {{a, b, c}, {a, c, d}});
        else
          faces.push_back({a, b, c, d});
      }
  }
  Mesh mesh = make_mesh(positions, faces);
  // Ends of a spine stay where they are; that of a single page would not, if two triangles are there.
  if (triangles) mesh.corners = {{0, infinite_sharpness}, {page_size, infinite_sharpness}};
  return mesh;
}

/// Triangles (i, i + 1, 0) around a pole, with one more (i, 0, 0) at each of them: the edge (0, 0) has as many sheets.
Mesh folded_pole(Index sheets) {
  std::vector<Eigen::Vector3d> positions{{0, 0, 1}};
  std::vector<std::vector<Index>> faces;
  for (Index i = 0; i < sheets; ++i) {
    positions.push_back({std::cos(6.28 * i / sheets), std::sin(6.28 * i / sheets), 0.1 * (i % 3)});
    const Index here = 1 + i, next = 1 + (i + 1) % sheets;
    faces.push_back({here, next, 0});
    faces.push_back({here, 0, 0});
  }
  return make_mesh(positions, faces);
}

struct Count {
  size_t types = 0;
  Index most_points = 0;
};

/// Types of pieces of level 1 and of two generations of their children.
Count count_types(const std::string& name, const Mesh& mesh) {
  const Scheme<double> scheme = find_scheme(name).value();
  const Level level = next_level(scheme, control_level(scheme, mesh));
  const Topology& t = level.topology();
  PieceTypes types(scheme);
  PieceWalker walker;
  Count count;
  const auto look = [&](const Piece& piece) {
    const PieceType& type =
        *types.type(level, piece, walker.walk(level, piece, types.rings(level.sharpness), scheme.period));
    count.most_points = std::max(count.most_points, type.num_slots());
    for (const PieceLink& child : type.children()) child.type->children();
  };
  const auto of_faces = t.uniform_face_size() == 3 ? Piece::Kind::triangle : Piece::Kind::quad;
  for (Index h = 0; h < t.num_half_edges(); ++h)
    if (scheme.is_dual())
      look({Piece::Kind::corner, HalfEdge{h}});
    else if (t.first(t.face(HalfEdge{h})) == HalfEdge{h})
      look({of_faces, HalfEdge{h}});
  count.types = types.size();
  return count;
}

class SheetTypes : public ::testing::TestWithParam<std::string> {
 protected:
  static bool triangles() { return find_scheme(GetParam()).value().face_size() == 3; }
};

TEST_P(SheetTypes, AreThoseOfOnePageHoweverManyThereAre) {
  const Count one = count_types(GetParam(), book(1, triangles())),
              many = count_types(GetParam(), book(12, triangles()));
  EXPECT_EQ(many.types, one.types);
  EXPECT_EQ(many.most_points, one.most_points);
}

TEST_P(SheetTypes, LimitsOfAPageAreThoseOfThePageAlone) {
  const Mesh one = book(1, triangles()), many = book(5, triangles());
  const Scheme<double> scheme = find_scheme(GetParam()).value();
  const LimitMap alone(scheme, control_level(scheme, one)), shared(scheme, control_level(scheme, many));
  std::vector<Place> samples;
  for (Index f = 0; f < static_cast<Index>(one.face_sizes.size()); ++f)
    for (const auto& [u, v] : {std::pair{0.0, 0.0}, {0.25, 0.125}, {0.0, 0.5}, {0.5, 0.0}, {0.625, 0.25}})
      samples.push_back({f, u, v});
  const Points a = alone.evaluate(one.positions, samples, 0, false).position,
               b = shared.evaluate(many.positions, samples, 0, false).position;
  EXPECT_LE((a - b).cwiseAbs().maxCoeff(), other_route * a.cwiseAbs().maxCoeff());
}

INSTANTIATE_TEST_SUITE_P(Schemes, SheetTypes,
                         ::testing::Values("kobbelt", "butterfly", "catmull-clark", "loop", "averaging"));

TEST(FoldedFaces, ComeToRepeatThemselves) {
  for (const std::string name : {"catmull-clark", "averaging"}) {
    const Count few = count_types(name, folded_pole(4)), many = count_types(name, folded_pole(16));
    EXPECT_EQ(many.most_points, few.most_points) << name;
    EXPECT_EQ(many.types, few.types) << name;
  }
}

}  // namespace
}  // namespace sublimit::testing
