// SPDX-License-Identifier: Apache-2.0
// `sublimit apply`: its points are those of `refine`, `limit` and `sample`; what is not of the table's cage it refuses.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "stencils/cli_tables.h"
#include "sublimit/stencils/formats/npy.h"
#include "support/tolerance.h"

namespace sublimit::testing {
namespace {

/// Positions sorted, so that meshes of other orders of vertices can be compared.
std::vector<std::array<double, 3>> sorted(const Mesh& mesh) {
  std::vector<std::array<double, 3>> all;
  for (Eigen::Index i = 0; i < mesh.positions.rows(); ++i)
    all.push_back({mesh.positions(i, 0), mesh.positions(i, 1), mesh.positions(i, 2)});
  // By x alone rounding would change the order.
  std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) {
    return 3 * a[0] + 5 * a[1] + 7 * a[2] < 3 * b[0] + 5 * b[1] + 7 * b[2];
  });
  return all;
}

void expect_same_points(const Mesh& a, const Mesh& b, double tolerance) {
  ASSERT_EQ(a.num_vertices(), b.num_vertices());
  ASSERT_EQ(a.num_faces(), b.num_faces());
  const auto own = sorted(a), other = sorted(b);
  for (size_t i = 0; i < own.size(); ++i)
    for (size_t k = 0; k < 3; ++k) EXPECT_NEAR(own[i][k], other[i][k], tolerance) << i;
}

void write_npy(const std::filesystem::path& path, const std::vector<double>& numbers, std::vector<std::int64_t> shape) {
  NpyWriter writer(path, DType::F64, std::move(shape));
  writer.write<double>(numbers);
  writer.commit();
}

std::vector<double> positions_of(const Mesh& mesh) {
  return {mesh.positions.data(), mesh.positions.data() + mesh.positions.size()};
}

std::vector<double> numbers_of(const NpyArray& array) {
  std::vector<double> numbers(static_cast<size_t>(array.size()));
  array.read<double>(0, numbers);
  return numbers;
}

TEST(CliApply, MeshesAreThoseOfRefine) {
  Mesh holed = jittered(grid(4, 3));
  holed.holes = {5};
  for (const Mesh& mesh : {creased_cube(), jittered(prism(5)), holed})
    for (const char* scheme : {"catmull-clark", "bilinear"})
      for (const bool is_float : {false, true}) {
        const Tables on(mesh);
        expect_done(on.bake({"-l", "2", "--precision", is_float ? "float" : "double"}, scheme));
        // Holes are written as tags by `refine` and left out by `apply`.
        const std::string refined = on.path("refined.obj");
        expect_done(sublimit({"limit", on.mesh, "-s", scheme, "-l", "2", "-o", refined}));
        const Index faces = read_mesh(refined).num_faces();
        expect_done(sublimit({"refine", on.mesh, "-s", scheme, "-l", "2", "--no-tags", "-o", refined}));
        Mesh right = read_mesh(refined);
        for (const char* name : {"out.obj", "out.ply"}) {
          expect_done(on.apply(on.mesh, on.path(name)));
          const Mesh made = read_mesh(on.path(name));
          EXPECT_EQ(made.num_faces(), faces);
          right.face_sizes.resize(size_t(faces));  // only the number matters below
          expect_same_points(made, right, is_float ? float_reference : reference);
        }
      }
}

TEST(CliApply, FacesOfDualSchemesAreThoseOfRefine) {
  const Tables on(jittered(prism(5)));
  for (const char* scheme : {"doo-sabin", "mid-edge"}) {
    expect_done(on.bake({"-l", "2", "--precision", "double"}, scheme));
    expect_done(sublimit({"refine", on.mesh, "-s", scheme, "-l", "2", "--no-tags", "-o", on.path("refined.obj")}));
    expect_done(on.apply(on.mesh, on.path("out.obj")));
    const Mesh made = read_mesh(on.path("out.obj")), right = read_mesh(on.path("refined.obj"));
    EXPECT_EQ(made.num_vertices(), right.num_vertices());
    EXPECT_EQ(made.face_sizes, right.face_sizes);
    ASSERT_EQ(made.face_vertices.size(), right.face_vertices.size());
    for (size_t c = 0; c < made.face_vertices.size(); ++c)
      EXPECT_LT((made.positions.row(made.face_vertices[c]) - right.positions.row(right.face_vertices[c]))
                    .cwiseAbs()
                    .maxCoeff(),
                reference)
          << scheme << ", corner " << c;
  }
}

