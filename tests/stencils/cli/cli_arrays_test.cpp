// SPDX-License-Identifier: Apache-2.0
// Rows as arrays of NumPy: what `sample`, `closest`, `intersect` and `implicit` write as .csv they write as .npy too,
// and places, points and rays are read from both. NumPy itself compares.
#include <gtest/gtest.h>

#include "meshes/meshes.h"
#include "stencils/cli/python_with_scipy.h"
#include "stencils/cli_program.h"
#include "sublimit/io/detail/obj.h"
#include "sublimit/stencils/formats/npy.h"
#include "sublimit/stencils/formats/npy_records.h"
#include "support/expect_error.h"

namespace sublimit::testing {
namespace {

using Words = std::vector<std::string>;

struct CliArrays : ::testing::Test {
  TemporaryDirectory directory;
  std::string path(const std::string& name) const { return (directory / name).string(); }
  CliArrays() {
    Mesh mesh = jittered(cube());
    add_crease(mesh, {0, 1}, 10.0f);
    mesh.holes.push_back(5);
    write_obj(path("mesh.obj"), mesh);
    directory.write("places.csv", "face,u,v\n0,0.1,0.7\n5,0.5,0.5\n3,1,0\n");
    directory.write("points.csv", "x,y,z\n0.3,0.4,0.2\n9,0,0\n");
    directory.write("rays.csv", "ox,oy,oz,dx,dy,dz\n0.1,0.2,-5,0,0,1\n9,9,9,1,0,0\n");
    directory.write("polygon.csv", "x,y\n0,0\n1,2\n3,1\n4,0\n");
    directory.write("ball.json", R"({"kind": "implicit", "field": "sphere", "center": [0, 0, 0], "radius": 1})");
  }
  void run_python(const std::string& script) const {
    const std::string file = directory.write("script.py", script);
    const std::string log = path("python.log");
    const int status = std::system(
        ("cd " + directory.path().string() + " && " + python_with_scipy() + " " + file + " > " + log + " 2>&1")
            .c_str());
    EXPECT_EQ(status, 0) << read_file(log);
  }
};

TEST_F(CliArrays, HaveTheColumnsOfTheCsv) {
  SUBLIMIT_NEEDS_SCIPY;
  const std::vector<Words> commands{
      {"sample", "mesh.obj", "-s", "catmull-clark", "--grid", "3", "--derivatives", "2", "--curvature"},
      {"sample", "mesh.obj", "-s", "catmull-clark", "--random", "70000"},
      {"sample", "mesh.obj", "-s", "catmull-clark", "--at", "places.csv"},
      {"sample", "mesh.obj", "-s", "catmull-clark", "--random", "0"},
      {"sample", "polygon.csv", "-s", "chaikin", "--grid", "5", "--derivatives", "1"},
      {"closest", "mesh.obj", "-s", "catmull-clark", "--points", "points.csv", "--nearest", "2"},
      {"intersect", "mesh.obj", "-s", "catmull-clark", "--rays", "rays.csv", "--all"},
      {"implicit", "ball.json", "--at", "points.csv"}};
  std::string script = R"(
import csv, math, sys
import numpy
def compare(name):
    array = numpy.load(name + ".npy")
    with open(name + ".csv") as file:
        rows = list(csv.reader(file))
    assert list(array.dtype.names) == rows[0], (array.dtype, rows[0])
    assert array.shape == (len(rows) - 1,), (name, array.shape)
    for column, field in enumerate(rows[0]):
        for text, value in zip((row[column] for row in rows[1:]), array[field]):
            if array.dtype[field].kind == "U":
                assert value == text, (name, field, value, text)
            elif array.dtype[field].kind == "i":
                assert array.dtype[field] == numpy.int64 and value == int(text)
            else:
                assert array.dtype[field] == numpy.float64
                assert math.isnan(value) if text == "" else value == float(text), (name, field, value, text)
)";
  for (size_t i = 0; i < commands.size(); ++i) {
    const std::string name = "out" + std::to_string(i);
    for (const char* const extension : {".csv", ".npy"}) {
      Words words = commands[i];
      for (std::string& word : words)
        if (std::filesystem::exists(directory / word)) word = path(word);
      words.insert(words.end(), {"--quiet", "-o", path(name + extension)});
      expect_done(sublimit(words));
    }
    script += "compare('" + name + "')\n";
  }
  run_python(script);
}

TEST_F(CliArrays, AreReadWhereACsvIs) {
  SUBLIMIT_NEEDS_SCIPY;
  run_python(R"(
import numpy
for name in ["places", "points", "rays"]:
    rows = numpy.loadtxt(name + ".csv", delimiter=",", skiprows=1)
    numpy.save(name + ".npy", rows)
    numpy.save(name + "_float.npy", rows.astype("f4"))
    names = open(name + ".csv").readline().strip().split(",")
    record = numpy.zeros(len(rows), dtype=[("other", "U3"), ("face" if names[0] == "face" else names[0], "i4" if names[0] == "face" else "f8")]
                         + [(n, "f8") for n in reversed(names[1:])])
    for i, n in enumerate(names):
        record[n] = rows[:, i]
    numpy.save(name + "_record.npy", record)
)");
  const auto result = [&](Words words) {
    words.insert(words.end(), {"--quiet", "-o", path("out.csv")});
    expect_done(sublimit(words));
    return read_file(path("out.csv"));
  };
  const std::string mesh = path("mesh.obj");
  const auto check = [&](const std::string& name, const std::function<Words(const std::string& file)>& words) {
    const std::string expected = result(words(path(name + ".csv")));
    EXPECT_EQ(result(words(path(name + ".npy"))), expected);
    EXPECT_EQ(result(words(path(name + "_record.npy"))), expected);
  };
  check("places", [&](const std::string& file) { return Words{"sample", mesh, "-s", "catmull-clark", "--at", file}; });
  check("rays",
        [&](const std::string& file) { return Words{"intersect", mesh, "-s", "catmull-clark", "--rays", file}; });
  check("points", [&](const std::string& file) { return Words{"implicit", path("ball.json"), "--at", file}; });
  // What `sample` writes is a list of places, too.
  expect_done(sublimit({"sample", mesh, "-s", "catmull-clark", "--grid", "4", "--quiet", "-o", path("grid.npy")}));
  expect_done(sublimit({"sample", mesh, "-s", "catmull-clark", "--grid", "4", "--quiet", "-o", path("grid.csv")}));
  EXPECT_EQ(result({"sample", mesh, "-s", "catmull-clark", "--at", path("grid.npy")}), read_file(path("grid.csv")));
}

TEST_F(CliArrays, MistakesNameTheItem) {
  NpyWriter wide(path("wide.npy"), DType::F64, {2, 4});
  const std::vector<double> numbers{0, 0.5, 0.5, 1, 7, 0.5, 0.5, 1};
  wide.write<double>(numbers);
  wide.commit();
  NpyWriter places(path("places.npy"), DType::F64, {2, 3});
  places.write<double>(std::vector<double>{0, 0.5, 0.5, 7, 0.5, 0.5});
  places.commit();
  NpyWriter flat(path("flat.npy"), DType::F64, {3});
  flat.write<double>(std::vector<double>{0, 0.5, 0.5});
  flat.commit();
  const auto at = [&](const std::string& name) {
    return sublimit({"sample", path("mesh.obj"), "-s", "catmull-clark", "--at", path(name), "-o", path("out.npy")});
  };
  expect_failure(at("wide.npy"), 3, {"wide.npy: an array of 4 columns; the columns should be face,u,v"});
  expect_failure(at("places.npy"), 3, {"places.npy[1]: face 7", "0 to 5"});
  expect_failure(at("flat.npy"), 3, {"flat.npy: an array of 1 dimensions; rows x columns are right"});
  directory.write("cut.npy", read_file(path("places.npy")).substr(0, 140));
  expect_failure(at("cut.npy"), 3, {"cut.npy: its data has 12 bytes"});
  const std::string named = read_file(path("places.npy"));
  const auto with_header = [&](const std::string& descr) {
    std::string text = "{'descr': " + descr + ", 'fortran_order': False, 'shape': (2,), }";
    text.resize(246, ' ');
    text += '\n';
    directory.write("named.npy", std::string("\x93NUMPY\1\0\xf7\0", 10) + text + std::string(48, '\0'));
    return at("named.npy");
  };
  expect_failure(with_header("[('face', '<f8'), ('a', '<f8'), ('v', '<f8')]"), 3,
                 {"its fields are face,a,v; the columns should be face,u,v"});
  expect_failure(with_header("[('face', '>f8'), ('u', '<f8'), ('v', '<f8')]"), 3, {"field 'face' is of type '>f8'"});
  expect_failure(with_header("[('face', '<f8'), ('u', '<f8', (2,))]"), 3, {"field 'u' is an array"});
  expect_failure(with_header("[('face', [('a', '<f8')])]"), 3, {"field 'face' is a record"});
  expect_failure(with_header("[]"), 3, {"its records have no fields"});
  expect_failure(with_header("[('face', '<f8')"), 3, {"named.npy"});
  EXPECT_FALSE(std::filesystem::exists(directory / "out.npy"));
}

TEST(NpyRecords, TextsThatHaveNoPlaceAreRefused) {
  const std::vector<NpyField> fields{npy_field("face"), npy_field("side"), npy_field("x")};
  std::string out;
  EXPECT_EQ(append_records(out, "3,+-,0.5\n,,\n", fields), 2);
  EXPECT_EQ(out.size(), 2 * (8 + 8 + 8u));
  for (const char* const line : {"3,+-+,0.5\n", "a,+,0.5\n", "3,+,x\n", "3,+\n", "3,+,1,2\n"})
    expect_error<FormatError>([&] { append_records(out, line, fields); }, {});
}

}  // namespace
}  // namespace sublimit::testing
