// SPDX-License-Identifier: Apache-2.0
// The program as it ships, with one call of the system failing, or all from one on: its n-th allocation, its n-th
// write, rename, open, mmap or thread. Each run ends with a status of the manual and a message, and each output is as
// it was before or as it would be without the failure; nothing else lies beside them. A failed run leaves no more than
// that.
#include <gtest/gtest.h>
#include <sys/mman.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <map>
#include <new>
#include <random>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "failures/failing_calls.h"
#include "laws/full_sweep.h"
#include "stencils/cli_program.h"

namespace sublimit::testing {
namespace {

/// One way to use a subcommand. Words that begin with `<` are files of the inputs, with `>` outputs.
struct Use {
  std::string name;
  std::string words;
  std::set<std::string> changing = {};  ///< outputs with times or paths in them
  bool full = false;                    ///< for the full sweep alone
  bool drivers = false;                 ///< loads drivers of GPUs, which end the process where they lack memory
  friend std::ostream& operator<<(std::ostream& out, const Use& use) { return out << use.words; }
};

const std::vector<Use>& uses() {
  static const std::vector<Use> all{
      {"help", "help refine"},
      {"schemes", "schemes"},
      {"schemes_json", "schemes --json"},
      {"schemes_gallery", "schemes --gallery >gallery", {}, true},
      {"info", "info <cube.obj -s catmull-clark --limit"},
      {"refine", "refine <cube.obj -s catmull-clark -l 2 -o >out.obj --matrix >out.mtx"},
      {"refine_curve", "refine <polygon.csv -s chaikin -l 3 --closed -o >out.csv"},
      {"refine_ply", "refine <tetrahedron.obj -s sqrt3 -l 2 -o >out.ply", {}, true},
      {"limit", "limit <cube.obj -s catmull-clark -l 1 --normals -o >out.ply"},
      {"limit_obj", "limit <tetrahedron.obj -s modified-butterfly -l 1 -o >out.obj", {}, true},
      {"sample", "sample <cube.obj -s catmull-clark --at <places.csv --derivatives 2 -o >out.csv"},
      {"sample_recipe", "sample <spindle.json --grid 3 -o >out.csv"},
      {"sample_dual", "sample <cube.obj -s doo-sabin --no-creases --grid 3 -o >out.csv", {}, true},
      {"closest", "closest <cube.obj -s catmull-clark --points <points.csv --signed -o >out.csv"},
      {"intersect", "intersect <cube.obj -s catmull-clark --rays <rays.csv --all -o >out.csv"},
      {"tessellate", "tessellate <cube.obj -s catmull-clark --chord 5% -o >out.ply --places >places.csv"},
      {"tessellate_glb", "tessellate <cube.obj -s catmull-clark --chord 5% -o >out.glb", {}, true},
      {"tessellate_vtu", "tessellate <cube.obj -s catmull-clark --chord 5% -o >out.vtu", {}, true},
      {"flatten", "flatten <scene.usda --chord 10% -o >out.usda"},
      {"step", "step <spindle.json -o >out.step --report >out.json", {"out.step", "out.json"}, true},
      {"step_mesh", "step <cube.obj -s catmull-clark -o >out.brep", {}, true},
      {"bake", "bake <cube.obj -s catmull-clark -l 2 -o >out.safetensors"},
      {"bake_dictionary",
       "bake <cube.obj -s catmull-clark --grid 3 --derivatives 1 --dictionary >types -o >out.safetensors"},
      {"bake_manifest", "bake --manifest <jobs.jsonl --log >log.jsonl", {"log.jsonl"}, true},
      {"construct", "construct <spindle.json -o >out.obj"},
      {"implicit", "implicit <torus.json --at <points.csv -o >out.csv"},
      {"implicit_mesh", "implicit <torus.json --cells 8 --tolerance 0.3 -o >out.obj --report >found.json", {}, true},
      {"apply", "apply <table.safetensors <cube.obj -o >out.obj"},
      {"apply_npy", "apply <table.safetensors <corners.csv -o >out.npy"},
      {"devices", "devices --json", {}, true, true},
      {"verify", "verify <table.safetensors"},
      {"verify_report", "verify <report.json"},
      {"export_npz", "export <table.safetensors -o >out.npz"},
      {"export_mtx", "export <table.safetensors -o >out.mtx"},
      {"export_directory", "export <table.safetensors -o >out"},
      {"analyze", "analyze -s catmull-clark --valence 3 -o >out.html --json >out.json"},
      {"analyze_mesh", "analyze <cube.obj -s catmull-clark -o >out.html --picture >out.svg", {}, true},
      {"analyze_mask", "analyze --mask <mask -o >out.html"},
      {"fit",
       "fit <cube.obj --targets <targets.csv -s catmull-clark -o >out.obj --report >fit.json --picture >fit.svg"},
      {"demo", "demo >demo", {}, true},
  };
  return all;
}

/// What the uses read, made once.
class Inputs {
 public:
  Inputs() {
    directory_.write(
        "scene.usda",
        "#usda 1.0\ndef Mesh \"m\"\n{\n    point3f[] points = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 1)]\n"
        "    int[] faceVertexCounts = [4]\n    int[] faceVertexIndices = [0, 1, 2, 3]\n}\n");
    directory_.write("cube.obj",
                     "v -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\nv -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1\n"
                     "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\nt crease 2/1/0 0 1 2.5\n");
    directory_.write("corners.csv", "-1,-1,-1\n1,-1,-1\n1,1,-1\n-1,1,-1\n-1,-1,1\n1,-1,1\n1,1,1\n-1,1,1\n");
    directory_.write("tetrahedron.obj",
                     "v 1 1 1\nv 1 -1 -1\nv -1 1 -1\nv -1 -1 1\nf 1 2 3\nf 1 4 2\nf 1 3 4\nf 2 4 3\n");
    directory_.write("polygon.csv", "0,0\n2,0\n2,1\n0,3\n");
    directory_.write("places.csv", "face,u,v\n0,0,0\n1,0.25,0.5\n5,1,1\n");
    directory_.write("points.csv", "x,y,z\n0.1,0.2,0.3\n2,2,2\n1.4,0,0.1\n");
    directory_.write("rays.csv", "ox,oy,oz,dx,dy,dz\n0.1,0.2,-5,0,0,1\n-4,-3,-5,4,3,5\n");
    directory_.write(
        "spindle.json",
        R"({"kind": "revolution", "name": "spindle", "profile": {"degree": 2, "knots": [0, 0, 0, 1, 1, 1],)"
        R"( "points": [[0, -1], [2, 0], [0, 1]]}})");
    directory_.write("torus.json", R"({"kind": "implicit", "field": "distance-circle", "center": [0, 0, 0],)"
                                   R"( "normal": [0, 0, 1], "ring": 1, "radius": 0.4})");
    directory_.write("targets.csv", "vertex,x,y,z\n0,-1,-1,-1\n6,1,1,1\n");
    directory_.write("jobs.jsonl",
                     R"({"mesh": "cube.obj", "scheme": "catmull-clark", "levels": 1, "output": "1.safetensors"})"
                     "\n");
    expect_done(
        sublimit({"bake", path("cube.obj"), "-s", "catmull-clark", "-l", "1", "-o", path("table.safetensors")}));
    sublimit({"analyze", "-s", "loop", "--valence", "3", "-o", path("report.html"), "--json", path("report.json")});
  }
  std::string path(const std::string& name) const { return (directory_ / name).string(); }

