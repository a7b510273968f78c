// SPDX-License-Identifier: Apache-2.0
// `sublimit devices` and `apply --gpu`: the points of the CPU, in every format; errors where there is no GPU.
#include <gtest/gtest.h>

#include <cctype>
#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "meshes/free_form_shapes.h"
#include "stencils/cli_tables.h"
#include "sublimit/base/detail/format_number.h"
#include "sublimit/stencils/formats/npy.h"
#include "support/tolerance.h"

namespace sublimit::testing {
namespace {

/// Numbers up to 4, as derivatives are here, by sums in another order.
constexpr double in_float = 4 * float_reference;

/// The first GPU, or the one that SUBLIMIT_TEST_GPU numbers.
std::vector<std::string> on_gpu() {
  const char* const number = std::getenv("SUBLIMIT_TEST_GPU");
  return {"--gpu", "--device", number ? number : "0"};
}

/// For a child that is to find no driver.
void hide_gpus() {
  for (const char* files : {"VK_DRIVER_FILES", "VK_ICD_FILENAMES"}) ::setenv(files, "/nonexistent.json", 1);
  ::setenv("CUDA_VISIBLE_DEVICES", "", 1);
}

std::vector<std::string> words_of(const std::string& text) {
  std::vector<std::string> words{""};
  for (const char c : text)
    if (std::isspace(static_cast<unsigned char>(c)) || c == ',' || c == '/')
      words.emplace_back();
    else
      words.back() += c;
  return words;
}

/// The same text but for rounding of its numbers.
void expect_near_text(const std::string& made, const std::string& right) {
  const std::vector<std::string> own = words_of(made), other = words_of(right);
  ASSERT_EQ(own.size(), other.size());
  for (size_t i = 0; i < own.size(); ++i) {
    const Parsed<double> a = parse_number<double>(own[i]), b = parse_number<double>(other[i]);
    if (a && b)
      ASSERT_NEAR(a.value, b.value, in_float) << "word " << i;
    else
      ASSERT_EQ(own[i], other[i]) << "word " << i;
  }
}

std::vector<double> numbers_of(const NpyArray& array) {
  std::vector<double> numbers(static_cast<size_t>(array.size()));
  array.read<double>(0, numbers);
  return numbers;
}

void expect_near_files(const std::string& made, const std::string& right) {
  SCOPED_TRACE(made);
  if (made.ends_with(".npy")) {
    const NpyArray own(made), other(right);
    EXPECT_EQ(own.dtype(), DType::F32);
    EXPECT_EQ(own.shape(), other.shape());
    const std::vector<double> a = numbers_of(own), b = numbers_of(other);
    ASSERT_EQ(a.size(), b.size());
    for (size_t i = 0; i < a.size(); ++i) ASSERT_NEAR(a[i], b[i], in_float) << i;
  } else if (made.ends_with(".ply")) {
    const std::string a = read_file(made), b = read_file(right);
    EXPECT_EQ(a.substr(0, a.find("end_header")), b.substr(0, b.find("end_header")));
    const Mesh own = read_mesh(made), other = read_mesh(right);
    EXPECT_EQ(own.face_vertices, other.face_vertices);
    ASSERT_EQ(own.num_vertices(), other.num_vertices());
    EXPECT_LE((own.positions - other.positions).cwiseAbs().maxCoeff(), in_float);
  } else {
    expect_near_text(read_file(made), read_file(right));
  }
}

/// Applies the table on the CPU and on a GPU.
/// @param warned  of points that have poles
void expect_same_points(const Tables& on, const std::string& points, const std::string& extension,
                        bool warned = false) {
  const std::string cpu = on.path("cpu" + extension), gpu = on.path("gpu" + extension);
  expect_done(on.apply(points, cpu), warned);
  const Outcome outcome = expect_done(on.apply(points, gpu, on_gpu()), warned);
  EXPECT_TRUE(outcome.out.find(" on ") != std::string::npos) << outcome.out;
  expect_near_files(gpu, cpu);
}

void write_npy(const std::string& path, const std::vector<double>& numbers, std::vector<std::int64_t> shape) {
  NpyWriter writer(path, DType::F64, std::move(shape));
  writer.write<double>(numbers);
  writer.commit();
}

TEST(CliGpu, DevicesAreListed) {
  const nlohmann::json all = nlohmann::json::parse(expect_done(sublimit({"devices", "--json"})).out);
  ASSERT_FALSE(all.empty()) << "mesa-vulkan-drivers have one that stands in for a GPU";
  const std::string table = expect_done(sublimit({"devices"})).out;
  EXPECT_EQ(count_of(table, "\n"), all.size() + 1);
  expect_parts(table, {"number", "name", "API", "kind", "memory", "halves", "driver"});
  for (size_t i = 0; i < all.size(); ++i) {
    const nlohmann::json& device = all[i];
    EXPECT_EQ(device["number"], i);
    EXPECT_TRUE(device["api"] == "Vulkan" || device["api"] == "CUDA") << device;
    EXPECT_GT(device["memory"], 0);
    EXPECT_TRUE(device["halves"].is_boolean());
    for (const char* key : {"name", "kind", "api", "driver"}) {
      const std::string text = device[key];
      EXPECT_FALSE(text.empty()) << key;
      expect_parts(table, {text});
    }
  }
}

TEST(CliGpu, PointsAreThoseOfTheCpu) {
  const Tables on(creased_cube());
  const std::string places = on.directory.write("at.csv", "face,u,v\n0,0.25,0.5\n3,0,0\n5,1,0.125\n").string();
  using Options = std::vector<std::string>;
  for (const Options& table : {Options{"-l", "3"}, {"-l", "2", "--limit", "--derivatives", "1"}})
    for (const char* extension : {".obj", ".ply", ".csv", ".npy"}) {
      expect_done(on.bake(table));
      expect_same_points(on, on.mesh, extension);
    }
  EXPECT_EQ(count_of(read_file(on.path("gpu.obj")), "\nvn "), 98u);
  for (const Options& table : {Options{"--grid", "4", "--derivatives", "2"}, {"--at", places, "--derivatives", "1"}})
    for (const char* extension : {".csv", ".npy"}) {
      expect_done(on.bake(table));
      expect_same_points(on, on.mesh, extension);
    }
}

TEST(CliGpu, FramesAndChannelsAreThoseOfTheCpu) {
  const Tables on(torus(6, 5));
  constexpr std::int64_t frames = 3, points = 30;
  for (const std::int64_t channels : {1, 3, 100}) {  // more than 64 are applied in parts
    std::vector<double> numbers(frames * points * size_t(channels));
    for (size_t i = 0; i < numbers.size(); ++i) numbers[i] = std::sin(double(7 * i));
    write_npy(on.path("in.npy"), numbers, {frames, points, channels});
    for (const char* derivatives : {"0", "1"}) {
      expect_done(on.bake({"-l", "1", "--limit", "--derivatives", derivatives}));
      expect_same_points(on, on.path("in.npy"), ".npy");
    }
  }
  EXPECT_EQ(NpyArray(on.path("gpu.npy")).shape(), (std::vector<std::int64_t>{frames, 3, 120, 100}));
  std::string columns = "temperature,charge\n";
  for (int i = 0; i < points; ++i) columns += std::to_string(i % 4) + "," + std::to_string(i % 3) + "\n";
  expect_same_points(on, on.directory.write("in.csv", columns).string(), ".csv");
}

/// Tables of a file's free-form surfaces, which need no scheme.
TEST(CliGpu, RationalSurfacesAreDivided) {
  const Tables on(cube());
  const std::string sphere = on.path("sphere.obj"), cut = on.path("cut.obj");
  write_free_form(sphere, free_form_of({unit_sphere()}));
  // w = 1 - 2 u: zero in the middle.
  on.directory.write("cut.obj",
                     "v 0 0 0 1\nv 1 0 0 -1\nv 0 1 0 1\nv 1 1 0 -1\n"
                     "cstype rat bezier\ndeg 1 1\nsurf 0 1 0 1 1 2 3 4\nparm u 0 1\nparm v 0 1\nend\n");
  for (const std::string& file : {sphere, cut})
    for (const char* derivatives : {"0", "1"}) {
      SCOPED_TRACE(file);
      expect_done(sublimit({"bake", file, "--grid", "5", "--derivatives", derivatives, "-o", on.table}), true);
      for (const char* extension : {".csv", ".npy"}) expect_same_points(on, file, extension, true);
    }
  EXPECT_GT(count_of(read_file(on.path("gpu.csv")), ",pole,"), 0u);
}

TEST(CliGpu, SummariesNameTheDevice) {
  const Tables on(cube());
  expect_done(on.bake({"-l", "1"}));
  std::vector<std::string> options = on_gpu();
  const nlohmann::json all = nlohmann::json::parse(expect_done(sublimit({"devices", "--json"})).out);
  const nlohmann::json& device = all.at(size_t(std::atoi(options[2].c_str())));
  const std::string name = device["name"], api = device["api"];
  expect_parts(expect_done(on.apply(on.mesh, on.path("out.obj"), options)).out,
               {"out.obj: 26 points; ", " s on " + name + ", " + api + "\n"});
  const std::string of_cpu = expect_done(on.apply(on.mesh, on.path("out.obj"))).out;
  EXPECT_TRUE(of_cpu.ends_with(" s\n")) << of_cpu;
  options.emplace_back("--quiet");
  EXPECT_EQ(expect_done(on.apply(on.mesh, on.path("out.obj"), options)).out, "");
  expect_done(on.apply(on.mesh, on.path("out.obj"), {"--gpu"}));  // the first one
}

/// The CPU never takes over.
TEST(CliGpu, RefusesWhatGpusDoNotTake) {
  const Tables on(cube());
  expect_done(on.bake({"-l", "1", "--precision", "double"}));
  expect_failure(on.apply(on.mesh, on.path("out.obj"), on_gpu()), 2,
                 {"table.safetensors is in double", "--precision float", "leave out --gpu"});
  expect_done(on.bake({"-l", "1"}));
  for (const char* extension : {".obj", ".ply", ".csv", ".npy"}) {
    const std::string out = on.path("out" + std::string(extension));
    expect_failure(on.apply(on.mesh, out, {"--gpu", "--device", "99"}), 2, {"no GPU 99", "leave out --gpu"});
    expect_failure(on.apply(on.mesh, out, {"--gpu", "--device", "-1"}), 2, {"no GPU -1"});
    expect_failure(on.apply(on.mesh, out, {"--device", "0"}), 2, {"--device 0 is for --gpu"});
    expect_failure(on.apply(on.mesh, out, {"--gpu", "--device", "first"}), 2, {"--device"});
    const Outcome without = sublimit({"apply", on.table, on.mesh, "-o", out, "--gpu"}, hide_gpus);
    expect_failure(without, 2, {"no GPU that tables can be applied on: ", "driver", "leave out --gpu"});
    EXPECT_EQ(count_of(without.err, "\n"), 1u) << without.err;
    EXPECT_EQ(on.directory.num_files(), 2);
  }
  expect_done(sublimit({"apply", on.table, on.mesh, "-o", on.path("out.obj")}, hide_gpus));
}

TEST(CliGpu, DevicesSayWhyThereAreNone) {
  expect_parts(expect_done(sublimit({"devices"}, hide_gpus)).out,
               {"no GPU that tables can be applied on: ", "driver", "on the CPU"});
  const Outcome json = expect_done(sublimit({"devices", "--json"}, hide_gpus), true);
  EXPECT_EQ(json.out, "[]\n");
  expect_parts(json.err, {"sublimit: note: no GPU that tables can be applied on: ", "driver"});
}

}  // namespace
}  // namespace sublimit::testing
