// SPDX-License-Identifier: Apache-2.0
// Laws over the table of formats: what a row claims is so, and what it does not claim is refused or left out.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <set>

#include "meshes/meshes.h"
#include "sublimit/base/detail/read_file.h"
#include "sublimit/cad/step_file.h"
#include "sublimit/io/detail/formats.h"
#include "sublimit/io/detail/obj_normals.h"
#include "sublimit/io/detail/ply.h"
#include "sublimit/io/detail/polygon_files.h"
#include "sublimit/io/free_form.h"
#include "sublimit/io/read_mesh.h"
#include "sublimit/io/write_mesh.h"
#include "support/expect_error.h"
#include "support/temporary_directory.h"

namespace sublimit::testing {
namespace {

bool claims(const std::vector<FileFormat::Ability>& abilities, Content content) {
  return std::ranges::any_of(abilities, [&](const FileFormat::Ability& ability) { return ability.content == content; });
}
bool has(const std::vector<MeshField>& fields, MeshField field) {
  return std::ranges::find(fields, field) != fields.end();
}

/// Calls a check with each row and each of its extensions.
void for_each_extension(const std::function<void(const FileFormat&, const std::string&)>& check) {
  for (const FileFormat& row : io_formats().rows())
    for (const std::string_view extension : row.extensions) {
      SCOPED_TRACE(extension);
      check(row, std::string(extension));
    }
}

/// Expects an error with exactly this message.
template <class Expected>
void expect_message(const std::function<void()>& action, const std::string& message) {
  try {
    action();
    ADD_FAILURE() << "nothing thrown";
  } catch (const Expected& error) {
    EXPECT_EQ(error.what(), message);
  }
}

bool same(const Points& a, const Points& b) { return a.rows() == b.rows() && a.cols() == b.cols() && a == b; }

/// The value of each corner: values that are equal may be one in a file.
Points values_of_corners(const Mesh::FaceVarying& channel) {
  Points values(std::ssize(channel.indices), channel.values.cols());
  for (size_t c = 0; c < channel.indices.size(); ++c)
    values.row(Eigen::Index(c)) = channel.values.row(channel.indices[c]);
  return values;
}

/// The corners of the triangles of all faces, cut into fans: what a format without vertices keeps.
Points fans(const Mesh& mesh) {
  std::vector<Index> corners;
  const Index* first = mesh.face_vertices.data();
  for (const Index size : mesh.face_sizes) {
    for (Index i = 1; i + 1 < size; ++i) corners.insert(corners.end(), {first[0], first[i], first[i + 1]});
    first += size;
  }
  Points points(std::ssize(corners), 3);
  for (size_t c = 0; c < corners.size(); ++c) points.row(Eigen::Index(c)) = mesh.positions.row(corners[c]);
  return points;
}

/// All fields, with what adds each to a cube and compares it.
struct Field {
  MeshField field;
  std::function<void(Mesh&)> add;
  std::function<bool(const Mesh&, const Mesh&)> is_same;
};
bool same(const std::vector<Mesh::Values>& a, const std::vector<Mesh::Values>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const Mesh::Values& x, const Mesh::Values& y) {
    return x.name == y.name && x.values == y.values && x.type == y.type;
  });
}
/// Numbers of type float, which all formats with colours have.
std::vector<Mesh::Values> colour(Index count) {
  std::vector<Mesh::Values> values;
  for (const char* const name : {"red", "green", "blue"}) {
    values.push_back({name, {}, ValueType::float32});
    for (Index i = 0; i < count; ++i) values.back().values.push_back(double(i + name[0] % 8) / 16);
  }
  return values;
}
Field names(MeshField field, Mesh::FaceNames Mesh::*kind) {
  return {field,
          [=](Mesh& m) {
            // One after the other, as in files that put faces of one name together.
            m.*kind = {.names = {"top", "left side"}, .of_face = {0, 0, 0, 1, 1, -1}};
          },
          [=](const Mesh& a, const Mesh& b) {
            return (a.*kind).names == (b.*kind).names && (a.*kind).of_face == (b.*kind).of_face;
          }};
}
const std::vector<Field>& fields() {
  using enum MeshField;
  static const std::vector<Field> all{
      {creases,
       [](Mesh& m) { m.creases = {{.tail = m.face_vertices[0], .head = m.face_vertices[1], .sharpness = 1.5f}}; },
       [](const Mesh& a, const Mesh& b) {
         return a.creases.size() == 1 && a.creases[0].tail == b.creases[0].tail &&
                a.creases[0].head == b.creases[0].head && a.creases[0].sharpness == b.creases[0].sharpness;
       }},
      {corners, [](Mesh& m) { m.corners = {{.vertex = 3, .sharpness = 2.5f}}; },
       [](const Mesh& a, const Mesh& b) {
         return a.corners.size() == 1 && a.corners[0].vertex == b.corners[0].vertex &&
                a.corners[0].sharpness == b.corners[0].sharpness;
       }},
      {knot_intervals,
       [](Mesh& m) { m.knot_intervals = {{.tail = m.face_vertices[0], .head = m.face_vertices[1], .length = 0.3}}; },
       [](const Mesh& a, const Mesh& b) {
         return a.knot_intervals.size() == 1 && a.knot_intervals[0].tail == b.knot_intervals[0].tail &&
                a.knot_intervals[0].head == b.knot_intervals[0].head &&
                a.knot_intervals[0].length == b.knot_intervals[0].length;
       }},
      {holes,
       [](Mesh& m) {
         m.holes = {4, 1};
       },
       [](const Mesh& a, const Mesh& b) { return a.holes == b.holes; }},
      {rules,
       [](Mesh& m) {
         m.boundary = Boundary::edge_only;
         m.creasing = Creasing::chaikin;
         m.triangles = Triangles::smooth;
         m.face_varying_interpolation = FaceVaryingInterpolation::corners_plus1;
       },
       [](const Mesh& a, const Mesh& b) {
         return a.boundary == b.boundary && a.creasing == b.creasing && a.triangles == b.triangles &&
                a.face_varying_interpolation == b.face_varying_interpolation;
       }},
      {face_varying,
       [](Mesh& m) {
         // Floats in PLY; 1 - t in glTF: numbers that have both.
         const Points values = (Points::Random(5, 2) * 1024).array().round() / 1024;
         m.face_varying = {{.name = "uv", .values = values, .indices = {}}};
         for (size_t c = 0; c < m.face_vertices.size(); ++c) m.face_varying[0].indices.push_back(Index(c % 5));
       },
       [](const Mesh& a, const Mesh& b) {
         return a.face_varying.size() == 1 && a.face_varying[0].name == b.face_varying[0].name &&
                same(values_of_corners(a.face_varying[0]), values_of_corners(b.face_varying[0]));
       }},
      names(groups, &Mesh::groups),
      names(objects, &Mesh::objects),
      names(materials, &Mesh::materials),
      names(smoothing_groups, &Mesh::smoothing_groups),
      {vertex_normals, [](Mesh& m) { m.normals = Points::Random(m.num_vertices(), 3); },
       [](const Mesh& a, const Mesh& b) { return a.face_normals.empty() && same(a.normals, b.normals); }},
      {corner_normals,
       [](Mesh& m) {
         m.normals = Points::Random(7, 3);
         for (size_t c = 0; c < m.face_vertices.size(); ++c) m.face_normals.push_back(Index(c % 7));
       },
       [](const Mesh& a, const Mesh& b) { return same(a.normals, b.normals) && a.face_normals == b.face_normals; }},
      {texture, [](Mesh& m) { m.texture = Points::Random(m.num_vertices(), 2); },
       [](const Mesh& a, const Mesh& b) { return same(a.texture, b.texture); }},
      {face_ids, [](Mesh& m) { m.face_ids = {7, 7, 2, 0, 1, 9}; },
       [](const Mesh& a, const Mesh& b) { return a.face_ids == b.face_ids; }},
      {vertex_values,
       [](Mesh& m) {
         m.vertex_values = {{.name = "heat", .values = {1, 2, 3, 4, 5, 6, 7, 8.5}, .type = ValueType::float32}};
       },
       [](const Mesh& a, const Mesh& b) { return same(a.vertex_values, b.vertex_values); }},
      {vertex_colours, [](Mesh& m) { m.vertex_values = colour(m.num_vertices()); },
       [](const Mesh& a, const Mesh& b) { return same(a.vertex_values, b.vertex_values); }},
      {face_values,
       [](Mesh& m) {
         m.face_values = {{.name = "part", .values = {1, 2, 3, 4, 5, 6}, .type = ValueType::int32}};
       },
       [](const Mesh& a, const Mesh& b) { return same(a.face_values, b.face_values); }},
      {face_colours, [](Mesh& m) { m.face_values = colour(m.num_faces()); },
       [](const Mesh& a, const Mesh& b) { return same(a.face_values, b.face_values); }},
      {comments, [](Mesh& m) { m.comments = {"made by hand"}; },
       [](const Mesh& a, const Mesh& b) { return a.comments == b.comments; }},
  };
  return all;
}

