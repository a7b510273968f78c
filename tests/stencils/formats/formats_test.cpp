// SPDX-License-Identifier: Apache-2.0
// Laws over the table of formats, by the program: it writes and reads what rows claim, refuses names of other rows, and
// knows its own files again by their first bytes. Meshes, curves and CAD files have more in lib/io/formats_test.cpp.
#include "sublimit/stencils/formats/formats.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "meshes/meshes.h"
#include "stencils/cli_program.h"
#include "sublimit/io/write_mesh.h"

namespace sublimit::testing {
namespace {

using Words = std::vector<std::string>;

bool claims(const std::vector<FileFormat::Ability>& abilities, Content content) {
  return std::ranges::any_of(abilities, [&](const FileFormat::Ability& ability) { return ability.content == content; });
}
bool claims(const std::vector<FileFormat::Ability>& abilities, const std::vector<Content>& any) {
  return std::ranges::any_of(any, [&](Content content) { return claims(abilities, content); });
}

/// Something to read of each kind.
class Samples {
 public:
  Samples() {
    write_mesh(path("mesh.obj"), cube());
    write_mesh(path("octahedron.obj"), octahedron_with_normals());
    write_mesh(path("mesh.ply"), cube());
    write_mesh(path("mesh.off"), cube());
    write_mesh(path("mesh.stl"), cube());
    write_mesh(path("mesh.glb"), cube());
    write_mesh(path("mesh.gltf"), cube());
    Mesh prim = cube();
    prim.scheme = "catmull-clark";
    for (const char* const scene : {"mesh.usda", "mesh.usd", "mesh.usdz"}) write_mesh(path(scene), prim);
    directory_.write("polygon.csv", "x,y,z\n0,0,0\n1,0,0\n1,1,0\n");
    directory_.write("polygon.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nl 1 2 3\n");
    directory_.write("places.csv", "face,u,v\n0,0.5,0.5\n");
    directory_.write("points.csv", "x,y,z\n0.5,1.5,2.5\n");
    directory_.write("recipe.json", R"({"kind": "bezier_surface", "degree": [1, 1],
                                        "points": [[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 1]]})");
    expect_done(sublimit({"construct", path("recipe.json"), "--quiet", "-o", path("shape.obj")}));
    expect_done(sublimit(
        {"bake", path("mesh.obj"), "-s", "catmull-clark", "-l", "1", "--quiet", "-o", path("table.safetensors")}));
    expect_done(sublimit({"tessellate", path("mesh.obj"), "-s", "catmull-clark", "--chord", "10%", "--quiet", "-o",
                          path("surface.ply")}));
    expect_done(sublimit({"analyze", "-s", "bilinear", "--valence", "4", "--quiet", "--json", path("report.json")}));
    const nlohmann::json job{
        {"mesh", path("mesh.obj")}, {"scheme", "catmull-clark"}, {"levels", 1}, {"output", path("job.safetensors")}};
    directory_.write("jobs.jsonl", job.dump() + "\n");
  }
  std::string path(const std::string& name) const { return (directory_ / name).string(); }
  void write(const std::string& name, const std::string& text) const { directory_.write(name, text); }

