// SPDX-License-Identifier: Apache-2.0
// `sublimit bake --manifest`: every job of a share is done once, whatever becomes of the others.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "stencils/cli_tables.h"

namespace sublimit::testing {
namespace {

using Json = nlohmann::json;

class Farm {
 public:
  Farm() {
    write_obj(directory / "cube.obj", creased_cube());
    write_obj(directory / "ring.obj", jittered(torus(8, 6)));
  }
  std::string path(std::string_view name) const { return (directory / name).string(); }
  void write(const std::vector<std::string>& lines) const {
    std::string text;
    for (const std::string& line : lines) text += line + "\n";
    directory.write("jobs.jsonl", text);
  }
  Outcome run(const std::vector<std::string>& arguments = {}) const {
    std::vector<std::string> all{"bake", "--manifest", path("jobs.jsonl")};
    all.insert(all.end(), arguments.begin(), arguments.end());
    return sublimit(all);
  }
  std::vector<Json> log(const std::string& name = "log.jsonl") const {
    std::vector<Json> lines;
    std::istringstream text(read_file(path(name)));
    for (std::string line; std::getline(text, line);) lines.push_back(Json::parse(line));
    return lines;
  }
  TemporaryDirectory directory;
};

std::string job(const std::string& mesh, const std::string& output, const std::string& rest = "\"levels\": 2") {
  return R"({"mesh": ")" + mesh + R"(", "scheme": "catmull-clark", "output": ")" + output + "\", " + rest + "}";
}

TEST(CliManifest, MakesWhatBakeMakes) {
  const Farm farm;
  std::filesystem::create_directory(farm.directory / "tables");
  farm.write({job("cube.obj", "tables/a.safetensors"), "",
              job("ring.obj", "b.safetensors", R"("grid": 3, "derivatives": 1, "precision": "double")"),
              R"({"mesh": "cube.obj", "scheme": "averaging", "options": {"degree": 3}, "no-creases": true,
                 "levels": 1, "output": "c.safetensors"})",
              job(farm.path("cube.obj"), "d.safetensors",
                  R"("levels": 1, "limit": true, "boundary": "none", "creasing": "chaikin", "triangles": "smooth")")});
  // A job is a line.
  std::string text = read_file(farm.path("jobs.jsonl"));
  text.replace(text.find(",\n     "), 2, ",");
  farm.directory.write("jobs.jsonl", text);
  expect_parts(expect_done(farm.run({"--threads", "2"})).out, {"4 jobs: 4 done, 0 skipped, 0 failed\n"});
  const auto expect_same = [&](const char* name, std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "bake");
    arguments.insert(arguments.end(), {"-o", farm.path("own.safetensors")});
    expect_done(sublimit(arguments));
    EXPECT_EQ(read_file(farm.path(name)), read_file(farm.path("own.safetensors"))) << name;
  };
  expect_same("tables/a.safetensors", {farm.path("cube.obj"), "-s", "catmull-clark", "-l", "2"});
  expect_same("b.safetensors", {farm.path("ring.obj"), "-s", "catmull-clark", "--grid", "3", "--derivatives", "1",
                                "--precision", "double"});
  expect_same("c.safetensors",
              {farm.path("cube.obj"), "-s", "averaging", "--option", "degree=3", "--no-creases", "-l", "1"});
  expect_same("d.safetensors", {farm.path("cube.obj"), "-s", "catmull-clark", "-l", "1", "--limit", "--boundary",
                                "none", "--creasing", "chaikin", "--triangles", "smooth"});
}

TEST(CliManifest, SkipsWhatIsThereAndSound) {
  const Farm farm;
  farm.write({job("cube.obj", "a.safetensors"), job("ring.obj", "b.safetensors")});
  const auto statuses = [&] {
    std::filesystem::remove(farm.path("log.jsonl"));
    expect_done(farm.run({"--log", farm.path("log.jsonl")}));
    std::string all;
    for (const Json& line : farm.log()) all += line["status"].get<std::string>() + " ";
    return all;
  };
  EXPECT_EQ(statuses(), "done done ");
  const std::string before = read_file(farm.path("a.safetensors"));
  EXPECT_EQ(statuses(), "skipped skipped ");
  std::string broken = before;
  broken.back() = static_cast<char>(broken.back() ^ 1);
  farm.directory.write("a.safetensors", broken);
  EXPECT_EQ(statuses(), "done skipped ");
  EXPECT_EQ(read_file(farm.path("a.safetensors")), before);
  farm.directory.write("a.safetensors", before.substr(0, before.size() / 2));
  EXPECT_EQ(statuses(), "done skipped ");
  std::filesystem::remove(farm.path("b.safetensors"));
  EXPECT_EQ(statuses(), "skipped done ");
  // Another job of the same output.
  farm.write({job("cube.obj", "a.safetensors", "\"levels\": 3"), job("cube.obj", "b.safetensors")});
  EXPECT_EQ(statuses(), "done done ");
  farm.write({job("cube.obj", "a.safetensors", R"("levels": 3, "precision": "double")"),
              job("cube.obj", "b.safetensors", R"("levels": 2, "no-creases": true)")});
  EXPECT_EQ(statuses(), "done done ");
  // Points that move are no other job; faces and tags are.
  write_obj(farm.directory / "cube.obj", jittered(creased_cube(), 0.1, 5));
  EXPECT_EQ(statuses(), "skipped skipped ");
  Mesh sharper = creased_cube();
  sharper.creases.back().sharpness = 2;
  write_obj(farm.directory / "cube.obj", sharper);
  EXPECT_EQ(statuses(), "done skipped ");  // the second drops creases
}