TEST(Formats, FieldsOfAMeshAreFound) {
  EXPECT_TRUE(fields_of(cube()).empty());
  std::set<std::string_view> names;
  for (const Field& one : fields()) {
    Mesh mesh = cube();
    one.add(mesh);
    EXPECT_EQ(fields_of(mesh), std::vector<MeshField>{one.field});
    names.insert(name_of(one.field));
  }
  EXPECT_EQ(names.size(), fields().size());
  EXPECT_FALSE(names.contains(""));
}

// A field comes back, or is in the file for other programs, or is refused or left out, as the row says.
TEST(Formats, MeshesKeepWhatRowsSay) {
  const TemporaryDirectory directory;
  std::filesystem::create_directory(directory / "bare");  // files may have their own names in them
  size_t kept = 0, held = 0, missing = 0;
  for_each_extension([&](const FileFormat& row, const std::string& extension) {
    EXPECT_EQ(row.read_mesh != nullptr, claims(row.reads, contents::meshes));
    EXPECT_EQ(row.write_mesh != nullptr, claims(row.writes, contents::meshes));
    for (const MeshField field : row.keeps) EXPECT_TRUE(has(row.holds, field)) << name_of(field);
    if (!row.write_mesh) {
      EXPECT_TRUE(row.holds.empty());
      return;
    }
    ASSERT_TRUE(row.read_mesh);
    const auto path = directory / ("mesh" + extension), bare = directory / "bare" / ("mesh" + extension);
    write_mesh(bare, cube());
    for (const Field& one : fields()) {
      SCOPED_TRACE(name_of(one.field));
      EXPECT_EQ(io_formats().holds(path, one.field), has(row.holds, one.field));
      Mesh mesh = cube();
      one.add(mesh);
      EXPECT_EQ(left_out(row, mesh).empty(), has(row.holds, one.field));
      try {
        write_mesh(path, mesh);
      } catch (const InvalidParameter&) {
        EXPECT_FALSE(has(row.holds, one.field));
        ++missing;
        continue;
      }
      const Mesh read = read_mesh(path);
      EXPECT_EQ(fans(read), fans(mesh));
      if (extension != ".stl") {
        EXPECT_EQ(read.positions, mesh.positions);
        EXPECT_EQ(read.face_vertices, mesh.face_vertices);
      }
      EXPECT_EQ(read_file(path) != read_file(bare), has(row.holds, one.field));
      EXPECT_EQ(has(fields_of(read), one.field), has(row.keeps, one.field));
      EXPECT_EQ(one.is_same(read, mesh), has(row.keeps, one.field));
      ++(has(row.keeps, one.field) ? kept : has(row.holds, one.field) ? held : missing);
    }
  });
  EXPECT_GT(std::min({kept, held, missing}), 4u);
}