 private:
  static Mesh octahedron_with_normals() {
    Mesh mesh = octahedron();
    mesh.normals = mesh.positions.rowwise().normalized();
    return mesh;
  }
  TemporaryDirectory directory_;
};

/// A command line with a place for a name, "?", and what it writes there or reads.
struct Line {
  Words words;
  std::vector<Content> contents;
};

Words with_name(const Line& line, const std::string& name) {
  Words words = line.words;
  std::ranges::replace(words, std::string("?"), name);
  return words;
}

std::set<std::string_view> named(const std::vector<Line>& lines) {
  std::set<std::string_view> names;
  for (const Line& line : lines)
    for (const Content content : line.contents) names.insert(content.name);
  return names;
}

/// The names of all contents that rows claim.
std::set<std::string_view> claimed(std::vector<FileFormat::Ability> FileFormat::*side) {
  std::set<std::string_view> names;
  for (const FileFormat& row : all_formats().rows())
    for (const FileFormat::Ability& ability : row.*side) names.insert(ability.content.name);
  return names;
}

TEST(AllFormats, HaveThoseOfMeshesFirstAndExtensionsOnce) {
  const std::vector<FileFormat>&all = all_formats().rows(), &first = io_formats().rows();
  ASSERT_GT(all.size(), first.size());
  std::set<std::string_view> extensions;
  for (size_t i = 0; i < all.size(); ++i) {
    if (i < first.size()) {
      EXPECT_EQ(all[i].extensions, first[i].extensions);
    }
    for (const std::string_view extension : all[i].extensions) EXPECT_TRUE(extensions.insert(extension).second);
    EXPECT_TRUE(all[i].begins && !all[i].name.empty());
    EXPECT_FALSE(all[i].reads.empty() && all[i].writes.empty());
  }
}

TEST(AllFormats, AreWrittenAsRowsSay) {
  using namespace contents;
  const Samples samples;
  const std::string mesh = samples.path("mesh.obj"), out = samples.path("out");
  const auto under = [&](Words words) {
    words.insert(words.end(), {"-s", "catmull-clark", "--quiet"});
    return words;
  };
  const std::vector<Line> lines{
      {under({"refine", mesh, "-l", "1", "-o", "?"}), {meshes}},
      {under({"refine", mesh, "-l", "1", "-o", samples.path("other.obj"), "--matrix", "?"}), {matrices}},
      {{"refine", samples.path("polygon.csv"), "-l", "1", "-s", "chaikin", "--quiet", "-o", "?"}, {tangents, polygons}},
      {{"refine", samples.path("shape.obj"), "-l", "1", "--quiet", "-o", "?"}, {free_form, meshes}},
      {{"construct", samples.path("recipe.json"), "--quiet", "-o", "?"}, {free_form}},
      {{"apply", samples.path("table.safetensors"), mesh, "--quiet", "-o", "?"}, {meshes, arrays, contents::rows}},
      {under({"sample", mesh, "--grid", "2", "-o", "?"}), {contents::rows, arrays}},
      {under({"bake", mesh, "-l", "1", "-o", "?"}), {tables}},
      {{"export", samples.path("table.safetensors"), "--quiet", "-o", "?"}, {table_rows}},
      {under({"tessellate", mesh, "--chord", "10%", "-o", "?"}), {meshes, cells}},
      {{"flatten", samples.path("mesh.usda"), "--chord", "10%", "--quiet", "-o", "?"}, {scenes, meshes}},
      {{"analyze", "-s", "bilinear", "--valence", "4", "--quiet", "-o", "?"}, {pages}},
      {{"analyze", "-s", "bilinear", "--valence", "4", "--quiet", "--picture", "?"}, {pictures}},
      {{"analyze", "-s", "bilinear", "--valence", "4", "--quiet", "--json", "?"}, {reports}},
  };
  for (const Line& line : lines) {
    std::string list;
    for (const std::string& extension : all_formats().writers(line.contents))
      list += (list.empty() ? "" : " or ") + extension;
    for (const FileFormat& row : all_formats().rows())
      for (const std::string_view extension : row.extensions) {
        const std::string name = out + std::string(extension);
        SCOPED_TRACE(line.words[0] + " " + name);
        std::filesystem::remove(name);
        const Outcome outcome = sublimit(with_name(line, name));
        if (claims(row.writes, line.contents)) {
          expect_done(outcome);
          const FileFormat* const found = all_formats().recognized(read_file(name));
          ASSERT_TRUE(found);
          EXPECT_EQ(found->name, row.name);
        } else {
          expect_failure(outcome, 2, {"cannot write " + name + ": its name must end in " + list + "\n"});
          EXPECT_FALSE(std::filesystem::exists(name));
        }
      }
  }
  std::set<std::string_view> tested = named(lines);
  // CAD files in lib/io/formats_test.cpp, parts in distributed/ranks_test.cpp, values at vertices below.
  for (const Content content : {cad, step, mesh_parts, vertex_values}) EXPECT_TRUE(tested.insert(content.name).second);
  EXPECT_EQ(tested, claimed(&FileFormat::writes));
}

TEST(AllFormats, AreReadAsRowsSay) {
  using namespace contents;
  const Samples samples;
  const std::string mesh = samples.path("mesh.obj");
  const std::string csv = samples.path("out.csv"), obj = samples.path("out.obj");
  expect_done(sublimit({"apply", samples.path("table.safetensors"), mesh, "--quiet", "-o", samples.path("level.npy")}));
  struct Read : Line {
    std::vector<std::string> files;  ///< one for each row that claims the content
  };
  const std::vector<Read> lines{
      {{{"info", "?", "--quiet"}, {meshes}},
       {"mesh.obj", "mesh.ply", "mesh.off", "mesh.stl", "mesh.glb", "mesh.gltf", "mesh.usda", "mesh.usd", "mesh.usdz"}},
      {{{"flatten", "?", "--chord", "10%", "-o", samples.path("flat.usda"), "--quiet"}, {scenes}},
       {"mesh.usda", "mesh.usd", "mesh.usdz"}},

      {{{"refine", "?", "-s", "chaikin", "-l", "1", "-o", csv, "--quiet"}, {polygons}}, {"polygon.csv", "polygon.obj"}},
      {{{"info", "?", "--quiet"}, {free_form}}, {"shape.obj"}},
      {{{"refine", "?", "-s", "nielson", "-l", "1", "-o", obj, "--quiet"}, {vertex_normals}}, {"octahedron.obj"}},
      {{{"closest", mesh, "-s", "catmull-clark", "--points", "?", "-o", csv, "--quiet"}, {arrays, contents::rows}},
       {"level.npy", "points.csv"}},
      {{{"construct", "?", "-o", obj, "--quiet"}, {recipes}}, {"recipe.json"}},
      {{{"verify", "?", "--quiet"}, {reports, tables}}, {"report.json", "table.safetensors"}},
      {{{"bake", "--manifest", "?"}, {jobs}}, {"jobs.jsonl"}},
      {{{"bake", mesh, "-s", "catmull-clark", "--tessellation", "?", "-o", samples.path("t.safetensors"), "--quiet"},
        {vertex_values}},
       {"surface.ply"}},
  };
  std::set<std::string_view> tested{contents::tangents.name, mesh_parts.name};  // in lib/io and distributed
  for (const Read& line : lines) {
    std::set<std::string> given;
    for (const std::string& file : line.files) {
      SCOPED_TRACE(line.words[0] + " " + file);
      expect_done(sublimit(with_name(line, samples.path(file))));
      const FileFormat* const row = all_formats().find(file);
      ASSERT_TRUE(row);
      EXPECT_TRUE(claims(row->reads, line.contents));
      EXPECT_EQ(all_formats().recognized(read_file(samples.path(file)))->name, row->name);
      given.insert(std::filesystem::path(file).extension().string());
    }
    std::set<std::string> expected;
    for (const std::string& extension : all_formats().readers(line.contents)) expected.insert(extension);
    EXPECT_EQ(given, expected) << line.words[0] << ": a file for each row";
    for (const Content content : line.contents) tested.insert(content.name);
  }
  EXPECT_EQ(tested, claimed(&FileFormat::reads));
}

// Where the extension decides, those of other rows are refused, with a list of the right ones.
TEST(AllFormats, OtherExtensionsAreNotRead) {
  using namespace contents;
  const Samples samples;
  const std::string text = read_file(samples.path("mesh.obj"));
  const std::string table = samples.path("table.safetensors"), out = samples.path("out.obj");
  for (const FileFormat& row : all_formats().rows())
    for (const std::string_view extension : row.extensions) {
      SCOPED_TRACE(extension);
      const std::string name = "other" + std::string(extension);
      samples.write(name, text);
      if (!claims(row.reads, {meshes, recipes, polygons}))  // other words for these
        expect_failure(sublimit({"info", samples.path(name)}), 3,
                       {"unknown kind of mesh '" + std::string(extension) + "'; " +
                        all_formats().readers_in_words({meshes}, "and") + " can be read"});
      if (!claims(row.reads, {meshes, contents::rows, arrays}))
        expect_failure(
            sublimit({"apply", table, samples.path(name), "-o", out}), 3,
            {"points come from " + listed(all_formats().readers({meshes, contents::rows, arrays}), "or") + " files"});
      if (!claims(row.reads, {vertex_values})) {
        EXPECT_NE(sublimit({"bake", samples.path("mesh.obj"), "-s", "catmull-clark", "--tessellation",
                            samples.path(name), "-o", samples.path("t.safetensors")})
                      .status,
                  0);
      }
    }
}

// Fields of meshes in the format that `write_mesh` does not write.
TEST(AllFormats, CellsHoldTheFieldsOfRows) {
  const Samples samples;
  const std::string out = samples.path("out");
  for (const FileFormat& row : all_formats().rows()) {
    if (row.write_mesh || row.holds.empty()) continue;
    const std::string extension(row.extensions[0]);
    SCOPED_TRACE(extension);
    ASSERT_TRUE(claims(row.writes, contents::cells));
    EXPECT_EQ(row.holds, std::vector<MeshField>{MeshField::face_ids});
    expect_done(sublimit({"tessellate", samples.path("mesh.obj"), "-s", "catmull-clark", "--chord", "10%", "--quiet",
                          "-o", out + extension}));
    EXPECT_NE(read_file(out + extension).find("Name=\"control_face\""), std::string::npos);
  }
}

// What a format has no place for is told.
TEST(AllFormats, RefineTellsWhatTheOutputCannotHold) {
  const TemporaryDirectory directory;
  const std::string cage = (directory / "cage.obj").string();
  Mesh mesh = cube();
  write_mesh(cage, mesh);
  const auto refined = [&](const std::string& extension, const Words& more = {}) {
    Words words{"refine", cage, "-s", "catmull-clark", "-l", "1", "-o", (directory / ("out" + extension)).string()};
    words.insert(words.end(), more.begin(), more.end());
    return sublimit(words);
  };
  const std::vector<std::string> writers = all_formats().writers({contents::meshes});
  for (const std::string& extension : writers) expect_done(refined(extension));  // nothing to tell
  const auto tag = [&](MeshField field) {
    mesh = cube();
    if (field == MeshField::creases) mesh.creases = {{.tail = 0, .head = 1, .sharpness = 5}};
    if (field == MeshField::corners) mesh.corners = {{.vertex = 7, .sharpness = 5}};
    if (field == MeshField::holes) mesh.holes = {2};
    if (field == MeshField::face_varying)
      mesh.face_varying = {{.name = "uv",
                            .values = mesh.positions.leftCols(2),
                            .indices = std::vector<Index>(mesh.face_vertices.size(), 1)}};
    write_mesh(cage, mesh);
  };
  size_t told = 0;
  for (const MeshField field : {MeshField::creases, MeshField::corners, MeshField::holes, MeshField::face_varying})
    for (const std::string& extension : writers) {
      SCOPED_TRACE(std::string(name_of(field)) + " " + extension);
      tag(field);
      const Outcome outcome = refined(extension);
      const bool holds = all_formats().holds("out" + extension, field);
      expect_done(outcome, !holds);
      EXPECT_EQ(outcome.err.find("has no place for " + std::string(name_of(field)) + "; written as .obj") !=
                    std::string::npos,
                !holds)
          << outcome.err;
      told += !holds;
      expect_done(refined(extension, {"--quiet"}));
    }
  EXPECT_GT(told, 0u);
}

}  // namespace
}  // namespace sublimit::testing
