// SPDX-License-Identifier: Apache-2.0
// `sublimit bake`: the file is the table that the library makes, the same for any number of threads, or nothing.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <csignal>

#include "stencils/cli_tables.h"
#include "sublimit/eval/file/table_file.h"
#include "sublimit/schemes/schemes.h"
#include "sublimit/stencils/bake/detail/bake.h"
#include "sublimit/stencils/bake/detail/table_info.h"

namespace sublimit::testing {
namespace {

TEST(CliBake, WritesWhatTheLibraryMakes) {
  const Tables on(creased_cube());
  const Mesh read = read_mesh(on.mesh);
  const auto expect_table = [&](std::vector<std::string> arguments, const BakeRequest& request) {
    SCOPED_TRACE(arguments[0] + arguments[1]);
    Patterns patterns(find_scheme("catmull-clark").value());
    BakedTable<double> table = bake(patterns, read, request).table;
    const std::filesystem::path own = on.directory / "own";
    save_table(own, in_float(table));
    const std::string out = expect_done(on.bake(arguments)).out;
    expect_parts(out, {"table.safetensors", std::to_string(table.table.num_points()) + " points of 8", "float", " s"});
    EXPECT_EQ(read_file(on.table), read_file(own));
    save_table(own, table);
    arguments.insert(arguments.end(), {"--precision", "double", "--quiet"});
    EXPECT_EQ(expect_done(on.bake(arguments)).out, "");
    EXPECT_EQ(read_file(on.table), read_file(own));
  };
  expect_table({"-l", "3"}, {.level = 3});
  expect_table({"-l", "0", "--limit"}, {.rows = TableRows::limit, .level = 0});
  expect_table({"-l", "2", "--limit", "--derivatives", "1"}, {.rows = TableRows::limit, .level = 2, .derivatives = 1});
  expect_table({"--grid", "4", "--derivatives", "2"}, {.rows = TableRows::grid, .grid = 4, .derivatives = 2});
  const std::string places = on.directory.write("in.csv", "face,u,v\n0,0.25,0.5\n5,1,0\n").string();
  expect_table({"--at", places}, {.rows = TableRows::samples, .samples = {{0, 0.25, 0.5}, {5, 1, 0}}});
}

TEST(CliBake, KeepsADictionaryFromRunToRun) {
  const Tables on(creased_cube());
  const std::string file = (on.directory / "types").string(), several = (on.directory / "several").string();
  expect_done(on.bake({"-l", "3"}));
  const std::string plain = read_file(on.table);
  expect_done(on.bake({"-l", "3", "--dictionary", file}));
  EXPECT_EQ(read_file(on.table), plain);
  const std::string first = read_file(file);
  expect_done(on.bake({"-l", "3", "--dictionary", file}));
  EXPECT_EQ(read_file(on.table), plain);
  EXPECT_EQ(read_file(file), first);
  expect_done(on.bake({"-l", "2", "--limit", "--dictionary", file}));
  EXPECT_GT(read_file(file).size(), first.size());
  expect_failure(on.bake({"-l", "2", "--dictionary", file}, "bilinear"), 3,
                 {"types", "'catmull-clark', not of 'bilinear'"});
  std::filesystem::create_directory(several);
  expect_done(on.bake({"-l", "2", "--dictionary", several}, "bilinear"));
  expect_done(on.bake({"-l", "2", "--dictionary", several}));
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(several), std::filesystem::directory_iterator()), 2);
}

TEST(CliBake, SaysWhatWasChosen) {
  const Tables quads(torus(12, 8)), mixed(prism(5));
  expect_parts(expect_done(quads.bake({"-l", "2"})).out, {"by patterns: 1 types, 1 blocks"});
  expect_parts(expect_done(mixed.bake({"-l", "2"})).out, {"by rows then patterns: "});
  expect_parts(expect_done(mixed.bake({"-l", "2"}, "doo-sabin")).out, {"by patterns: "});
  expect_parts(expect_done(mixed.bake({"-l", "1"}, "mid-edge")).out, {"by rows\n"});
}