TEST(CliApply, GridsAreThoseOfSample) {
  const Tables on(creased_cube());
  expect_done(on.bake({"--grid", "3", "--derivatives", "2", "--precision", "double"}));
  expect_done(on.apply(on.mesh, on.path("out.csv")));
  expect_done(sublimit(
      {"sample", on.mesh, "-s", "catmull-clark", "--grid", "3", "--derivatives", "2", "-o", on.path("right.csv")}));
  const auto rows = [&](const char* name) {
    std::vector<std::vector<std::string>> all{{""}};
    for (const char c : read_file(on.path(name))) {
      if (c == '\n')
        all.push_back({""});
      else if (c == ',')
        all.back().emplace_back();
      else
        all.back().back() += c;
    }
    return all;
  };
  const auto own = rows("out.csv"), right = rows("right.csv");
  ASSERT_EQ(own.size(), right.size());
  EXPECT_EQ(own[0], right[0]);
  for (size_t i = 1; i + 1 < own.size(); ++i) {
    ASSERT_EQ(own[i].size(), right[i].size());
    for (size_t k = 0; k < own[i].size(); ++k) {
      SCOPED_TRACE("row " + std::to_string(i) + ", " + own[0][k]);
      if (own[i][3] == "crease" && right[i][k].empty()) continue;  // two tangents stand for derivatives
      EXPECT_EQ(own[i][k].empty(), right[i][k].empty());
      if (k < 4 || own[i][k].empty() || right[i][k].empty())
        EXPECT_EQ(own[i][k], right[i][k]);
      else
        EXPECT_NEAR(std::stod(own[i][k]), std::stod(right[i][k]), printed_derivative);
    }
  }
}

TEST(CliApply, ArraysOfAnyShape) {
  const Tables on(torus(6, 5));
  const std::int64_t n = 30;
  const std::vector<double> positions = positions_of(read_mesh(on.mesh));
  expect_done(on.bake({"-l", "1", "--limit", "--derivatives", "1", "--precision", "double"}));
  expect_done(on.apply(on.mesh, on.path("right.csv")));
  std::vector<double> frames, first;
  const std::array scales{1.0, -2.0, 0.5, 4.0};  // powers of two: results are exact multiples
  for (const double scale : scales)
    for (const double x : positions) frames.push_back(scale * x);
  write_npy(on.path("in.npy"), frames, {4, n, 3});
  expect_done(on.apply(on.path("in.npy"), on.path("out.npy")));
  const NpyArray out(on.path("out.npy"));
  EXPECT_EQ(out.shape(), (std::vector<std::int64_t>{4, 3, 120, 3}));
  EXPECT_EQ(out.dtype(), DType::F64);
  const std::vector<double> made = numbers_of(out);
  for (size_t i = 0; i < 3 * 120 * 3; ++i)
    for (size_t f = 1; f < 4; ++f) EXPECT_EQ(made[f * 3 * 120 * 3 + i], scales[f] * made[i]);
  write_npy(on.path("one.npy"), positions, {n, 3});
  expect_done(on.apply(on.path("one.npy"), on.path("out.npy")));
  EXPECT_EQ(NpyArray(on.path("out.npy")).shape(), (std::vector<std::int64_t>{3, 120, 3}));
  first = numbers_of(NpyArray(on.path("out.npy")));
  EXPECT_TRUE(std::equal(first.begin(), first.end(), made.begin()));
  // Any number of channels, of a table of positions alone in float.
  expect_done(on.bake({"-l", "2"}));
  write_npy(on.path("in.npy"), std::vector<double>(size_t(n) * 7, 0.75), {n, 7});
  expect_done(on.apply(on.path("in.npy"), on.path("out.npy")));
  const NpyArray constant(on.path("out.npy"));
  EXPECT_EQ(constant.shape(), (std::vector<std::int64_t>{480, 7}));
  EXPECT_EQ(constant.dtype(), DType::F32);
  for (const double x : numbers_of(constant)) EXPECT_NEAR(x, 0.75, float_reference);
  write_npy(on.path("in.npy"), {}, {0, n, 3});
  expect_done(on.apply(on.path("in.npy"), on.path("out.npy")));
  EXPECT_EQ(NpyArray(on.path("out.npy")).shape(), (std::vector<std::int64_t>{0, 480, 3}));
}

