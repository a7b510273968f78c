// SPDX-License-Identifier: Apache-2.0
// What a file has stays with it, through the verbs as people type them: names of faces and colours of vertices, tags
// that are asked for, sidecars.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>

#include "stencils/cli_tables.h"
#include "sublimit/mesh/detail/attributes.h"
#include "sublimit/stencils/formats/formats.h"
#include "support/tolerance.h"

namespace sublimit::testing {
namespace {

/// A cube whose faces have the names of their side, and whose vertices have their place as a colour.
Mesh named_cube() {
  Mesh mesh = cube();
  mesh.material_files = {"scene.mtl"};
  mesh.objects = {{"box"}, {0, 0, 0, 0, 0, 0}};
  const char* const names[] = {"left", "right", "front", "back", "low", "high"};
  std::vector<Index> first{0};
  for (const Index size : mesh.face_sizes) first.push_back(first.back() + size);
  for (Index f = 0; f < 6; ++f) {
    Eigen::RowVector3d middle(0, 0, 0);
    for (Index k = 0; k < 4; ++k) middle += mesh.positions.row(mesh.face_vertices[size_t(first[size_t(f)] + k)]) / 4;
    Eigen::Index axis = 0;
    middle.cwiseAbs().maxCoeff(&axis);
    const Index side = static_cast<Index>(2 * axis) + (middle[axis] > 0 ? 1 : 0);
    mesh.materials.of_face.push_back(side);
    mesh.groups.of_face.push_back(side / 2);
    mesh.smoothing_groups.of_face.push_back(side % 2);
  }
  mesh.materials.names.assign(std::begin(names), std::end(names));
  mesh.groups.names = {"x", "y", "z"};
  mesh.smoothing_groups.names = {"1", "off"};
  for (Eigen::Index k = 0; k < 3; ++k) {
    mesh.vertex_values.push_back({colour_names[size_t(k)], {}, ValueType::float32});
    for (Index v = 0; v < 8; ++v) mesh.vertex_values.back().values.push_back(mesh.positions(v, k) / 4 + 0.5);
  }
  return mesh;
}

/// Every face is on the side that its names say, which the limit of a cube keeps by symmetry.
void expect_sides(const Mesh& mesh, const std::string& what) {
  SCOPED_TRACE(what);
  ASSERT_EQ(std::ssize(mesh.materials.of_face), mesh.num_faces());
  ASSERT_EQ(mesh.groups.of_face.size(), mesh.materials.of_face.size());
  ASSERT_EQ(mesh.smoothing_groups.of_face.size(), mesh.materials.of_face.size());
  EXPECT_EQ(mesh.material_files, std::vector<std::string>{"scene.mtl"});
  EXPECT_EQ(std::set<Index>(mesh.materials.of_face.begin(), mesh.materials.of_face.end()).size(), 6u);
  const Mesh named = named_cube();
  size_t corner = 0;
  for (Index f = 0; f < mesh.num_faces(); ++f) {
    const Index size = mesh.face_sizes[size_t(f)];
    Eigen::RowVector3d middle(0, 0, 0);
    for (Index k = 0; k < size; ++k) middle += mesh.positions.row(mesh.face_vertices[corner++]) / size;
    Eigen::Index axis = 0;
    middle.cwiseAbs().maxCoeff(&axis);
    const auto name = [&](const Mesh::FaceNames& names) { return names.names[size_t(names.of_face[size_t(f)])]; };
    EXPECT_EQ(name(mesh.materials), named.materials.names[size_t(2 * axis + (middle[axis] > 0))]) << "face " << f;
    EXPECT_EQ(name(mesh.groups), named.groups.names[size_t(axis)]);
    EXPECT_EQ(name(mesh.smoothing_groups), middle[axis] > 0 ? "off" : "1");
    EXPECT_EQ(name(mesh.objects), "box");
  }
}

/// Colours are positions as `named_cube` makes them.
void expect_places(const Mesh& mesh, double tolerance) {
  ASSERT_GE(mesh.vertex_values.size(), 3u);  // places of triangles follow
  for (Eigen::Index k = 0; k < 3; ++k)
    for (Index v = 0; v < mesh.num_vertices(); ++v)
      EXPECT_NEAR(mesh.vertex_values[size_t(k)].values[size_t(v)], mesh.positions(v, k) / 4 + 0.5, tolerance);
}

TEST(CliAttributes, NamesAndColoursGoThroughEveryVerb) {
  for (const std::string format : {".obj", ".ply"}) {
    const Tables on(named_cube());
    const std::string out = on.path("out" + format);
    const auto check = [&](const std::string& what) {
      const Mesh made = read_mesh(out);
      EXPECT_GT(made.num_faces(), 6) << what;
      if (format == ".obj") expect_sides(made, what);
      expect_places(made, 2 * std::numeric_limits<float>::epsilon());  // colours are floats of 0 to 1
    };
    const std::string note =
        ": a PLY file has no place for groups, objects, materials and smoothing groups; written as .obj";
    const auto done = [&](const Outcome& outcome) {
      EXPECT_EQ(outcome.status, 0) << outcome.err;
      EXPECT_EQ(outcome.err.find(note) != std::string::npos, format == ".ply") << outcome.err;
    };
    done(sublimit({"refine", on.mesh, "-s", "catmull-clark", "-l", "2", "-o", out}));
    check("refine");
    done(sublimit(
        {"refine", on.mesh, "-s", "catmull-clark", "-l", "2", "--matrix", on.path("m.mtx"), "--no-tags", "-o", out}));
    check("refine with a matrix");
    done(sublimit({"refine", on.mesh, "-s", "catmull-clark", "-l", "2", "--no-tags", "-o", out}));
    check("refine without tags");
    done(sublimit({"refine", on.mesh, "-s", "loop", "--triangulate", "-l", "2", "-o", out}));
    EXPECT_EQ(read_mesh(out).num_faces(), 12 * 16);
    done(sublimit({"limit", on.mesh, "-s", "catmull-clark", "-l", "1", "--normals", "-o", out}));
    check("limit");
    done(sublimit({"tessellate", on.mesh, "-s", "catmull-clark", "--chord", "1%", "--normals", "-o", out}));
    check("tessellate");
    for (const std::vector<std::string>& table : std::vector<std::vector<std::string>>{
             {"-l", "2"}, {"-l", "2", "--limit", "--derivatives", "1"}, {"--grid", "4"}}) {
      std::vector<std::string> words{"--precision", "double"};
      words.insert(words.end(), table.begin(), table.end());
      expect_done(on.bake(words));
      done(on.apply(on.mesh, out));
      check("bake " + table.front() + " and apply");
    }
  }
}

// Rows of a table do not know their faces, and say so; a table of turned faces knows the mesh as it was.
TEST(CliAttributes, ApplyTellsWhatTablesDoNotKnow) {
  const Tables on(named_cube());
  expect_done(on.bake({"-l", "1"}, "doo-sabin"));
  const Outcome told = on.apply(on.mesh, on.path("out.obj"));
  EXPECT_EQ(told.status, 0);
  EXPECT_NE(told.err.find("names and values of faces are left out"), std::string::npos) << told.err;
  expect_failure(on.bake({"-l", "1", "--attributes", "drop"}), 2, {"--attributes"});
  Mesh turned = named_cube();
  std::reverse(turned.face_vertices.begin() + 1, turned.face_vertices.begin() + 4);
  write_obj(on.mesh, turned);
  expect_done(on.bake({"-l", "1", "--orient", "--precision", "double"}), true);
  expect_done(on.apply(on.mesh, on.path("out.obj")));
  expect_sides(read_mesh(on.path("out.obj")), "turned");
}

// Faces come from faces, edges and vertices; each has names of one beside it.
TEST(CliAttributes, DualSchemesGiveEachFaceTheNamesOfOneBesideIt) {
  const Tables on(named_cube());
  expect_done(sublimit({"refine", on.mesh, "-s", "doo-sabin", "-l", "2", "-o", on.path("out.obj")}));
  const Mesh made = read_mesh(on.path("out.obj"));
  ASSERT_EQ(std::ssize(made.materials.of_face), made.num_faces());
  EXPECT_EQ(std::ranges::count(made.materials.of_face, -1), 0);
  EXPECT_EQ(made.objects.names, std::vector<std::string>{"box"});
}

TEST(CliAttributes, LinearAndDroppedOnes) {
  const Tables on(named_cube());
  const std::string out = on.path("out.obj");
  expect_done(sublimit({"refine", on.mesh, "-s", "catmull-clark", "-l", "1", "--attributes", "linear", "-o", out}));
  Mesh made = read_mesh(out);
  ASSERT_EQ(made.vertex_values.size(), 3u);
  for (size_t k = 0; k < 3; ++k)
    for (Index v = 0; v < 8; ++v)
      EXPECT_EQ(made.vertex_values[k].values[size_t(v)], named_cube().vertex_values[k].values[size_t(v)]);
  expect_done(sublimit({"limit", on.mesh, "-s", "catmull-clark", "--attributes", "linear", "-o", out}));
  EXPECT_EQ(read_mesh(out).vertex_values[1].values, named_cube().vertex_values[1].values);
  for (const std::string verb : {"refine", "limit", "tessellate"}) {
    std::vector<std::string> words{verb, on.mesh, "-s", "catmull-clark", "--attributes", "drop", "-o", out};
    for (const std::string& word :
         verb == "tessellate" ? std::vector<std::string>{"--chord", "5%"} : std::vector<std::string>{"-l", "1"})
      words.push_back(word);
    expect_done(sublimit(words));
    made = read_mesh(out);
    EXPECT_TRUE(made.vertex_values.empty() && made.materials.of_face.empty() && made.material_files.empty()) << verb;
  }
  expect_failure(sublimit({"refine", on.mesh, "-s", "doo-sabin", "-l", "1", "--attributes", "linear", "-o", out}), 2,
                 {"linear attributes", "doo-sabin does not keep"});
  expect_failure(sublimit({"refine", on.mesh, "-s", "loop", "-l", "1", "--attributes", "cubic", "-o", out}), 2,
                 {"--attributes", "smooth"});
}

TEST(CliAttributes, WindingIsMadeConsistent) {
  const TemporaryDirectory directory;
  const std::string mesh =
                        directory
                            .write("flipped.obj",
                                   "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 1 0\nv 1 1 0\nv 2 1 0\nv 0 2 0\nv 1 2 0\nv 2 2 0\n"
                                   "f 1 2 5 4\nf 3 2 5 6\nf 4 5 8 7\nf 5 6 9 8\n")
                            .string(),
                    out = (directory / "out.obj").string();
  const Outcome plain = sublimit({"refine", mesh, "-s", "catmull-clark", "-l", "1", "-o", out});
  EXPECT_NE(
      plain.err.find("faces 0 and 1 use edge (1,4) in the same direction, so that it becomes sharp there; turn one "
                     "of them (--orient)"),
      std::string::npos)
      << plain.err;
  expect_failure(sublimit({"refine", mesh, "-s", "catmull-clark", "-l", "1", "--strict", "-o", out}), 3,
                 {"(--orient)"});
  const Outcome turned =
      sublimit({"refine", mesh, "-s", "catmull-clark", "-l", "1", "--orient", "--strict", "-o", out});
  EXPECT_EQ(turned.status, 0) << turned.err;
  EXPECT_EQ(turned.err, "sublimit: note: " + mesh + ": 1 face turned: 1\n");
  EXPECT_TRUE(read_mesh(out).warnings.empty());
  EXPECT_EQ(sublimit({"info", mesh, "--orient", "--quiet"}).out.find("same direction"), std::string::npos);
}

TEST(CliAttributes, TagsThatAreAskedFor) {
  const Tables on(named_cube());
  const std::string out = on.path("out.obj");
  const auto creases = [&](const std::vector<std::string>& options) {
    std::vector<std::string> words{"refine", on.mesh, "-s", "catmull-clark", "-l", "0", "-o", out};
    words.insert(words.end(), options.begin(), options.end());
    const Outcome outcome = sublimit(words);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return std::pair(read_mesh(out).creases.size(), outcome.err);
  };
  EXPECT_EQ(creases({}).first, 0u);
  EXPECT_EQ(creases({"--crease-angle", "80"}),
            std::pair(size_t{12}, "sublimit: note: " + on.mesh + ": 12 edges made sharp by their angle\n"));
  EXPECT_EQ(creases({"--crease-angle", "91"}).first, 0u);
  // Three sides are in group 1, the others in none.
  EXPECT_EQ(creases({"--crease-smoothing-groups"}).first, 9u);
  expect_failure(sublimit({"info", on.mesh, "--crease-angle", "181"}), 2, {"--crease-angle"});
  const TemporaryDirectory directory;
  const std::string plain = (directory / "plain.obj").string();
  write_obj(plain, grid(3, 3));
  expect_failure(sublimit({"info", plain, "--crease-smoothing-groups"}), 3, {"no face has a smoothing group"});
  expect_done(sublimit({"refine", plain, "-s", "catmull-clark", "-l", "2", "--boundary", "fixed", "-o", out}));
  const Mesh fixed = read_mesh(out), control = grid(3, 3);
  for (Index v = 0; v < control.num_vertices(); ++v) {
    const bool inside = v >= 4 && v < 12 && v % 4 != 0 && v % 4 != 3;
    EXPECT_EQ(fixed.positions.row(v) == control.positions.row(v), !inside) << v;
  }
}

// What a file keeps in fewer digits, or not at all, is told once.
TEST(CliAttributes, WhatWritersChangeIsTold) {
  const TemporaryDirectory directory;
  Mesh mesh = cube();
  mesh.positions.array() += 1e8;
  const std::string in = (directory / "in.obj").string(), out = (directory / "out.stl").string();
  write_obj(in, mesh);
  const Outcome told = sublimit({"refine", in, "-s", "catmull-clark", "-l", "0", "-o", out});
  EXPECT_EQ(told.status, 0);
  EXPECT_NE(told.err.find("sublimit: note: " + out + ": 7 of 8 different points become equal to another one"),
            std::string::npos)
      << told.err;
  const Outcome quiet = sublimit({"refine", in, "-s", "catmull-clark", "-l", "0", "-o", out, "--quiet"});
  EXPECT_EQ(quiet.err, "");
}

TEST(CliAttributes, AdviceIsNotWhatWasDone) {
  const TemporaryDirectory directory;
  // A band of triangles with half a turn: no winding of them agrees.
  const std::string band = directory
                               .write("band.obj",
                                      "v 0 0 0\nv 1 0 0\nv 2 1 0\nv 1 2 1\nv 0 1 1\n"
                                      "f 1 2 3\nf 2 4 3\nf 3 4 5\nf 4 1 5\nf 5 1 2\n")
                               .string();
  const std::string out = (directory / "out.obj").string();
  const Outcome told = sublimit({"refine", band, "-s", "loop", "-l", "1", "--orient", "-o", out});
  EXPECT_EQ(told.status, 0) << told.err;
  EXPECT_NE(told.err.find("turning faces does not help: the surface has a single side"), std::string::npos) << told.err;
  EXPECT_EQ(told.err.find("(--orient)"), std::string::npos) << told.err;
  const std::string plane = directory.write("plane.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n").string();
  const Outcome refused = sublimit({"refine", plane, "-s", "doo-sabin", "-l", "1", "--boundary", "fixed", "-o", out});
  expect_failure(refused, 2, {"boundary 'fixed': doo-sabin keeps no vertices", "such as catmull-clark or loop"});
  EXPECT_EQ(refused.err.find("remove the tag"), std::string::npos);
}

TEST(CliAttributes, ASidecarHasKeysOfOne) {
  const TemporaryDirectory directory;
  const std::string mesh = (directory / "mesh.obj").string(), out = (directory / "out.obj").string();
  write_obj(mesh, cube());
  const auto corners = [&](const std::vector<std::string>& options = {}) {
    std::vector<std::string> words{"refine", mesh, "-s", "catmull-clark", "-l", "0", "--strict", "-o", out};
    words.insert(words.end(), options.begin(), options.end());
    expect_done(sublimit(words));
    return read_mesh(out).corners.size();
  };
  for (const std::string other : {"[1, 2]", "{}", "{\"name\": \"cage\"}", "no JSON", "\xff\xfe"}) {
    directory.write("mesh.json", other);
    EXPECT_EQ(corners(), 0u) << other;
  }
  const std::string tags = "{\"cornerIndices\": [3], \"cornerSharpnesses\": [10]}";
  const std::string sidecar = directory.write("mesh.json", tags).string(),
                    elsewhere = directory.write("tags.txt", tags).string();
  EXPECT_EQ(corners(), 1u);
  EXPECT_EQ(corners({"--sidecar", "none"}), 0u);
  directory.write("mesh.json", "[]");
  EXPECT_EQ(corners({"--sidecar", elsewhere}), 1u);
  expect_failure(sublimit({"info", mesh, "--sidecar", sidecar}), 3, {"holds an array"});
  expect_failure(sublimit({"info", mesh, "--sidecar", (directory / "none.json").string()}), 3, {"none.json"});
  directory.write("mesh.json", "{\"creaseIndices\": [0, 3], \"creaseLengths\": [2], \"creaseSharpnesses\": [1]}");
  const Outcome warned = sublimit({"info", mesh});
  EXPECT_EQ(warned.status, 0);
  EXPECT_NE((warned.out + warned.err).find("crease ignored: no face has an edge between vertices 0 and 3"),
            std::string::npos);
  expect_failure(sublimit({"info", mesh, "--strict"}), 3,
                 {"refused, since it has warnings (--strict)", "creaseIndices[0]"});
}

}  // namespace
}  // namespace sublimit::testing
