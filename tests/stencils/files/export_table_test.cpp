// SPDX-License-Identifier: Apache-2.0
#include "sublimit/stencils/files/export_table.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <cstdlib>
#include <random>

#include "eval/file/table_samples.h"
#include "meshes/free_form_shapes.h"
#include "sublimit/base/detail/read_file.h"
#include "sublimit/base/error.h"
#include "sublimit/eval/evaluate/pattern_evaluator.h"
#include "sublimit/eval/file/table_file.h"
#include "sublimit/scheme/detail/prepare.h"
#include "sublimit/schemes/schemes.h"
#include "sublimit/stencils/bake/detail/bake.h"
#include "sublimit/stencils/formats/npy.h"
#include "sublimit/stencils/formats/npz.h"
#include "sublimit/stencils/patterns/demo_mesh.h"
#include "support/expect_error.h"
#include "support/skip.h"
#include "support/temporary_directory.h"

namespace sublimit::testing {
namespace {

TEST(ExportTable, WritesMatrixMarket) {
  const TemporaryDirectory directory;
  PatternTable<float>::Arrays arrays;
  arrays.rest.emplace(3, std::vector<std::int64_t>{0, 2, 2, 3}, std::vector<std::int32_t>{0, 2, 1},
                      std::vector<float>{0.1f, 0.9f, 1});
  BakedTable<float> table;
  table.table = PatternTable<float>(3, std::move(arrays));
  export_table(directory / "t.mtx", table);
  EXPECT_EQ(read_file(directory / "t.mtx"),
            "%%MatrixMarket matrix coordinate real general\n3 3 3\n1 1 0.1\n1 3 0.9\n3 2 1\n");
}

TEST(ExportTable, WritesADirectoryOfArrays) {
  const TemporaryDirectory directory;
  const BakedTable<double> table = everything<double>();
  export_table(directory / "t", table);
  const NpyArray weights(directory / "t/first.weights.npy");
  std::vector<double> read(size_t(weights.size()));
  weights.read(0, std::span(read));
  const auto& expected = table.table.arrays().first->weights();
  EXPECT_EQ(read, std::vector<double>(expected.begin(), expected.end()));
  EXPECT_NE(read_file(directory / "t/metadata.json").find("\"scheme\": \"bilinear\""), std::string::npos);
  expect_error<IoError>([&] { export_table(directory / "t", table); }, {"/t: ", "not empty"});
  expect_error<IoError>([&] { export_table(directory / "no/t", table); }, {"no/t: "});
  expect_error<IoError>([&] { export_table(directory.write("file", "x"), table); }, {"file: "});
  std::filesystem::create_directory(directory / "empty");
  export_table(directory / "empty", table);
  EXPECT_TRUE(std::filesystem::exists(directory / "empty/weights.npy"));
  EXPECT_EQ(directory.num_files(), 3);
}

TEST(ExportTable, WritesTheSameBytesAgain) {
  const TemporaryDirectory directory;
  export_table(directory / "a.npz", everything<float>());
  export_table(directory / "b.npz", everything<float>());
  EXPECT_EQ(read_file(directory / "a.npz"), read_file(directory / "b.npz"));
  export_table(directory / "b.npz", two_quads<float>());  // replaces
  EXPECT_NE(read_file(directory / "a.npz"), read_file(directory / "b.npz"));
  EXPECT_EQ(directory.num_files(), 2);
}

TEST(ExportTable, SaysWhatItCannotWrite) {
  const TemporaryDirectory directory;
  expect_error<InvalidParameter>([&] { export_table(directory / "t.csv", two_quads<float>()); },
                                 {"t.csv", ".npz", ".mtx"});
  expect_error<IoError>([&] { export_table(directory / "no/t.npz", two_quads<float>()); }, {"no/t.npz: cannot write"});
  expect_error<IoError>([&] { export_table(directory / "no/t.mtx", two_quads<float>()); }, {"no/t.mtx: cannot write"});
  EXPECT_EQ(directory.num_files(), 0);
}

TEST(ExportTable, LeavesNothingOnAFullDisk) {
  const TemporaryDirectory directory;
  struct ::rlimit limit {};
  ::getrlimit(RLIMIT_FSIZE, &limit);
  struct ::rlimit small = limit;
  small.rlim_cur = 100;
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  ::setrlimit(RLIMIT_FSIZE, &small);
  for (const char* name : {"t.npz", "t.mtx", "t"})
    expect_error<ResourceError>([&] { export_table(directory / name, everything<double>()); }, {"free some space"});
  ::setrlimit(RLIMIT_FSIZE, &limit);
  std::signal(SIGXFSZ, handler);
  EXPECT_EQ(directory.num_files(), 0);
}

/// Python with NumPy and SciPy: the system's first, which has Debian's packages.
std::string python() {
  for (const std::string name : {"/usr/bin/python3", "python3"})
    if (std::system((name + " -c 'import numpy, scipy.sparse' 2>/dev/null").c_str()) == 0) return name;
  return "";
}

class PythonFiles {
 public:
  template <class Real>
  void add(const std::string& name, const BakedTable<Real>& table) {
    save_table(directory_ / name, table);
    export_table(directory_ / (name + ".npz"), table);
    export_table(directory_ / (name + ".mtx"), table);
    export_table(directory_ / (name + "_arrays"), table);
    std::mt19937 random(7);
    const std::int64_t controls = table.table.num_control_points(), channels = table.info.rational ? 4 : 3;
    std::vector<Real> points(size_t(controls * channels));
    for (Real& x : points) x = Real(1) + Real(random()) / Real(std::mt19937::max());
    const std::int64_t count = table.table.num_points(), quantities = table.table.quantities();
    std::vector<Real> made(size_t(count * quantities) * 3);
    Evaluation<Real> e;
    e.channels = static_cast<int>(channels);
    e.points = points;
    e.rational = table.info.rational;
    for (size_t q = 0; q < size_t(quantities); ++q)
      e.quantities[q] = std::span<Real>(made).subspan(q * size_t(3 * count), size_t(3 * count));
    PatternEvaluator<Real>(table.table).apply(e);
    const auto write = [&](const std::string& what, const std::vector<Real>& numbers, std::vector<std::int64_t> shape) {
      NpyWriter file(directory_ / (name + what), dtype_of<Real>(), std::move(shape));
      file.write(std::span<const Real>(numbers));
      file.commit();
    };
    write(".points.npy", points, {controls, channels});
    write(".expected.npy", made, {quantities, count, 3});
    names_ += " " + name;
  }
  std::string arguments() const { return directory_.path().string() + names_; }