// A channel of other columns than a format has is left out, and that is told.
TEST(Formats, ColumnsOfTextureCoordinatesAreThoseOfTheRow) {
  const TemporaryDirectory directory;
  for (const Index columns : {1, 2, 3}) {
    Mesh mesh = cube();
    mesh.face_varying = {{.name = "uv", .values = Points::Zero(1, columns), .indices = {}}};
    mesh.face_varying[0].indices.resize(mesh.face_vertices.size(), 0);
    for (const char* const extension : {".obj", ".ply"}) {
      const auto path = directory / ("a" + std::string(extension));
      write_mesh(path, mesh);
      const bool is_kept = !read_mesh(path).face_varying.empty();
      EXPECT_EQ(is_kept, left_out(*io_formats().find(path), mesh).empty());
      EXPECT_EQ(is_kept, columns == 2 || path.extension() == ".obj");
    }
  }
}

TEST(Formats, MeshesAreReadAndWrittenAsRowsSay) {
  const TemporaryDirectory directory;
  const std::string bytes = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  std::vector<std::string> read, written;
  for_each_extension([&](const FileFormat& row, const std::string& extension) {
    const std::string name = "a" + extension;
    bool is_written = true;
    try {
      write_mesh(directory / name, cube());
      written.push_back(extension);
    } catch (const InvalidOption&) {
      is_written = false;
      directory.write(name, bytes);
    }
    EXPECT_EQ(is_written, claims(row.writes, contents::meshes));
    try {
      EXPECT_GT(read_mesh(directory / name).num_faces(), 0);
      read.push_back(extension);
      EXPECT_EQ(io_formats().recognized(read_file(directory / name)), &row);
    } catch (const FormatError&) {
    }
    EXPECT_EQ(!read.empty() && read.back() == extension, claims(row.reads, contents::meshes));
  });
  EXPECT_EQ(io_formats().readers({contents::meshes}), read);
  EXPECT_EQ(io_formats().writers({contents::meshes}), written);
  EXPECT_GE(read.size(), 6u);
  const std::string unknown = (directory / "a.xyz").string();
  directory.write("a.xyz", bytes);
  expect_message<FormatError>([&] { (void)read_mesh(unknown); },
                              unknown + ": unknown kind of mesh '.xyz'; " + listed(read, "and") + " can be read");
  expect_message<InvalidOption>([&] { write_mesh(unknown, cube()); },
                                unknown + ": meshes are written as " + listed(written, "or") + ", not as '.xyz'");
}