 private:
  TemporaryDirectory directory_;
};
const Inputs& inputs() {
  static const Inputs all;
  return all;
}

using Files = std::map<std::string, std::string>;  // bytes by path

Files files_in(const std::filesystem::path& directory) {
  Files files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(directory))
    if (entry.is_regular_file()) files[entry.path().lexically_relative(directory).string()] = read_file(entry.path());
  return files;
}

/// The page that the program reads what fails from, and counts in.
class SharedPage {
 public:
  explicit SharedPage(const TemporaryDirectory& directory) : path_((directory / "page").string()) {
    const int file = ::open(path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
    void* const page = ::ftruncate(file, sizeof(FailingCalls)) == 0
                           ? ::mmap(nullptr, sizeof(FailingCalls), PROT_READ | PROT_WRITE, MAP_SHARED, file, 0)
                           : MAP_FAILED;
    ::close(file);
    if (page == MAP_FAILED) throw std::runtime_error("no page to share");
    calls_ = new (page) FailingCalls;
  }
  SharedPage(const SharedPage&) = delete;
  ~SharedPage() { ::munmap(calls_, sizeof(FailingCalls)); }
  FailingCalls& reset() { return *new (calls_) FailingCalls; }
  const FailingCalls& calls() const { return *calls_; }
  const std::string& path() const { return path_; }

 private:
  std::string path_;
  FailingCalls* calls_;
};

struct Case {
  Call call;
  Failing failing;
  int error;
  std::vector<int> statuses;      ///< that may come of it
  std::vector<std::string> told;  ///< one of these is in the message
};
const std::vector<Case> cases{
    {Call::memory, Failing::once, ENOMEM, {4}, {"memory"}},
    {Call::memory, Failing::on, ENOMEM, {4}, {"memory"}},
    {Call::map, Failing::once, ENOMEM, {4}, {"memory"}},
    {Call::thread, Failing::on, EAGAIN, {4}, {"temporarily unavailable", "threads"}},
    {Call::write, Failing::once, ENOSPC, {4}, {"No space"}},
    {Call::write, Failing::on, EIO, {3}, {"error"}},
    {Call::write, Failing::short_, 0, {}, {""}},
    {Call::rename, Failing::once, EACCES, {3}, {"denied"}},
    {Call::open, Failing::once, EMFILE, {3}, {"open files"}},
};
const char* const call_names[num_calls] = {"allocation", "mmap", "write", "rename", "open", "thread"};

/// Runs one use again and again.
class Runs {
 public:
  explicit Runs(const Use& use) : use_(use), page_(page_directory_) {
    std::istringstream words(use.words);
    for (std::string word; words >> word;) words_.push_back(word);
    if (!full_sweep() && use.words.find("-s") != std::string::npos) words_.insert(words_.end(), {"--threads", "1"});
  }

