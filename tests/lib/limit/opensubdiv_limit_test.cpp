// SPDX-License-Identifier: Apache-2.0
// Limits against OpenSubdiv, live, on the kinds of vertex where its limit masks are exact.
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <set>

#include "meshes/meshes.h"
#include "meshes/shared_meshes.h"
#include "peers/compare_with_opensubdiv.h"
#include "sublimit/core/detail/sparse_product.h"
#include "sublimit/io/read_mesh.h"
#include "sublimit/limit/detail/limit_points.h"
#include "support/tolerance.h"

namespace sublimit::testing {
namespace {

/// Where the reference is exact (found by comparison with brute force): position at smooth interior vertices, creases
/// and corners whose sharpness no longer changes and whose faces are all regular, other than Catmull-Clark's valence 2.
bool exact_position(const ReferenceVertex& v, const std::string& scheme) {
  if (v.semisharp || v.irregular_face) return false;
  if (v.rule == ReferenceVertex::Rule::dart) return false;
  return !(v.rule == ReferenceVertex::Rule::smooth && v.edges == 2 && scheme == "catmull-clark");
}
/// Normals: smooth interior vertices, and the leading side of a crease of at most 2 quads or 3 triangles.
bool exact_normal(const ReferenceVertex& v, const std::string& scheme) {
  if (!exact_position(v, scheme) || v.nonmanifold || v.rule == ReferenceVertex::Rule::corner) return false;
  if (v.rule == ReferenceVertex::Rule::smooth) return v.edges > 2;
  return v.side_corner >= 0 && v.side_faces <= (scheme == "loop" ? 3 : 2);
}

double angle(const Eigen::Vector3d& a, const Eigen::Vector3d& b) { return std::atan2(a.cross(b).norm(), a.dot(b)); }

struct LimitDifferences {
  double position = 0, normal = 0;
  int positions = 0, normals = 0;
};

LimitDifferences compare_limits(const Mesh& mesh, const std::string& name, int levels) {
  LimitDifferences d;
  const Comparison c = compare_with_opensubdiv(mesh, name, levels);
  EXPECT_EQ(c.mismatch, "");
  const Scheme<double> scheme = scheme_for(mesh, name);
  const std::vector<Level> refined = refine(scheme, mesh, levels);
  Points x = mesh.positions;
  for (int k = 1; k <= levels; ++k) x = apply(refined[k].S, x);
  LimitCache cache(scheme);
  const Level& level = refined.back();
  const LimitMatrices limit = limit_matrices(level, cache);
  const LimitPoints ours = limit_points(limit, level.topology(), x);

  ReferenceOptions options = reference_options(mesh, name, levels);
  options.tangents = true;
  const ReferenceLimit theirs = reference_limit(mesh, options);
  const std::vector<ReferenceLevel> levels_of_theirs = reference_refine(mesh, options);
  const ReferenceLevel& last = levels_of_theirs.back();
  std::vector<std::pair<Index, Index>> corner_at;  // reference corner -> (vertex, next vertex)
  for (size_t f = 0, corner = 0; f < last.face_sizes.size(); ++f) {
    for (Index k = 0; k < last.face_sizes[f]; ++k)
      corner_at.push_back({last.face_vertices[corner + k], last.face_vertices[corner + (k + 1) % last.face_sizes[f]]});
    corner += last.face_sizes[f];
  }
  const double size = diagonal(mesh.positions);
  const Topology& t = level.topology();
  for (Index v = 0; v < t.num_vertices(); ++v) {
    const Index r = c.vertex_map[v];
    const ReferenceVertex& kind = theirs.vertex[r];
    if (!exact_position(kind, name)) continue;
    d.position = std::max(d.position, (ours.position.row(v) - theirs.position.row(r)).norm() / size);
    ++d.positions;
    if (theirs.tangent1.rows() == 0 || !exact_normal(kind, name) || !exists(t.outgoing(Vertex{v}))) continue;
    const Eigen::Vector3d t1 = theirs.tangent1.row(r), t2 = theirs.tangent2.row(r), normal = t1.cross(t2);
    if (normal.norm() <= 1e-7 * t1.norm() * t2.norm() || normal.norm() <= 1e-9 * size * size) continue;
    Index side = -1;
    for (const HalfEdge start : t.fans(Vertex{v})) {
      HalfEdge h = start;
      do {
        const bool leading =
            kind.side_corner < 0 ||
            (corner_at[kind.side_corner] == std::pair(c.vertex_map[index(t.tail(h))], c.vertex_map[index(t.head(h))]));
        if (leading) side = limit.corner_side[index(h)];
        h = t.ccw(h);
      } while (exists(h) && h != start && side < 0);
    }
    if (side < 0) {
      ADD_FAILURE() << "vertex " << v << ": the reference's side was not found";
      continue;
    }
    if (ours.status[side] == LimitStatus::hole) continue;  // not part of the limit, and without a normal
    d.normal = std::max(d.normal, angle(ours.normal.row(side), normal));
    ++d.normals;
    if (angle(ours.normal.row(side), normal) > reference_angle && d.normals < 100000) {
      ADD_FAILURE() << "normal of vertex " << v << " with " << kind.faces << " faces differs by "
                    << angle(ours.normal.row(side), normal);
      return d;
    }
  }
  return d;
}

class TaggedMeshLimit : public ::testing::TestWithParam<NamedMesh> {};

TEST_P(TaggedMeshLimit, EqualsOpenSubdiv) {
  for (const std::string& scheme : GetParam().schemes) {
    if (scheme == "bilinear" || GetParam().name.starts_with("chain_uneven_chaikin")) continue;
    SCOPED_TRACE(scheme);
    for (int level = 0; level <= 2; ++level) {
      const LimitDifferences d = compare_limits(GetParam().mesh, scheme, level);
      EXPECT_LE(d.position, reference) << "level " << level;
      EXPECT_LE(d.normal, reference_angle) << "level " << level;
    }
  }
}
INSTANTIATE_TEST_SUITE_P(OpenSubdiv, TaggedMeshLimit, ::testing::ValuesIn(tagged_meshes()),
                         [](const auto& tested) { return tested.param.name; });

/// What the comparison is worth: without these kinds of vertex it would compare less than README says.
TEST(TaggedMeshLimits, AreComparedAtEveryKindOfVertex) {
  constexpr const char* words[] = {"smooth", "dart", "crease", "corner"};
  for (const std::string scheme : {"catmull-clark", "loop"}) {
    std::set<std::string> positions, normals;
    for (const NamedMesh& named : tagged_meshes()) {
      if (std::ranges::find(named.schemes, scheme) == named.schemes.end()) continue;
      for (const ReferenceVertex& v : reference_limit(named.mesh, reference_options(named.mesh, scheme, 0)).vertex) {
        if (v.nonmanifold) continue;
        const std::string kind = std::string(v.boundary ? "boundary " : "") + words[int(v.rule)] + " among " +
                                 std::to_string(v.faces) + " faces";
        if (exact_position(v, scheme)) positions.insert(kind);
        if (exact_normal(v, scheme)) normals.insert(kind);
      }
    }
    const auto expect = [&](const std::set<std::string>& compared, const char* what, const std::string& kind, int from,
                            int to) {
      for (int n = from; n <= to; ++n)
        EXPECT_TRUE(compared.contains(kind + " among " + std::to_string(n) + " faces"))
            << scheme << ": no " << what << " of a " << kind << " among " << n << " faces is compared";
    };
    for (const char* kind : {"smooth", "crease", "corner"}) expect(positions, "position", kind, 3, 8);
    expect(positions, "position", "boundary crease", 2, 7);
    expect(positions, "position", "boundary corner", 1, 1);
    expect(normals, "normal", "smooth", 3, 9);
    expect(normals, "normal", "boundary crease", 2, scheme == "loop" ? 3 : 2);
  }
}

class SharedMeshLimit : public ::testing::TestWithParam<SharedMesh> {};

TEST_P(SharedMeshLimit, EqualsOpenSubdiv) {
  if (GetParam().scheme == "bilinear") return;
  const Mesh mesh = read_mesh(GetParam().path);
  const LimitDifferences d = compare_limits(mesh, GetParam().scheme, full_sweep() ? 2 : 1);
  EXPECT_LE(d.position, reference);
  EXPECT_LE(d.normal, reference_angle);
  RecordProperty("positions", d.positions);
  RecordProperty("normals", d.normals);
}
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(SharedMeshLimit);
INSTANTIATE_TEST_SUITE_P(Full, SharedMeshLimit, ::testing::ValuesIn(shared_meshes()),
                         [](const auto& tested) { return tested.param.name; });

}  // namespace
}  // namespace sublimit::testing