TEST(CliBake, SameBytesForAnyNumberOfThreads) {
  const Tables on(jittered(disjoint_union(prism(7), torus(40, 30))));
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"-l", "3"}, {"--grid", "3", "--derivatives", "1"}, {"-l", "1", "--limit"}}) {
    const auto bytes = [&](const char* threads) {
      std::vector<std::string> all = arguments;
      all.insert(all.end(), {"--threads", threads});
      expect_done(on.bake(all));
      return read_file(on.table);
    };
    const std::string one = bytes("1");
    EXPECT_EQ(one, bytes("2"));
    EXPECT_EQ(one, bytes("7"));
  }
}

TEST(CliBake, OptionsAreInTheTable) {
  const Tables on(prism(5));
  const auto info = [&](const std::vector<std::string>& arguments, const std::string& scheme) {
    expect_done(on.bake(arguments, scheme));
    return std::get<BakedTable<float>>(load_table(on.table)).info;
  };
  const TableInfo loop = info({"-l", "1", "--triangulate", "--boundary", "edge-only"}, "loop");
  EXPECT_EQ(loop.options.at("boundary"), "edge-only");
  EXPECT_EQ(loop.options.at("tags"), "none");
  EXPECT_TRUE(loop.tool.starts_with("sublimit ")) << loop.tool;
  EXPECT_EQ(info({"-l", "1", "--triangles", "smooth"}, "catmull-clark").options.at("triangles"), "smooth");
  EXPECT_EQ(info({"-l", "1", "--option", "degree=3"}, "averaging").options.at("degree"), "3");
}

TEST(CliBake, PlanTellsAndMakesNothing) {
  const Tables on(torus(12, 8));
  const std::string told = expect_done(on.bake({"-l", "3", "--plan"})).out;
  expect_parts(told, {"6144 points of 96 by patterns: 1 types, 1 blocks", "of table in float", "of memory"});
  EXPECT_EQ(on.directory.num_files(), 1);
  EXPECT_EQ(expect_done(sublimit({"bake", on.mesh, "-s", "catmull-clark", "-l", "3", "--plan"})).out, told);
  // The bytes of the plan are those of the bake.
  const auto bytes = [](const std::string& out, const char* before) {
    const size_t at = out.find('\n') + 1;
    return out.substr(at, out.find(before, at) - at);
  };
  EXPECT_EQ(bytes(told, " of table"), bytes(expect_done(on.bake({"-l", "3"})).out, " in memory"));
}

TEST(CliBake, MemoryLimitIsObeyed) {
  const Tables on(torus(60, 50));
  for (const char* limit : {"100K", "0.1M", "1000", "90KiB", "100KB"})
    expect_failure(on.bake({"-l", "3", "--mem-limit", limit}), 4, {"mesh.obj", "of memory", "the limit is"});
  EXPECT_EQ(on.directory.num_files(), 1);
  expect_done(on.bake({"-l", "3", "--mem-limit", "2G"}));
  for (const char* limit : {"G", "-1G", "2X", "1e3", "nan", "0", "2GBi"})
    expect_failure(on.bake({"-l", "3", "--mem-limit", limit}), 2, {"--mem-limit", limit});
}