  void all() {
    page_.reset();
    const auto begin = std::chrono::steady_clock::now();
    {
      const TemporaryDirectory out;
      const Outcome outcome = run(out);
      ASSERT_TRUE(outcome.status == 0 || outcome.status == 1) << outcome.status << outcome.err;
      status_ = outcome.status;
      right_ = files_in(out.path());
    }
    std::int64_t counts[num_calls];
    for (int i = 0; i < num_calls; ++i) counts[i] = page_.calls().counts[i];
    ASSERT_GT(counts[0], 0) << "nothing was counted";
    // Draws fewer failures for long uses: one alone would take an hour.
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
    const int drawn = full_sweep() ? std::clamp(int(20 / seconds.count()), 5, 60) : 3;
    std::mt19937 random(40);
    for (const Case& one : cases) {
      if (use_.drivers && (one.call == Call::memory || one.call == Call::map)) continue;
      const std::int64_t count = counts[static_cast<int>(one.call)];
      std::set<std::int64_t> at;
      for (std::int64_t n = 1; n <= count; n *= 2) at.insert(n);
      for (int i = 0; i < drawn && count > 0; ++i)
        at.insert(std::uniform_int_distribution<std::int64_t>(1, count)(random));
      for (const std::int64_t n : at) check(one, n);
      if (::testing::Test::HasFatalFailure()) return;
    }
    RecordProperty("injected", int(injected_));
  }

 private:
  static void RecordProperty(const char* name, int value) { ::testing::Test::RecordProperty(name, value); }

  Outcome run(const TemporaryDirectory& out) {
    std::vector<std::string> words = words_;
    for (std::string& word : words) {
      if (word == "<mask") word = "1 4 6 4 1 /8";
      if (word.starts_with("<")) word = inputs().path(word.substr(1));
      if (word.starts_with(">")) word = word.substr(1);
      if (word.ends_with("jobs.jsonl")) {
        std::string jobs = read_file(word);
        jobs.insert(jobs.find("1.safetensors"), out.path().string() + "/");
        jobs.insert(jobs.find("cube.obj"), std::filesystem::path(word).parent_path().string() + "/");
        word = page_directory_.write("jobs.jsonl", jobs).string();
      }
    }
    return sublimit(words, [&] {
      ::setenv("LD_PRELOAD", SUBLIMIT_FAILING_CALLS, 1);
      ::setenv(failing_calls_variable, page_.path().c_str(), 1);
      ::alarm(full_sweep() ? 600 : 120);                   // a run that hangs is killed
      if (::chdir(out.path().c_str()) != 0) ::_exit(127);  // reports name their files: the same words in each run
    });
  }