ControlPolygon polygon(int dimension, bool tangents) {
  ControlPolygon made;
  made.points = Points::Random(4, dimension);
  if (tangents) made.tangents = Points::Random(4, dimension);
  made.curves = {{.points = {0, 1, 2, 3}, .closed = false}};
  return made;
}

TEST(Formats, PolygonsAreReadAndWrittenAsRowsSay) {
  const TemporaryDirectory directory;
  std::vector<std::string> with_tangents, all;
  for_each_extension([&](const FileFormat& row, const std::string& extension) {
    EXPECT_EQ(row.parse_polygon != nullptr, claims(row.reads, contents::polygons));
    EXPECT_EQ(row.format_polygon != nullptr, claims(row.writes, contents::polygons));
    const auto path = directory / ("a" + extension);
    if (!row.parse_polygon) {
      directory.write(path.filename().string(), "0,0\n1,1\n");
      expect_error<FormatError>([&] { (void)read_polygon(path); }, {"unknown kind of polygon '" + extension + "'"});
      return;
    }
    ASSERT_TRUE(row.format_polygon);
    all.push_back(extension);
    const ControlPolygon plain = polygon(3, false);
    write_polygon(path, plain);
    EXPECT_EQ(read_polygon(path).points, plain.points);
    EXPECT_EQ(io_formats().recognized(read_file(path)), &row);
    EXPECT_EQ(claims(row.reads, contents::tangents), claims(row.writes, contents::tangents));
    if (claims(row.reads, contents::tangents)) {
      with_tangents.push_back(extension);
      for (const int dimension : {2, 3, 5}) {
        const ControlPolygon given = polygon(dimension, true);
        write_polygon(path, given);
        const ControlPolygon back = read_polygon(path, true);
        EXPECT_EQ(back.points, given.points);
        EXPECT_EQ(back.tangents, given.tangents);
      }
    } else {
      expect_error<FormatError>([&] { (void)read_polygon(path, true); },
                                {"give them as a .csv with columns x,y,tx,ty or"});
      expect_error<InvalidParameter>([&] { write_polygon(path, polygon(4, false)); }, {"not 4; write a .csv"});
    }
  });
  EXPECT_EQ(io_formats().readers({contents::tangents}), with_tangents);
  EXPECT_EQ(with_tangents, std::vector<std::string>{".csv"});
  EXPECT_EQ(io_formats().readers({contents::polygons}), all);
  const std::string unknown = (directory / "a.xyz").string();
  directory.write("a.xyz", "0,0\n1,1\n");
  expect_message<FormatError>([&] { (void)read_polygon(unknown); },
                              unknown + ": unknown kind of polygon '.xyz'; .csv and .obj (lines) can be read");
}

