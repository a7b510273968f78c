// SPDX-License-Identifier: Apache-2.0
// The weights of a vertex's limit have one origin: the limit's matrix, a baked table and stencils at the corners of
// faces have the same bits.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "laws/tested_schemes.h"
#include "meshes/shared_meshes.h"
#include "sublimit/io/read_mesh.h"
#include "sublimit/limit/detail/limit_points.h"
#include "sublimit/scheme/detail/prepare.h"
#include "sublimit/stencils/bake/detail/bake.h"
#include "sublimit/surface/limit_map.h"

namespace sublimit::testing {
namespace {

using Row = std::vector<std::pair<Index, double>>;

Row row_of(const SparseMatrix& M, Index r) {
  Row row;
  for (SparseMatrix::InnerIterator it(M, r); it; ++it)
    if (it.value() != 0) row.emplace_back(it.col(), it.value());
  return row;
}

Row row_of(const StencilTable<double>& table, std::int64_t r) {
  Row row;
  for (std::int64_t k = table.offsets()[r]; k < table.offsets()[r + 1]; ++k)
    if (table.weights()[k] != 0) row.emplace_back(table.columns()[k], table.weights()[k]);
  std::sort(row.begin(), row.end());
  return row;
}

Row row_of(const LimitStencil& stencil) {
  Row row;
  for (size_t i = 0; i < stencil.vertices.size(); ++i)
    if (stencil.weights(0, Eigen::Index(i)) != 0)
      row.emplace_back(stencil.vertices[i], stencil.weights(0, Eigen::Index(i)));
  return row;
}

/// How many vertices were compared by each door.
struct Compared {
  int baked = 0, sampled = 0;
};

void expect_one_origin(const Scheme<double>& scheme, const Mesh& mesh, const SubdivisionOptions& options,
                       Compared& compared) {
  const Level level = control_level(scheme, mesh, options);
  const Topology& t = level.topology();
  LimitCache cache(scheme);
  const LimitMatrices limit = limit_matrices(level, cache);

  Patterns patterns(scheme);
  BakeRequest request;
  request.rows = TableRows::limit;
  request.order = true;
  const Baked baked = bake(patterns, mesh, request, options);
  const StencilTable<double> table = baked.table.table.expanded();
  const std::span<const std::int64_t> points = baked.table.refined_points.span();
  ASSERT_EQ(points.size(), size_t(t.num_vertices()));
  for (Index v = 0; v < t.num_vertices(); ++v) {
    const std::int64_t point = points[size_t(v)];
    if (point < 0) continue;  // in no face that the table has
    ASSERT_EQ(row_of(table, point), row_of(limit.position, v)) << scheme.name << ": vertex " << v << " in a table";
    ++compared.baked;
  }

  const LimitMap surface(scheme, mesh, options);
  const Addresses& addresses = surface.addresses();
  for (Index address = 0; address < addresses.size(); ++address) {
    const Addresses::FaceCorner at = addresses.place(address);
    const std::vector<std::pair<double, double>> corners =
        at.corner >= 0          ? std::vector<std::pair<double, double>>{{0, 0}}
        : addresses.triangles() ? std::vector<std::pair<double, double>>{{0, 0}, {1, 0}, {0, 1}}
                                : std::vector<std::pair<double, double>>{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    for (size_t k = 0; k < corners.size(); ++k) {
      const Vertex v = t.tail(t.corner(at.face, at.corner >= 0 ? at.corner : Index(k)));
      if (scheme.is_dual() && t.is_nonmanifold(v)) continue;  // each of its sheets has a limit of its own
      // Left to do: at a vertex of two faces the parameters of mid-edge surfaces lead to the middle of the face
      // opposite.
      if (scheme.name.starts_with("mid-edge") && t.num_faces(v) == 2 && exists(t.twin(t.outgoing(v)))) continue;
      for (const int order : {0, 1})
        ASSERT_EQ(row_of(surface.stencil({address, corners[k].first, corners[k].second}, order)),
                  row_of(limit.position, index(v)))
            << scheme.name << ": vertex " << index(v) << " at corner " << k << " of address " << address;
      ++compared.sampled;
    }
  }
}

class OneOrigin : public ::testing::TestWithParam<TestedScheme> {};

TEST_P(OneOrigin, OfAVertexsLimit) {
  const Scheme<double> scheme = GetParam().scheme();
  Compared compared;
  for (const Mesh& mesh : hard_meshes(scheme, 3)) expect_one_origin(scheme, mesh, {}, compared);
  EXPECT_GT(compared.baked, 20);
  EXPECT_GT(compared.sampled, 20);
}

INSTANTIATE_TEST_SUITE_P(AllSchemes, OneOrigin, ::testing::ValuesIn(schemes_and_degrees()), test_name);

TEST(OneOrigin, OfTaggedMeshes) {
  if (shared_meshes().empty()) GTEST_SKIP() << "NO SHARED MESHES at " << SUBLIMIT_SHARED_MESHES;
  for (const SharedMesh& shared : shared_meshes()) {
    SCOPED_TRACE(shared.name);
    const Mesh mesh = read_mesh(shared.path);
    if (mesh.num_faces() > 1000) continue;
    const Scheme<double> scheme = *find_scheme(shared.scheme);
    Compared compared;
    expect_one_origin(scheme, mesh, {}, compared);
    EXPECT_GT(compared.baked + compared.sampled, 0);
  }
}

}  // namespace
}  // namespace sublimit::testing
