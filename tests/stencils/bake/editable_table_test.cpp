// SPDX-License-Identifier: Apache-2.0
// After any edits a table makes what a new table of the edited mesh makes.
#include "sublimit/stencils/bake/editable_table.h"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <utility>
#include <vector>

#include "laws/tested_schemes.h"
#include "meshes/meshes.h"
#include "sublimit/stencils/bake/detail/bake.h"
#include "support/expect_error.h"
#include "support/tolerance.h"

namespace sublimit::testing {
namespace {

constexpr int level = 2;

/// Points of all faces, by face, u and v.
using Made = std::map<std::tuple<Index, double, double>, double>;

std::vector<double> control_values(Index count) {
  std::vector<double> values(static_cast<size_t>(count));
  for (size_t i = 0; i < values.size(); ++i) values[i] = std::sin(1.0 + 7.0 * double(i));
  return values;
}

Made made_by(const EditableTable<double>& table) {
  std::vector<double> result(static_cast<size_t>(table.num_points()));
  table.apply(control_values(table.num_control_points()), 1, result);
  Made made;
  Index number = 0;
  for (Index f = 0; f < table.num_faces(); ++f) {
    if (table.is_removed(f)) continue;
    table.lattice().for_each([&](Index i, Index j) {
      const LatticePlace place{0, static_cast<std::int8_t>(table.turn(f)), -1};
      const AddressParameters p = address_parameters(table.lattice(), place, i, j);
      made[{number, p.u, p.v}] = result[size_t(table.point(f, table.lattice().row(i, j)))];
    });
    ++number;
  }
  return made;
}

Made made_by(const Baked& baked) {
  const auto& table = baked.table.table;
  const FaceLattices& lattices = *baked.table.lattices;
  std::vector<double> result(static_cast<size_t>(table.num_points()));
  table.apply(control_values(table.num_control_points()), 1, result);
  Made made;
  for (Index f = 0; f < lattices.num_faces(); ++f)
    lattices.lattice().for_each([&](Index i, Index j) {
      const AddressParameters p = lattices.parameters(f, i, j);
      made[{f, p.u, p.v}] = result[size_t(lattices.point(f, lattices.lattice().row(i, j)))];
    });
  return made;
}

void expect_a_new_table(const EditableTable<double>& table, Patterns& patterns, bool limit = false) {
  BakeRequest request;
  if (limit) request.rows = TableRows::limit;
  request.level = level;
  request.method = BakeMethod::patterns;
  const Made expected = made_by(bake(patterns, table.mesh(), request)), found = made_by(table);
  ASSERT_EQ(found.size(), expected.size());
  double largest = 0;
  auto at = expected.begin();
  for (const auto& [place, value] : found) {
    ASSERT_EQ(place, at->first);
    largest = std::max(largest, std::abs(value - (at++)->second));
  }
  EXPECT_LE(largest, rounding(4 * level));
}

/// A face pushed out: its place is taken by a new one, with walls around.
MeshEdit extrusion(const EditableTable<double>& table, Index face) {
  const Mesh mesh = table.mesh();
  Index number = 0;
  for (Index f = 0; f < face; ++f) number += !table.is_removed(f);
  const size_t sides = size_t(mesh.face_sizes[0]);
  const std::vector<Index> c(mesh.face_vertices.begin() + std::ptrdiff_t(sides) * number,
                             mesh.face_vertices.begin() + std::ptrdiff_t(sides) * (number + 1));
  MeshEdit edit;
  edit.removed_faces = {face};
  edit.added_vertices = static_cast<Index>(sides);
  const Index first = table.num_control_points();
  std::vector<Index> top;
  for (size_t k = 0; k < sides; ++k) {
    const Index a = static_cast<Index>(k), b = static_cast<Index>((k + 1) % sides);
    top.push_back(first + a);
    if (sides == 4) {
      edit.added_faces.push_back({c[k], c[size_t(b)], first + b, first + a});
    } else {
      edit.added_faces.push_back({c[k], c[size_t(b)], first + b});
      edit.added_faces.push_back({c[k], first + b, first + a});
    }
  }
  edit.added_faces.push_back(top);
  return edit;
}

class EditableTables : public ::testing::TestWithParam<TestedScheme> {
 protected:
  const Scheme<double> scheme_ = GetParam().scheme();
  Mesh mesh() const {
    const Hardness hard{.open = true, .sharp = scheme_.sharpening != Sharpening::boundary};
    if (takes_triangles(scheme_)) return hard_triangles(5, hard);
    return torus(7, 6);
  }
};

TEST_P(EditableTables, FollowExtrusionsRemovalsAndTags) {
  for (const bool limit : {false, true}) {
    SCOPED_TRACE(limit ? "limits" : "points");
    Patterns patterns(scheme_);
    EditableTable<double> table(mesh(), patterns.scheme(), {.levels = level, .limit = limit});
    std::mt19937 random(3);
    for (int step = 0; step < 8; ++step) {
      SCOPED_TRACE("step " + std::to_string(step));
      Index face = 0;
      do face = static_cast<Index>(random() % unsigned(table.num_faces()));
      while (table.is_removed(face));
      MeshEdit edit = extrusion(table, face);
      if (step % 4 == 1) {
        edit = {};
        edit.removed_faces = {face};
      }
      if (step % 4 == 2 && scheme_.sharpening != Sharpening::boundary) {
        const Mesh now = table.mesh();
        edit = {};
        edit.creases = {{now.face_vertices[0], now.face_vertices[1], 10}};
        edit.corners = {{now.face_vertices[2], 10}};
      }
      const auto change = table.edit(edit);
      EXPECT_FALSE(change.faces.empty());
      expect_a_new_table(table, patterns, limit);
    }
  }
}

TEST_P(EditableTables, MoveWithWhatTheyReferTo) {
  Patterns patterns(scheme_);
  std::vector<EditableTable<double>> tables;
  for (int i = 0; i < 5; ++i) {  // moved as the vector grows, with and without edits
    tables.emplace_back(mesh(), scheme_, EditableTableOptions{.levels = level});
    if (i % 2 == 0) tables.back().edit(extrusion(tables.back(), i));
  }
  for (const EditableTable<double>& table : tables) expect_a_new_table(table, patterns);
  std::swap(tables[0], tables[1]);
  tables.erase(tables.begin() + 2);
  tables[2].edit(extrusion(tables[2], 4));
  for (const EditableTable<double>& table : tables) expect_a_new_table(table, patterns);
  EditableTable<double> moved(std::move(tables.back()));
  tables.clear();
  moved.edit(extrusion(moved, 9));
  expect_a_new_table(moved, patterns);
}

TEST_P(EditableTables, AreEditedApartFromTheirCopies) {
  Patterns patterns(scheme_);
  EditableTable<double> table(mesh(), patterns.scheme(), {.levels = level});
  table.edit(extrusion(table, 2));
  EditableTable<double> copy = table;
  const Made before = made_by(copy);
  table.edit(extrusion(table, 5));
  EXPECT_EQ(made_by(copy), before);
  copy.edit(extrusion(copy, 7));
  expect_a_new_table(copy, patterns);
  expect_a_new_table(table, patterns);
}

class EditableCreases : public EditableTables {};

TEST_P(EditableCreases, CanBeTakenAway) {
  Patterns patterns(scheme_);
  EditableTable<double> table(mesh(), patterns.scheme(), {.levels = level});
  const Made before = made_by(table);
  const Mesh now = table.mesh();
  const Index a = now.face_vertices[0], b = now.face_vertices[1];
  float was = 0;
  for (const auto& crease : now.creases)
    if ((crease.tail == a && crease.head == b) || (crease.tail == b && crease.head == a)) was = crease.sharpness;
  MeshEdit edit;
  edit.creases = {{a, b, was > 0 ? 0.0f : 10.0f}};
  table.edit(edit);
  expect_a_new_table(table, patterns);
  EXPECT_NE(made_by(table), before);
  edit.creases = {{a, b, was}};
  table.edit(edit);
  EXPECT_EQ(made_by(table), before);
}

bool is_editable(const Scheme<double>& scheme) { return Patterns::is_possible(scheme) && scheme.period == 1; }
INSTANTIATE_TEST_SUITE_P(Schemes, EditableTables, ::testing::ValuesIn(schemes_and_degrees_if(is_editable)), test_name);
INSTANTIATE_TEST_SUITE_P(Schemes, EditableCreases,
                         ::testing::ValuesIn(schemes_and_degrees_if([](const Scheme<double>& scheme) {
                           return is_editable(scheme) && scheme.sharpening != Sharpening::boundary;
                         })),
                         test_name);

/// The diagonal of two triangles turned.
TEST(EditableTable, FollowsFlippedEdges) {
  const Scheme<double> scheme = find_scheme("loop").value();
  Patterns patterns(scheme);
  EditableTable<double> table(triangle_torus(8, 7), patterns.scheme(), {.levels = level});
  const Mesh mesh = table.mesh();
  // Faces f and g on both sides of an edge (a, b).
  const auto corners = [&](Index f) {
    return std::vector<Index>(mesh.face_vertices.begin() + 3 * f, mesh.face_vertices.begin() + 3 * f + 3);
  };
  const std::vector<Index> f = corners(0);
  const Index a = f[0], b = f[1], c = f[2];
  for (Index g = 1; g < mesh.num_faces(); ++g) {
    const std::vector<Index> other = corners(g);
    for (size_t k = 0; k < 3; ++k) {
      if (other[k] != b || other[(k + 1) % 3] != a) continue;
      const Index d = other[(k + 2) % 3];
      MeshEdit edit;
      edit.removed_faces = {0, g};
      edit.added_faces = {{a, d, c}, {d, b, c}};
      const auto change = table.edit(edit);
      EXPECT_LE(change.faces.size(), 24u);
      expect_a_new_table(table, patterns);
      return;
    }
  }
  FAIL() << "no face beside face 0";
}

TEST(EditableTable, BadEditsAreErrorsAndChangeNothing) {
  const Scheme<double> scheme = find_scheme("catmull-clark").value();
  Patterns patterns(scheme);
  EditableTable<double> table(torus(5, 5), patterns.scheme(), {.levels = level});
  const Made before = made_by(table);
  const auto refused = [&](auto change, std::initializer_list<std::string_view> words) {
    MeshEdit edit;
    change(edit);
    expect_error<InvalidParameter>([&] { table.edit(edit); }, words);
  };
  refused([](MeshEdit& e) { e.removed_faces = {25}; }, {"face 25 does not exist"});
  refused([](MeshEdit& e) { e.removed_faces = {-1}; }, {"face -1"});
  refused([](MeshEdit& e) { e.added_faces = {{0, 1, 2, 25}}; }, {"vertex 25"});
  refused([](MeshEdit& e) { e.creases = {{0, 12, 1}}; }, {"no face has an edge", "0 and 12"});
  refused([](MeshEdit& e) { e.corners = {{3, -1}}; }, {"sharpness"});
  refused([](MeshEdit& e) { e.added_vertices = -1; }, {"negative"});
  MeshEdit triangle;
  triangle.added_faces = {{0, 1, 2}};
  expect_error<UnsupportedTopology>([&] { table.edit(triangle); }, {"3 corners"});
  EXPECT_EQ(made_by(table), before);
  std::vector<double> few(3), out(3);
  expect_error<InvalidParameter>([&] { table.apply(few, 1, out); }, {"hold 3", "25"});
}

}  // namespace
}  // namespace sublimit::testing