TEST(Formats, NormalsAndValuesOfVerticesAreRead) {
  const TemporaryDirectory directory;
  size_t num_normals = 0, num_values = 0;
  for_each_extension([&](const FileFormat& row, const std::string& extension) {
    const auto path = directory / ("a" + extension);
    Mesh mesh = cube();
    mesh.normals = Points::Random(mesh.num_vertices(), 3);
    const bool normals = claims(row.reads, contents::vertex_normals),
               values = claims(row.reads, contents::vertex_values);
    EXPECT_EQ(values, claims(row.writes, contents::vertex_values));
    EXPECT_TRUE(!values || has(row.holds, MeshField::vertex_values));
    if (normals) {
      write_mesh(path, mesh);
      EXPECT_EQ(read_obj_normals(path), mesh.normals);
      ++num_normals;
    }
    if (values) {
      mesh.vertex_values = {{"heat", {1, 2, 3, 4, 5, 6, 7, 8.5}}};
      write_mesh(path, mesh);
      const Mesh read = read_ply(path, std::vector<std::string>{"heat"});
      ASSERT_EQ(read.vertex_values.size(), 1u);
      EXPECT_EQ(read.vertex_values[0].values, mesh.vertex_values[0].values);
      ++num_values;
    }
  });
  EXPECT_GT(num_normals, 0u);
  EXPECT_GT(num_values, 0u);
}

TEST(Formats, FreeFormIsReadAndWritten) {
  const TemporaryDirectory directory;
  const FreeForm line = parse_free_form("v 0 0 0\nv 1 2 3\ncstype bezier\ndeg 1\ncurv 0 1 1 2\nparm u 0 1\nend\n", "a");
  size_t count = 0;
  for_each_extension([&](const FileFormat& row, const std::string& extension) {
    EXPECT_EQ(claims(row.reads, contents::free_form), claims(row.writes, contents::free_form));
    if (!claims(row.reads, contents::free_form)) return;
    const auto path = directory / ("a" + extension);
    write_free_form(path, line);
    EXPECT_EQ(read_free_form(path).vertices, line.vertices);
    EXPECT_EQ(io_formats().recognized(read_file(path)), &row);
    ++count;
  });
  EXPECT_GT(count, 0u);
}

