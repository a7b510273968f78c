// SPDX-License-Identifier: Apache-2.0
// Small meshes that once took minutes or gigabytes, as commands: vertices of many edges, faces of many corners, and
// many irregular vertices beside each other.
#include <algorithm>
#include <filesystem>
#include <fstream>

#include "meshes/meshes.h"
#include "stencils/cli_program.h"
#include "sublimit/io/detail/obj.h"
#include "sublimit/io/read_mesh.h"

namespace sublimit::testing {
namespace {

namespace fs = std::filesystem;

const fs::path found = fs::path(SUBLIMIT_SHARED_MESHES).parent_path() / "found";

/// A command without its mesh; what it writes goes into a directory of its own.
using Words = std::vector<std::string>;
struct Found {
  const char* name;  ///< of the mesh
  Words command;
};

Words operator+(Words a, const Words& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

const Words limit_table{"-l", "2", "--limit", "--precision", "double", "-o", "t.safetensors"};
const Words grid3{"--grid", "3", "--derivatives", "2", "-o", "g.csv"};
const Words grid5{"--grid", "5", "--derivatives", "2", "-o", "g.csv"};
const Words butterfly{"-s", "modified-butterfly", "--triangulate", "--option"};
const Words stiff_kobbelt{"-s", "kobbelt", "--option", "tension=3", "--no-creases"};
const Found timeouts[] = {
    {"w0-0001-timeout-grid", Words{"sample", "-s", "kobbelt", "--boundary", "edge-and-corner"} + grid5},
    {"w0-0002-timeout-bake", Words{"bake", "-s", "kobbelt", "--boundary", "edge-and-corner"} + limit_table},
    {"w1-0013-timeout-bake",
     Words{"bake", "-s", "catmull-clark", "--option", "triangles=smooth", "--triangulate"} + limit_table},
    {"w1-0018-timeout-grid", Words{"sample"} + stiff_kobbelt + grid5},
    {"w1-0019-timeout-bake", Words{"bake"} + stiff_kobbelt + limit_table},
    {"w1-0027-timeout-bake", Words{"bake"} + butterfly + Words{"t=1/32"} + limit_table},
    {"w1-0028-timeout-bake",
     Words{"bake"} + butterfly + Words{"t=-1/32", "--no-creases", "--creasing", "uniform"} + limit_table},
    {"w1-0037-timeout-grid", Words{"sample", "-s", "interpolatory-sqrt3", "--triangulate", "--no-creases"} + grid3},
    {"w1-0041-timeout-grid",
     Words{"sample", "-s", "mid-edge-habib-warren", "--triangulate", "--no-creases", "--creasing", "uniform"} + grid3},
    // Sheets that meet at one vertex: 64 faces folded on it.
    {"slow-1-7279-closest",
     Words{"closest", "-s", "catmull-clark", "--triangulate", "--points", "slow-1-7279-closest.csv", "-o", "o.csv"}},
    {"slow-2-3819-intersect",
     Words{"intersect", "-s", "butterfly", "--triangulate", "--rays", "slow-2-3819-intersect.csv", "-o", "o.csv"}},
    {"slow-2-7197-intersect", Words{"intersect", "-s", "kobbelt", "--triangulate", "--all", "--rays",
                                    "slow-2-7197-intersect.csv", "-o", "o.csv"}},
};

class FoundMeshes : public ::testing::TestWithParam<Found> {};

TEST_P(FoundMeshes, AreDone) {
  const fs::path mesh = found / (std::string(GetParam().name) + ".obj");
  if (!fs::exists(mesh)) GTEST_SKIP() << "NO SHARED MESHES at " << found;
  const TemporaryDirectory directory;
  Words all{GetParam().command[0], mesh.string(), "--quiet"};
  for (size_t i = 1; i < GetParam().command.size(); ++i) {
    const std::string& word = GetParam().command[i];
    const std::string& before = GetParam().command[i - 1];
    const bool is_input = before == "--rays" || before == "--points";
    all.push_back(is_input ? (found / word).string() : before == "-o" ? (directory / word).string() : word);
  }
  expect_done(sublimit(all));
  EXPECT_EQ(directory.num_files(), 1);
}

INSTANTIATE_TEST_SUITE_P(Commands, FoundMeshes, ::testing::ValuesIn(timeouts), [](const auto& info) {
  std::string name = info.param.name;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});

TEST(FoundMesh, OfAFitWithoutSecondDerivativesIsRefused) {
  const std::string mesh = (found / "w1-0029-timeout-fit.obj").string(),
                    targets = (found / "w1-0029-timeout-fit.csv").string();
  if (!fs::exists(mesh)) GTEST_SKIP() << "NO SHARED MESHES at " << found;
  const TemporaryDirectory directory;
  const Words fit = Words{"fit", mesh, "--quiet", "--targets", targets, "-s"} +
                    Words(butterfly.begin() + 1, butterfly.end()) +
                    Words{"t=-1/32",      "--no-creases", "--creasing", "uniform",
                          "--thin-plate", "1e9",          "-o",         (directory / "f.obj").string()};
  expect_failure(sublimit(fit), 2, {"second derivatives"});
  EXPECT_EQ(directory.num_files(), 0);
}

/// Poles of 360 edges: every face beside one depends on 720 points and more, and is like no other.
TEST(FoundMesh, OfWidePolesIsRefusedWhereMemoryIsShort) {
  const std::string mesh = (found / "pole360-memory.obj").string();
  if (!fs::exists(mesh)) GTEST_SKIP() << "NO SHARED MESHES at " << found;
  const TemporaryDirectory directory;
  const Words sample = Words{"sample", mesh, "--quiet", "-s", "interpolatory-sqrt3", "--no-creases"} +
                       Words{"--grid", "3", "--derivatives", "2", "-o", (directory / "g.csv").string()};
  for (const char* limit : {"100M", "300M"})
    expect_failure(sublimit(sample + Words{"--mem-limit", limit}), 4, {"points takes more than", "the limit is"});
  EXPECT_EQ(directory.num_files(), 0);
}

class MemoryLimit : public ::testing::Test {
 protected:
  std::string mesh(const Mesh& control) const {
    write_obj(directory / "mesh.obj", control);
    return (directory / "mesh.obj").string();
  }
  std::string out(const char* name) const { return (directory / name).string(); }
  const TemporaryDirectory directory;
};

TEST_F(MemoryLimit, OfSamplesIsObeyed) {
  const std::string torus_mesh = mesh(jittered(torus(12, 8)));
  const std::vector<std::string> command{"sample", torus_mesh, "-s", "kobbelt", "--grid", "3", "-o", out("g.csv")};
  const auto with = [&](const char* limit) {
    std::vector<std::string> all = command;
    all.insert(all.end(), {"--mem-limit", limit});
    return sublimit(all);
  };
  for (const char* limit : {"1K", "100K"}) expect_failure(with(limit), 4, {"of memory", "the limit is"});
  EXPECT_EQ(directory.num_files(), 1);
  expect_done(with("2G"));
  for (const char* limit : {"G", "-1G", "2X", "nan", "0"}) expect_failure(with(limit), 2, {"--mem-limit", limit});
}

TEST_F(MemoryLimit, OfAnalysesAndFitsIsObeyed) {
  const Mesh control = jittered(torus(12, 8));
  const std::string torus_mesh = mesh(control);
  std::ofstream(directory / "in.csv") << "face,u,v,x,y,z\n0,0.5,0.5,0,0,0\n";
  const std::vector<std::string> analyze{"analyze", torus_mesh, "-s", "catmull-clark", "--json", out("r.json")};
  const std::vector<std::string> fit{"fit",          torus_mesh, "-s", "catmull-clark", "--targets", out("in.csv"),
                                     "--thin-plate", "1",        "-o", out("f.obj")};
  for (std::vector<std::string> command : {analyze, fit}) {
    command.insert(command.end(), {"--mem-limit", "10K"});
    expect_failure(sublimit(command), 4, {"of memory", "the limit is 10.0 KB"});
    command.back() = "2G";
    EXPECT_NE(sublimit(command).status, 4);
  }
  expect_failure(sublimit({"analyze", "-s", "loop", "--mem-limit", "1G"}), 2, {"--mem-limit", "meshes"});
}

/// Pieces at a vertex of n edges depend on some n points, and each makes its blocks anew: no block may be square.
TEST_F(MemoryLimit, PiecesAtPolesTakeMemoryLikeTheirEdges) {
  std::vector<double> peaks;
  for (const Index n : {24, 48}) {
    const Outcome outcome = expect_done(sublimit({"sample", mesh(pole(n)), "-s", "interpolatory-sqrt3", "--triangulate",
                                                  "--grid", "2", "-o", out("g.csv"), "--threads", "1"}));
    peaks.push_back(double(outcome.peak_kb));
  }
  EXPECT_LT(peaks[1], 3 * peaks[0]) << "of twice as many edges";
  EXPECT_LT(peaks[1], 400e3);
}

}  // namespace
}  // namespace sublimit::testing