/// Evaluators take 64 channels at a time; arrays may have more. Each channel is what it is alone.
TEST(CliApply, TakesAnyNumberOfChannels) {
  const Tables on(torus(6, 5));
  expect_done(on.bake({"-l", "1", "--precision", "double"}));
  constexpr std::int64_t n = 30, channels = 100;
  std::vector<double> all(n * channels), last(n);
  for (std::int64_t i = 0; i < n; ++i)
    for (std::int64_t c = 0; c < channels; ++c) all[size_t(i * channels + c)] = std::sin(double(7 * i + c));
  for (std::int64_t i = 0; i < n; ++i) last[size_t(i)] = all[size_t(i * channels + channels - 1)];
  write_npy(on.path("all.npy"), all, {n, channels});
  write_npy(on.path("last.npy"), last, {n, 1});
  expect_done(on.apply(on.path("all.npy"), on.path("out.npy")));
  expect_done(on.apply(on.path("last.npy"), on.path("out1.npy")));
  const std::vector<double> out = numbers_of(NpyArray(on.path("out.npy"))),
                            alone = numbers_of(NpyArray(on.path("out1.npy")));
  ASSERT_EQ(out.size(), alone.size() * channels);
  for (size_t i = 0; i < alone.size(); ++i)
    EXPECT_NEAR(out[i * channels + channels - 1], alone[i], rounding(8)) << "point " << i;
}

TEST(CliApply, RefusesNumbersThatFloatsDoNotHold) {
  const Tables on(torus(6, 5));
  expect_done(on.bake({"-l", "1"}));
  std::vector<double> numbers(30 * 3, 0.5);
  numbers[10] = 1e300;
  write_npy(on.path("in.npy"), numbers, {30, 3});
  expect_failure(on.apply(on.path("in.npy"), on.path("out.npy")), 3, {"in.npy", "point 3", "1e+300", "double"});
  EXPECT_FALSE(std::filesystem::exists(on.path("out.npy")));
}

TEST(CliApply, TablesOfPointsKeepTheirColumns) {
  const Tables on(cube());
  expect_done(on.bake({"-l", "1", "--precision", "double"}));
  std::string text = "temperature,charge\n";
  for (int i = 0; i < 8; ++i) text += std::to_string(i & 1) + "," + std::to_string(i >> 1 & 1) + "\n";
  expect_done(on.apply(on.directory.write("in.csv", text).string(), on.path("out.csv")));
  const std::string out = read_file(on.path("out.csv"));
  EXPECT_TRUE(out.starts_with("face,u,v,temperature,charge\n")) << out.substr(0, 60);
  EXPECT_EQ(count_of(out, "\n"), 27u);
}