TEST(CliManifest, AFailedJobDoesNotStopTheOthers) {
  const Farm farm;
  farm.write({job("none.obj", "a.safetensors"), job("cube.obj", "b.safetensors", "\"levels\": 99"),
              job("cube.obj", "nowhere/c.safetensors"), job("ring.obj", "d.safetensors")});
  const Outcome outcome = farm.run({"--log", farm.path("log.jsonl")});
  EXPECT_EQ(outcome.status, 3);
  expect_parts(outcome.err, {"jobs.jsonl:1: ", "none.obj", "jobs.jsonl:2: ", "99", "jobs.jsonl:3: ", "nowhere"});
  expect_parts(outcome.out, {"4 jobs: 1 done, 0 skipped, 3 failed"});
  EXPECT_TRUE(std::filesystem::exists(farm.path("d.safetensors")));
  const std::vector<Json> log = farm.log();
  ASSERT_EQ(log.size(), 4u);
  const int exits[] = {3, 2, 3, 0};
  for (size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(log[i]["line"], i + 1);
    EXPECT_EQ(log[i]["exit"], exits[i]);
    EXPECT_EQ(log[i]["status"], exits[i] == 0 ? "done" : "failed");
    EXPECT_EQ(log[i].contains("error"), exits[i] != 0);
    EXPECT_GE(log[i]["seconds"].get<double>(), 0);
    EXPECT_GT(log[i]["peak_memory"].get<double>(), 1e6);
  }
  EXPECT_EQ(log[3]["bytes"], std::filesystem::file_size(farm.path("d.safetensors")));
  // The status is that of the worst.
  farm.write({job("cube.obj", "b.safetensors", "\"levels\": 99"), job("ring.obj", "d.safetensors")});
  EXPECT_EQ(farm.run().status, 2);
  EXPECT_EQ(farm.run({"--mem-limit", "10K"}).status, 2) << "what is there takes none";
  farm.write({job("ring.obj", "e.safetensors")});
  EXPECT_EQ(farm.run({"--mem-limit", "10K"}).status, 4);
}

TEST(CliManifest, SharesAreAPartition) {
  const Farm farm;
  std::vector<std::string> jobs;
  for (int i = 0; i < 7; ++i) jobs.push_back(job("cube.obj", std::to_string(i) + ".safetensors"));
  farm.write(jobs);
  const std::string log = farm.path("log.jsonl");
  for (const char* shard : {"1/3", "2/3", "3/3"}) expect_done(farm.run({"--shard", shard, "--log", log}));
  std::set<int> lines;
  for (const Json& line : farm.log()) {
    EXPECT_EQ(line["status"], "done");
    lines.insert(line["line"].get<int>());
  }
  EXPECT_EQ(farm.log().size(), 7u);
  EXPECT_EQ(lines.size(), 7u);
  expect_done(farm.run({"--shard", "9/9"}));
  for (const char* shard : {"0/3", "4/3", "3", "a/b", "1/0", "-1/3", "1/3/5"})
    expect_failure(farm.run({"--shard", shard}), 2, {"--shard", shard});
}

TEST(CliManifest, IsReadBeforeAnyJob) {
  const Farm farm;
  const auto refused = [&](const std::string& line, std::initializer_list<std::string_view> parts) {
    farm.write({job("cube.obj", "a.safetensors"), line});
    expect_failure(farm.run(), 3, parts);
    EXPECT_EQ(farm.directory.num_files(), 3);
  };
  refused("{", {"jobs.jsonl:2", "JSON"});
  refused(R"({"mesh": "a.obj", "mesh": "b.obj"})", {"jobs.jsonl:2", "\"mesh\" twice"});
  refused("[]", {"jobs.jsonl:2", "object"});
  refused(job("cube.obj", "b.safetensors", "\"level\": 2"), {"jobs.jsonl:2", "\"level\"", "levels"});
  refused(job("cube.obj", "b.safetensors", "\"levels\": \"2\""), {"levels: is", "whole number"});
  refused(job("cube.obj", "b.safetensors", "\"levels\": 2.5"), {"levels: is", "whole number"});
  refused(job("cube.obj", "b.safetensors", "\"levels\": 99999999999"), {"levels: is", "whole number"});
  refused(job("cube.obj", "b.safetensors", "\"derivatives\": 3"), {"derivatives: is 3", "from 0 to 2"});
  refused(job("cube.obj", "b.safetensors", "\"precision\": \"half\""), {"half", "float, double"});
  refused(job("cube.obj", "b.safetensors", "\"limit\": 1"), {"limit: is 1", "true or false"});
  refused(job("cube.obj", "b.safetensors", "\"options\": [1]"), {"options: is", "object"});
  refused(job("cube.obj", ""), {"output: is empty", "text"});
  refused(R"({"mesh": "cube.obj", "output": "b.safetensors", "levels": 1})", {"the field scheme is missing"});
  refused(job("ring.obj", "./a.safetensors"), {"jobs.jsonl:2: output: ", "line 1"});
  expect_failure(sublimit({"bake", "--manifest", farm.path("none.jsonl")}), 3, {"none.jsonl"});
  farm.write({});
  expect_parts(expect_done(farm.run()).out, {"0 jobs"});
}

TEST(CliManifest, TakesNoOptionsOfOneTable) {
  const Farm farm;
  farm.write({job("cube.obj", "a.safetensors")});
  expect_failure(farm.run({"-l", "2"}), 2, {"--levels", "--manifest"});
  expect_failure(farm.run({"--boundary", "none"}), 2, {"--boundary", "--manifest"});
  expect_failure(farm.run({farm.path("cube.obj")}), 2, {"MESH", "--manifest"});
  expect_failure(farm.run({"--log", farm.path("nowhere/log")}), 3, {"nowhere/log"});
  EXPECT_EQ(farm.directory.num_files(), 3);
}

}  // namespace
}  // namespace sublimit::testing