 private:
  TemporaryDirectory directory_;
  std::string names_;
};

TEST(TableInPython, MakesTheSamePoints) {
  const std::string interpreter = python();
  SUBLIMIT_NEEDS_PROGRAM(!interpreter.empty(), "python3-numpy python3-scipy");
  PythonFiles files;
  files.add("parts_double", everything<double>());
  files.add("parts_float", everything<float>());
  const auto bake_one = [](const char* scheme, const Mesh& mesh, const BakeRequest& request) {
    Patterns patterns(find_scheme(scheme).value());
    return bake(patterns, mesh, request).table;
  };
  BakeRequest level, limit, grid;
  level.level = 2;
  limit.rows = TableRows::limit, limit.level = 1, limit.derivatives = 1;
  grid.rows = TableRows::grid, grid.grid = 3, grid.derivatives = 2;
  const Mesh mesh = demo_mesh();
  files.add("level", in_float(bake_one("catmull-clark", mesh, level)));
  files.add("limit", bake_one("loop", triangulated(mesh), limit));
  files.add("grid", bake_one("catmull-clark", mesh, grid));
  files.add("rows", bake_one("doo-sabin", without_creases(mesh), level));
  const RationalShape shape = elevated(unit_sphere());
  files.add(
      "rational",
      bake(PatchSet({std::make_shared<const SplineSurface>(shape.surface)}, Coordinates::homogeneous), grid).table);
  EXPECT_EQ(std::system((interpreter + " " + SUBLIMIT_SOURCE + "/tests/stencils/read_table.py " + SUBLIMIT_SOURCE +
                         "/eval/table_format.md " + files.arguments())
                            .c_str()),
            0);
}

}  // namespace
}  // namespace sublimit::testing