TEST(CliApply, RefusesOtherPoints) {
  const Tables on(creased_cube());
  expect_done(on.bake({"-l", "2"}));
  const std::string out = on.path("out.obj");
  const auto refused = [&](const std::string& points, const std::string& output, int status,
                           std::initializer_list<std::string_view> parts) {
    expect_failure(on.apply(points, output), status, parts);
    EXPECT_FALSE(std::filesystem::exists(output));
  };
  write_obj(on.directory / "prism.obj", prism(5));
  refused(on.path("prism.obj"), out, 3, {"prism.obj: 10 points", "table.safetensors", "8 points"});
  Mesh turned = creased_cube();
  std::rotate(turned.face_vertices.begin(), turned.face_vertices.begin() + 4, turned.face_vertices.end());
  write_obj(on.directory / "turned.obj", turned);
  refused(on.path("turned.obj"), out, 3, {"turned.obj", "table.safetensors", "--any-cage"});
  expect_done(on.apply(on.path("turned.obj"), out, {"--any-cage"}));
  std::filesystem::remove(out);
  write_npy(on.path("short.npy"), std::vector<double>(21), {7, 3});
  refused(on.path("short.npy"), on.path("out.npy"), 3, {"short.npy: 7 points"});
  write_npy(on.path("flat.npy"), std::vector<double>(8), {8});
  refused(on.path("flat.npy"), on.path("out.npy"), 3, {"flat.npy", "dimensions"});
  std::vector<double> frames(3 * 24, 1);
  frames[24 + 5] = NAN;
  write_npy(on.path("nan.npy"), frames, {3, 8, 3});
  refused(on.path("nan.npy"), on.path("out.npy"), 3, {"nan.npy", "frame 1, point 1, channel 2", "nan"});
  frames[24 + 5] = 1;
  write_npy(on.path("frames.npy"), frames, {3, 8, 3});
  refused(on.path("frames.npy"), out, 2, {"3 frames", ".npy"});
  write_npy(on.path("two.npy"), std::vector<double>(16), {8, 2});
  refused(on.path("two.npy"), out, 2, {"2 channels", ".csv"});
  refused(on.directory.write("nan.csv", "x,y\n1,nan\n").string(), on.path("out.csv"), 3, {"nan.csv:2"});
  refused(on.mesh, on.path("out.dae"), 2, {"out.dae", ".obj"});
  refused(on.path("none.obj"), out, 3, {"none.obj"});
  refused(on.directory.write("points.txt", "1 2 3").string(), out, 3, {"points.txt", ".npy"});
  std::filesystem::resize_file(on.table, std::filesystem::file_size(on.table) / 2);
  refused(on.mesh, out, 3, {"table.safetensors"});
}

TEST(CliApply, TheCageMayHaveBeenCutIntoTriangles) {
  const Tables on(cube());
  expect_done(on.bake({"-l", "2", "--triangulate"}, "loop"));
  expect_done(on.apply(on.mesh, on.path("out.obj")));
  EXPECT_EQ(read_mesh(on.path("out.obj")).num_faces(), 12 * 16);
}

TEST(CliApply, NormalsAreWritten) {
  const Tables on(jittered(torus(6, 5)));
  expect_done(on.bake({"-l", "1", "--limit", "--derivatives", "1"}));
  expect_done(on.apply(on.mesh, on.path("out.obj")));
  EXPECT_EQ(count_of(read_file(on.path("out.obj")), "\nvn "), 120u);
  expect_done(on.apply(on.mesh, on.path("out.ply")));
  expect_parts(read_file(on.path("out.ply")).substr(0, 400), {"nx", "nz"});
}

/// A long animation takes the memory of a short one.
TEST(CliApply, FramesStreamInBoundedMemory) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "the sanitizers keep memory that is given back";
#endif
  const Tables on(torus(40, 25));
  expect_done(on.bake({"-l", "2"}));
  const auto peak = [&](std::int64_t frames) {
    NpyWriter writer(on.path("in.npy"), DType::F32, {frames, 1000, 3});
    const std::vector<float> frame(3000, 0.5f);
    for (std::int64_t f = 0; f < frames; ++f) writer.write<float>(frame);
    writer.commit();
    const Outcome outcome = expect_done(on.apply(on.path("in.npy"), on.path("out.npy"), {"--threads", "2"}));
    EXPECT_GT(std::filesystem::file_size(on.path("out.npy")), std::uintmax_t(frames) * 16000 * 12);
    return outcome.peak_kb;
  };
  const long few = peak(3), many = peak(600);  // 7 MB and 115 MB are written
  EXPECT_LT(many, few + 8 * 1024) << few << " KB";
}

TEST(CliApply, FullDiskLeavesNothing) {
  const Tables on(torus(40, 25));
  expect_done(on.bake({"-l", "2"}));
  for (const char* name : {"out.obj", "out.csv", "out.npy"}) {
    const Outcome outcome = sublimit({"apply", on.table, on.mesh, "-o", on.path(name)}, [] {
      const rlimit limit{4096, 4096};
      ::setrlimit(RLIMIT_FSIZE, &limit);
    });
    expect_failure(outcome, 4, {name, "cannot write"});
    EXPECT_EQ(on.directory.num_files(), 2);
  }
}

}  // namespace
}  // namespace sublimit::testing