TEST(CliBake, BadCommandLines) {
  const Tables on(creased_cube());
  const std::string in = on.directory.write("in.csv", "face,u,v\n0,0,0\n").string();
  const auto refused = [&](const std::vector<std::string>& arguments, int status,
                           std::initializer_list<std::string_view> parts, const std::string& scheme = "catmull-clark") {
    expect_failure(on.bake(arguments, scheme), status, parts);
    EXPECT_EQ(on.directory.num_files(), 2);
  };
  refused({}, 2, {"-l LEVELS", "--grid", "--at"});
  refused({"-l", "2", "--grid", "3"}, 2, {"more than one"});
  refused({"--grid", "3", "--limit"}, 2, {"--limit"});
  refused({"-l", "2", "--derivatives", "1"}, 2, {"--derivatives", "--limit"});
  refused({"-l", "2", "--limit", "--derivatives", "3"}, 2, {"derivatives"});
  refused({"-l", "2", "--precision", "half"}, 2, {"precision", "half"});
  refused({"--grid", "3", "--face-varying", "all"}, 2, {"--face-varying"});
  refused({"-l", "2", "--shard", "1/2"}, 2, {"--shard", "--manifest"});
  for (const char* level : {"0", "12", "-1", "two"}) refused({"-l", level}, 2, {level});
  for (const char* N : {"1", "2049"}) refused({"--grid", N}, 2, {"grid", N});
  refused({"-l", "2"}, 2, {"catmull-clarc", "catmull-clark"}, "catmull-clarc");
  refused({"-l", "2"}, 2, {"chaikin", "curves"}, "chaikin");
  refused({"-l", "2"}, 3, {"mesh.obj", "loop"}, "loop");
  refused({"--at", on.directory.write("in.csv", "face,u,v\n9,0,0\n").string()}, 3, {"in.csv:2", "face 9"});
  expect_failure(sublimit({"bake"}), 2, {"MESH is missing"});
  expect_failure(sublimit({"bake", on.mesh, "-s", "loop", "-l", "1"}), 2, {"-o", "is missing"});
  expect_failure(sublimit({"bake", on.mesh, "-s", "loop", "-l", "1", "-o", "t.bin"}), 2, {"t.bin", ".safetensors"});
  expect_failure(sublimit({"bake", on.path("none.obj"), "-s", "loop", "-l", "1", "-o", on.table}), 3, {"none.obj"});
}

TEST(CliBake, FullDiskLeavesNothing) {
  const Tables on(torus(60, 50));
  const auto fill_disk = [] {
    const rlimit limit{4096, 4096};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  };
  expect_failure(on.bake({"-l", "3"}, "catmull-clark", fill_disk), 4, {"table.safetensors", "cannot write"});
  EXPECT_EQ(on.directory.num_files(), 1);
}

TEST(CliBake, InterruptLeavesNothing) {
  const Tables on(cube());
  const std::string pipe = on.path("in.csv");
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  Program program({"bake", on.mesh, "-s", "catmull-clark", "--at", pipe, "-o", on.table});
  std::signal(SIGPIPE, SIG_IGN);  // a program that ends too early shows below
  std::ofstream file(pipe);
  file << "face,u,v\n0,0,0\n" << std::flush;
  ::kill(program.id(), SIGINT);
  EXPECT_EQ(program.wait().status, 130);
  EXPECT_EQ(on.directory.num_files(), 2);
}

/// While the file is written too: it is large, and may be complete before we act.
TEST(CliBake, InterruptWhileWritingLeavesNothing) {
  const Tables on(torus(48, 48));
  const auto begun = [&] {
    for (const auto& entry : std::filesystem::directory_iterator(on.directory.path()))
      if (entry.path().extension() == ".tmp") return true;
    return false;
  };
  bool in_time = false;
  for (int attempt = 0; attempt < 20 && !in_time; ++attempt) {
    Program program({"bake", on.mesh, "-s", "mid-edge", "-l", "5", "--precision", "double", "-o", on.table});
    while (!begun() && !std::filesystem::exists(on.table) && ::kill(program.id(), 0) == 0) continue;
    ::kill(program.id(), SIGINT);
    const int status = program.wait().status;
    EXPECT_TRUE(status == 130 || status == 0) << status;
    in_time = status == 130 && !std::filesystem::exists(on.table);
    std::filesystem::remove(on.table);
    EXPECT_EQ(on.directory.num_files(), 1);
  }
  EXPECT_TRUE(in_time);
}

}  // namespace
}  // namespace sublimit::testing