  void check(const Case& one, std::int64_t n) {
    FailingCalls& calls = page_.reset();
    calls.call = one.call;
    calls.failing = one.failing;
    calls.error = one.error;
    calls.at = n;
    const TemporaryDirectory out;
    Files before;
    for (const auto& [name, bytes] : right_)
      if (name.find('/') == std::string::npos && name != "types" && name != "1.safetensors" &&
          !use_.changing.contains(name))
        before[name] = "what was there before\n", out.write(name, before[name]);
    const Outcome outcome = run(out);
    ++injected_;
    std::ostringstream what;
    what << use_.words << ", " << call_names[static_cast<int>(one.call)] << " " << n
         << (one.failing == Failing::on ? " and all after it" : "") << ": status " << outcome.status << ", "
         << page_.calls().failed << " failed\n"
         << outcome.err;
    SCOPED_TRACE(what.str());
    const bool done = outcome.status == status_;
    // Eigen 3.4: a decomposition that is replaced by a larger one is destroyed twice if there is no memory for that.
    if (one.call == Call::memory && outcome.status == -1 && outcome.err.find("double free") != std::string::npos) {
      EXPECT_LT(++destroyed_twice_, 4);
      return;
    }
    EXPECT_TRUE(done || std::ranges::find(one.statuses, outcome.status) != one.statuses.end());
    if (!done) {
      if (one.call != Call::write || one.failing != Failing::on) {  // then there is nowhere to tell it
        EXPECT_TRUE(outcome.err.find("sublimit: ") != std::string::npos && outcome.err.ends_with("\n"));
        EXPECT_TRUE(std::ranges::any_of(
            one.told, [&](const std::string& part) { return outcome.err.find(part) != std::string::npos; }));
      }
      EXPECT_EQ(outcome.err.find("a fault of ours"), std::string::npos);
    }
    const Files after = files_in(out.path());
    for (const auto& [name, bytes] : after) {
      EXPECT_TRUE(right_.contains(name)) << name << " was left";
      if (!right_.contains(name) || use_.changing.contains(name)) continue;
      EXPECT_TRUE(bytes == right_.at(name) || (!done && before.contains(name) && bytes == before.at(name)))
          << name << " has " << bytes.size() << " bytes of " << right_.at(name).size();
    }
    if (done) {
      EXPECT_EQ(after.size(), right_.size());
    }
    for (const auto& [name, bytes] : before) EXPECT_TRUE(after.contains(name)) << name << " is gone";
    for (const auto& entry : std::filesystem::directory_iterator(out.path()))
      EXPECT_FALSE(entry.path().filename().string().starts_with(".")) << entry.path() << " was left";
  }

  const Use& use_;
  std::vector<std::string> words_;
  TemporaryDirectory page_directory_;
  SharedPage page_;
  Files right_;
  int status_ = 0;
  std::int64_t injected_ = 0, destroyed_twice_ = 0;
};

class FailingCallsOf : public ::testing::TestWithParam<Use> {};
TEST_P(FailingCallsOf, EndCleanlyAndLeaveNothing) { Runs(GetParam()).all(); }

std::vector<Use> chosen() {
  std::vector<Use> chosen;
  for (const Use& use : uses())
    if (!use.full || full_sweep()) chosen.push_back(use);
  return chosen;
}
INSTANTIATE_TEST_SUITE_P(Program, FailingCallsOf, ::testing::ValuesIn(chosen()),
                         [](const auto& tested) { return tested.param.name; });

/// The subcommands that the program itself lists.
std::set<std::string> subcommands() {
  std::set<std::string> names;
  std::istringstream help(expect_done(sublimit({"--help"})).out);
  bool listed = false;
  for (std::string line; std::getline(help, line);) {
    if (line.starts_with("Subcommands:")) {
      listed = true;
    } else if (listed && line.starts_with("  ") && line.size() > 2 && line[2] != ' ') {
      names.insert(line.substr(2, line.find(' ', 2) - 2));
    } else if (listed && !line.starts_with(" ")) {
      break;
    }
  }
  return names;
}

TEST(FailingCallsOfProgram, AreOfEverySubcommand) {
  std::set<std::string> used;
  for (const Use& use : uses()) used.insert(use.words.substr(0, use.words.find(' ')));
  EXPECT_EQ(used, subcommands());
}

}  // namespace
}  // namespace sublimit::testing