TEST(Formats, CadFilesAreWrittenAsRowsSay) {
  const TemporaryDirectory directory;
  const LimitSurface surface(cube(), "catmull-clark");
  std::vector<std::string> written;
  for_each_extension([&](const FileFormat& row, const std::string& extension) {
    std::optional<bool> asked_step;
    const CadFileMaker make = [&](const BoundaryModel&, const std::string&, bool step) {
      asked_step = step;
      return CadFile{.bytes = step ? "ISO-10303-21;\n" : "DBRep_DrawableShape\n"};
    };
    const auto path = directory / ("a" + extension);
    if (!claims(row.writes, contents::cad))
      return expect_error<InvalidOption>([&] { (void)write_step(surface, path, {}, make); }, {"CAD files are"});
    (void)write_step(surface, path, {}, make);
    EXPECT_EQ(asked_step, claims(row.writes, contents::step));
    EXPECT_EQ(io_formats().recognized(read_file(path)), &row);
    written.push_back(extension);
  });
  EXPECT_EQ(io_formats().writers({contents::cad}), written);
  expect_message<InvalidOption>([&] { check_step("a.xyz", {}); },
                                "a.xyz: CAD files are " + listed(written, "or") + ", not '.xyz'");
}

// Each content that a row claims has a test: those here, or those of the program (stencils/formats/formats_test.cpp).
TEST(Formats, ExtensionsAreOfOneRowAndAnyCase) {
  std::set<std::string_view> all;
  for_each_extension([&](const FileFormat& row, const std::string& extension) {
    EXPECT_TRUE(all.insert(*std::ranges::find(row.extensions, extension)).second);
    std::string upper = extension;
    for (char& c : upper) c = char(std::toupper(static_cast<unsigned char>(c)));
    EXPECT_EQ(io_formats().find("folder.x/FILE" + upper), &row);
  });
  for (const char* const path : {"a", "a.", ".obj", "obj", "a.obj.gz", "a.obj/", ""})
    EXPECT_EQ(io_formats().find(path), nullptr) << path;
}

TEST(Formats, FilesAreRecognizedByTheirFirstBytes) {
  const auto name = [](std::string_view bytes) {
    const FileFormat* const format = io_formats().recognized(bytes);
    return format ? std::string(format->extensions[0]) : "";
  };
  EXPECT_EQ(name("\xef\xbb\xbf# by hand\n\n  v 0 0 0\n"), ".obj");
  EXPECT_EQ(name("ply\r\nformat ascii 1.0\n"), ".ply");
  EXPECT_EQ(name("# points\nface, u ,v\n"), ".csv");
  for (const char* const word : {"OFF", "COFF", "STCNOFF", "nOFF", "OFF8"}) EXPECT_EQ(name(word), ".off") << word;
  for (const char* const word : {"OFFSET", "off", "COF", "OFF8x"}) EXPECT_EQ(name(word), "") << word;
  EXPECT_EQ(name("solid a name\nfacet"), ".stl");
  std::string binary = "solid" + std::string(79, ' ') + std::string(50, '\0');
  binary.replace(80, 4, std::string("\1\0\0\0", 4));
  EXPECT_EQ(name(binary), ".stl");
  binary.replace(0, 5, "other");
  EXPECT_EQ(name(binary), ".stl");
  EXPECT_EQ(name(binary + " "), "");
  EXPECT_EQ(name("glTF\2"), ".glb");
  EXPECT_EQ(name("{\"asset\":{}}"), ".gltf");
  for (const std::string& text :
       {std::string("a sentence, and its end\n"), std::string("{\"a\":1,\"b\":2}"), std::string("v \0\0\0\0\0\0{}", 10),
        std::string("<a b=\"1,2\"/>"), std::string(), std::string("# nothing"), std::string("vertex 1 2 3")})
    EXPECT_EQ(name(text), "") << text;
}

TEST(Formats, WordsAreListed) {
  EXPECT_EQ(listed({}, "or"), "");
  EXPECT_EQ(listed({".a"}, "or"), ".a");
  EXPECT_EQ(listed({".a", ".b"}, "or"), ".a or .b");
  EXPECT_EQ(listed({".a", ".b", ".c"}, "and"), ".a, .b and .c");
  EXPECT_EQ(listed({".a", ".b", ".c"}, ""), ".a, .b, .c");
}

}  // namespace
}  // namespace sublimit::testing
