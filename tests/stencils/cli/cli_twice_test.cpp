// SPDX-License-Identifier: Apache-2.0
// Refining twice by 1 is refining once by 2, bit for bit: written files carry all that the next step needs to know.
#include <gtest/gtest.h>

#include <set>

#include "meshes/meshes.h"
#include "stencils/cli_program.h"
#include "sublimit/core/detail/sparse_product.h"
#include "sublimit/io/detail/obj.h"
#include "sublimit/schemes/schemes.h"
#include "sublimit/stencils/files/level_files.h"

namespace sublimit::testing {
namespace {

/// What the program writes for `levels` levels.
std::string refined(const Scheme<double>& scheme, const Mesh& mesh, int levels) {
  const std::vector<Level> all = refine(scheme, mesh, levels);
  Points points = mesh.positions;
  for (int k = 1; k <= levels; ++k) points = apply(all[k].S, points);
  return format_obj(level_output(all.back(), points, mesh, {}, true));
}

Mesh with_rules(Mesh mesh, Boundary boundary, Creasing creasing) {
  mesh.boundary = boundary;
  mesh.creasing = creasing;
  return mesh;
}

/// Whether two meshes of the same faces are joined alike.
bool joined_alike(const Topology& a, const Topology& b) {
  if (a.num_half_edges() != b.num_half_edges() || a.num_edges() != b.num_edges()) return false;
  for (Index h = 0; h < a.num_half_edges(); ++h)
    if (a.twin(HalfEdge{h}) != b.twin(HalfEdge{h}) || a.edge(HalfEdge{h}) != b.edge(HalfEdge{h})) return false;
  return true;
}

/// Whether connectivity makes an edge or vertex sharper than it is.
bool implied_sharper(const Level& level, Boundary boundary) {
  const Sharpness implied = initial_sharpness(level.topology(), {}, boundary, level.sharpness.creasing);
  for (size_t e = 0; e < implied.edge.size(); ++e)
    if (implied.edge[e] > level.sharpness.edge[e]) return true;
  for (size_t v = 0; v < implied.vertex.size(); ++v)
    if (implied.vertex[v] > level.sharpness.vertex[v]) return true;
  return false;
}

// Two things no file can say, and the only meshes that have them. Where two edges join the same two vertices, or an
// edge returns to its vertex, a reader of the children finds other neighbours:
const std::set<std::string> joined_otherwise{"cubes_share_a_wall_triangles",   "degenerate_edge",
                                             "degenerate_edge_at_boundary",    "degenerate_edge_in_quad",
                                             "degenerate_edges_three",         "degenerate_triangle",
                                             "triangle_at_one_vertex",         "valence_2_triangles",
                                             "triangle_visits_a_vertex_twice", "valence_2_at_crowded_edge"};
// The middle of an edge that one face, or two wound alike, use twice is no corner, but looks like one:
const std::set<std::string> looks_sharper{"quad_visits_a_vertex_twice", "spike_in_face"};

TEST(RefinedMesh, TwiceByOneIsOnceByTwo) {
  int count = 0;
  for (const NamedMesh& named : tagged_meshes()) {
    if (named.mesh.num_faces() > 150) continue;
    for (const std::string& name : named.schemes) {
      for (const Boundary boundary : {Boundary::none, Boundary::edge_only, Boundary::edge_and_corner})
        for (const Creasing creasing : {Creasing::uniform, Creasing::chaikin}) {
          const Scheme<double> scheme = find_scheme(name).value();
          const Mesh mesh = with_rules(named.mesh, boundary, creasing);
          const Mesh first = parse_obj(refined(scheme, mesh, 1), named.name);
          const Level level = refine(scheme, mesh, 1)[1];
          if (joined_otherwise.contains(named.name) && !joined_alike(Topology(view(first)), level.topology())) continue;
          if (looks_sharper.contains(named.name) && implied_sharper(level, first.boundary.value())) continue;
          EXPECT_TRUE(refined(scheme, first, 1) == refined(scheme, mesh, 2))
              << named.name << ", " << name << ", boundary " << int(boundary) << ", creasing " << int(creasing);
          ++count;
        }
    }
  }
  EXPECT_GT(count, 300);
}

TEST(RefinedMesh, LevelZeroIsTheMeshAgain) {
  for (const NamedMesh& named : tagged_meshes()) {
    const Scheme<double> scheme = find_scheme(named.schemes[0]).value();
    for (const Boundary boundary : {Boundary::none, Boundary::edge_only, Boundary::edge_and_corner}) {
      const Mesh mesh = with_rules(named.mesh, boundary, Creasing::chaikin);
      const Mesh again = parse_obj(refined(scheme, mesh, 0), named.name);
      EXPECT_TRUE(refined(scheme, again, 2) == refined(scheme, mesh, 2))
          << named.name << ", boundary " << int(boundary);
    }
  }
}

TEST(RefinedMesh, BoundaryNoneWritesItsHoles) {
  const Scheme<double> scheme = find_scheme("catmull-clark").value();
  const Mesh mesh = with_rules(grid(4, 4), Boundary::none, Creasing::uniform);
  const std::vector<Level> levels = refine(scheme, mesh, 1);
  const Mesh again = parse_obj(refined(scheme, mesh, 1), "grid.obj");
  EXPECT_EQ(again.holes.size(), 4u * (16 - 4));  // the faces at the rim, refined
  const Level level = control_level(scheme, again);
  EXPECT_EQ(level.holes, levels[1].holes);
}

TEST(RefinedMesh, WritesOnlyWhatConnectivityDoesNotImply) {
  const Scheme<double> scheme = find_scheme("catmull-clark").value();
  const Mesh open = parse_obj(refined(scheme, grid(3, 2), 1), "grid.obj");
  EXPECT_TRUE(open.creases.empty() && open.corners.empty() && open.holes.empty());
  Mesh creased = grid(3, 2);
  add_crease(creased, {1, 5, 9}, 1.5f);  // across, from rim to rim
  const Mesh child = parse_obj(refined(scheme, creased, 1), "grid.obj");
  ASSERT_EQ(child.creases.size(), 4u);
  for (const Mesh::Crease& crease : child.creases) EXPECT_EQ(crease.sharpness, 0.5f);
}

// The same through files and processes, with options on the command line instead of tags.
TEST(CliRefine, TwiceByOneIsOnceByTwo) {
  Mesh tagged = jittered(grid(4, 3));
  add_crease(tagged, {6, 7, 8}, {2.25f, 1.5f});
  tagged.corners.push_back({12, 1.75f});
  tagged.holes.push_back(2);
  Mesh mixed = jittered(polygon_ring({5, 4, 3, 6, 4}));
  mixed.triangles = Triangles::smooth;
  const TemporaryDirectory directory;
  const auto path = [&](const char* name) { return (directory / name).string(); };
  int number = 0;
  for (const Mesh& mesh : {tagged, mixed, fan(5)})
    for (const char* boundary : {"", "none", "edge-only", "edge-and-corner"})
      for (const char* creasing : {"uniform", "chaikin"}) {
        SCOPED_TRACE(std::to_string(number++) + " " + boundary + " " + creasing);
        write_obj(directory / "mesh.obj", mesh);
        std::vector<std::string> options{"-s", "catmull-clark", "--creasing", creasing};
        if (*boundary) options.insert(options.end(), {"--boundary", boundary});
        const auto run = [&](const char* from, const char* levels, const char* to, bool with_options) {
          std::vector<std::string> arguments{"refine", path(from), "-l", levels, "-o", path(to)};
          if (with_options) {
            arguments.insert(arguments.end(), options.begin(), options.end());
          } else {
            arguments.insert(arguments.end(), {"-s", "catmull-clark"});  // the rest is in the tags
          }
          expect_done(sublimit(arguments));
        };
        run("mesh.obj", "1", "one.obj", true);
        run("one.obj", "1", "twice.obj", false);
        run("mesh.obj", "2", "once.obj", true);
        EXPECT_EQ(read_file(directory / "twice.obj"), read_file(directory / "once.obj"));
      }
}

}  // namespace
}  // namespace sublimit::testing
