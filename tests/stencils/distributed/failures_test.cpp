// SPDX-License-Identifier: Apache-2.0
// What goes wrong on one rank is told once, leaves nothing half done, and does not leave the others waiting.
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <thread>

#include "meshes/meshes.h"
#include "stencils/distributed/run_ranks.h"
#include "sublimit/io/detail/obj.h"
#include "sublimit/stencils/shards/shard_file.h"

namespace sublimit::testing {
namespace {

namespace fs = std::filesystem;

/// Files of a directory, hidden ones too.
std::vector<std::string> files(const fs::path& directory) {
  std::vector<std::string> names;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(directory, ignored))
    names.push_back(entry.path().filename().string());
  std::ranges::sort(names);
  return names;
}

/// Expects one line that has these parts.
void expect_one_line(const RanksRun& run, int status, std::initializer_list<const char*> parts) {
  EXPECT_EQ(run.status, status) << run.err;
  const std::string error = run.error();
  EXPECT_EQ(std::ranges::count(error, '\n'), 1) << error;
  for (const char* part : parts) EXPECT_NE(error.find(part), std::string::npos) << "no '" << part << "' in " << error;
}

struct BakedFiles {
  TemporaryDirectory directory;
  std::string obj = (directory / "m.obj").string(), shards = (directory / "shards").string(),
              npy = (directory / "o.npy").string();
  explicit BakedFiles(const Mesh& mesh = torus(6, 5), bool now = true) {
    write_obj(obj, mesh);
    if (!now) return;
    EXPECT_EQ(run_ranks(2, "bake " + obj + " -s catmull-clark -l 2 -o " + shards).status, 0);
  }
};

TEST(RankFailures, OptionsThatDifferAreRefused) {
  const BakedFiles files_of(torus(4, 3), false);
  const std::string bake = "bake " + files_of.obj + " -s catmull-clark -o " + files_of.shards + " -l ";
  expect_one_line(run_ranks(1, bake + "2 : -n 2 " SUBLIMIT_MPI_PROGRAM " " + bake + "3"), 2, {"rank 1", "options"});
  EXPECT_FALSE(fs::exists(files_of.shards));
}

TEST(RankFailures, AFileThatOneRankCannotReadIsTold) {
  const BakedFiles files_of(torus(4, 3), false);
  // The first rank is where the mesh is, the second is not.
  const std::string bake = "bake m.obj -s catmull-clark -l 2 -o " + files_of.shards;
  expect_one_line(run_ranks(1, bake + " : -n 1 -wdir / " SUBLIMIT_MPI_PROGRAM " " + bake,
                            "cd " + files_of.directory.path().string() + "; "),
                  3, {"m.obj", "cannot read"});
  EXPECT_FALSE(fs::exists(files_of.shards));
}

TEST(RankFailures, MeshesThatAreNoneAreRefused) {
  const TemporaryDirectory directory;
  const std::string quad = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n";
  const auto refused = [&](const char* name, const std::string& text, std::initializer_list<const char*> parts,
                           const char* options = "-s catmull-clark -l 2") {
    const std::string shards = (directory / "shards").string();
    expect_one_line(run_ranks(2, "bake " + directory.write(name, text).string() + " " + options + " -o " + shards), 3,
                    parts);
    EXPECT_FALSE(fs::exists(shards)) << text;
  };
  refused("a.obj", quad + "v 0 0 nan\n", {"a.obj:6", "coordinate z"});
  refused("a.obj", quad + "f 1 2 9\n", {"face 1", "8"});
  refused("a.obj", quad + "t crease 2/1/0 0 2 1\n", {"crease", "0 to 2"});
  refused("a.obj", quad + "t hole 1/0/0 7\n", {"hole", "7"});
  refused("a.obj", quad + "f -9 1 2\n", {"a.obj:6"});
  refused("a.obj", "v 1 2 3\n", {"no faces"});
  refused("a.obj", quad, {"triangles"}, "-s loop -l 1");
  refused("a.ply", "ply\nformat ascii 1.0\nelement vertex 0\nend_header\n", {"binary"});
  const std::string header =
      "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float "
      "z\nelement face 9\nproperty list uchar int vertex_indices\nend_header\n";
  refused("b.ply", header + std::string(80, '\0'), {"b.ply"});
  std::string polygon(36, '\0');  // the first face has more corners than there are bytes, were all like it
  polygon += std::string("\x09") + std::string(36, '\0') + std::string(60, '\x03');
  refused("b.ply", header + polygon, {"b.ply"});
  std::string far = std::string(36, '\0') + "\x03" + std::string(12, '\0');  // the second face has no such vertex
  for (int face = 1; face < 9; ++face) far += "\x03" + std::string("\x04\0\0\0", 4) + std::string(8, '\0');
  refused("b.ply", header + far, {"b.ply: byte ", "index 4 of face 1 is out of range", "0 to 2"});
  const std::string turned =
      "ply\nformat binary_little_endian 1.0\nelement face 1\nproperty list uchar int vertex_indices\nelement vertex "
      "3\nproperty uchar x\nproperty uchar y\nproperty uchar z\nend_header\n\x03";
  refused("b.ply", turned + std::string(21, '\0'), {"b.ply", "faces are before the vertices"});
  refused("c.safetensors", "", {"c.safetensors"});
  refused("d.stl", "solid", {".safetensors"});
  // A rule of a scheme, met while baking.
  const std::string semi = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 1\nf 1 2 3\nf 3 2 4\nt crease 2/1/0 1 2 1.5\n";
  const std::string shards = (directory / "shards").string();
  expect_one_line(run_ranks(2, "bake " + directory.write("e.obj", semi).string() + " -s butterfly -l 1 -o " + shards),
                  3, {"e.obj: part ", "its own numbers", "butterfly has rules for infinite sharpness"});
  EXPECT_FALSE(fs::exists(shards + "/shards.json"));
}

TEST(RankFailures, AMeshLargerThanAllMemoriesIsToldBefore) {
  const BakedFiles baked;
  const std::string bake =
      "bake " + baked.obj + " -s catmull-clark -l 2 --overwrite -o " + baked.shards + " --mem-limit ";
  expect_one_line(run_ranks(2, bake + "1K"), 4, {"m.obj", "2 on this machine", "the limit is 1.0 KB", "more machines"});
  EXPECT_EQ(run_ranks(2, "verify " + baked.shards).status, 0);
  EXPECT_EQ(run_ranks(2, bake + "1G").status, 0);
}

TEST(RankFailures, ATruncatedShardIsToldAndMadeAgain) {
  const BakedFiles baked;
  const fs::path shard = fs::path(baked.shards) / shard_name(1, 2);
  const std::string whole = read_file(shard);
  fs::resize_file(shard, whole.size() / 2);
  expect_one_line(run_ranks(2, "apply " + baked.shards + " " + baked.obj + " -o " + baked.npy), 3, {"shard-0002"});
  EXPECT_FALSE(fs::exists(baked.npy));
  expect_one_line(run_ranks(2, "verify " + baked.shards), 3, {"shard-0002"});
  const RanksRun again = run_ranks(2, "bake " + baked.obj + " -s catmull-clark -l 2 -o " + baked.shards);
  EXPECT_EQ(again.status, 0) << again.err;
  EXPECT_NE(again.out.find("1 of them there before"), std::string::npos) << again.out;
  EXPECT_EQ(read_file(shard), whole);
  // A byte of its weights.
  std::fstream(shard, std::ios::in | std::ios::out | std::ios::binary)
      .seekp(std::streamoff(whole.size()) - 5)
      .put('\x55');
  expect_one_line(run_ranks(2, "verify " + baked.shards), 3, {"shard-0002"});
}

TEST(RankFailures, AnotherMeshThanTheOneBakedIsRefused) {
  const BakedFiles baked;
  const std::string before = read_file(fs::path(baked.shards) / shard_name(0, 2));
  const std::string other = (baked.directory / "other.obj").string();
  Mesh turned = torus(6, 5);
  std::rotate(turned.face_vertices.begin(), turned.face_vertices.begin() + 1, turned.face_vertices.begin() + 4);
  write_obj(other, turned);
  expect_one_line(run_ranks(2, "apply " + baked.shards + " " + other + " -o " + baked.npy), 3, {"faces are others"});
  EXPECT_EQ(run_ranks(2, "apply " + baked.shards + " " + other + " --any-cage -o " + baked.npy).status, 0);
  const std::string bake = " -s catmull-clark -l 2 -o " + baked.shards;
  expect_one_line(run_ranks(2, "bake " + other + bake), 2, {"--overwrite"});
  expect_one_line(run_ranks(2, "bake " + baked.obj + " -s catmull-clark -l 3 -o " + baked.shards), 2, {"--overwrite"});
  EXPECT_EQ(read_file(fs::path(baked.shards) / shard_name(0, 2)), before);
  const std::string others = (fs::path(baked.shards) / "shard-notes.safetensors").string();  // no shard: not ours
  std::ofstream(others) << "notes";
  EXPECT_EQ(run_ranks(3, "bake " + other + bake + " --overwrite").status, 0);
  EXPECT_EQ(read_file(others), "notes");
  fs::remove(others);
  EXPECT_EQ(files(baked.shards), (std::vector<std::string>{"division.safetensors", shard_name(0, 3), shard_name(1, 3),
                                                           shard_name(2, 3), "shards.json"}));
}

TEST(RankFailures, VerifySeesWhatIsMissingTwiceOrForeign) {
  const BakedFiles baked;
  const fs::path directory = baked.shards, first = directory / shard_name(0, 2), second = directory / shard_name(1, 2);
  EXPECT_EQ(run_ranks(3, "verify " + baked.shards).status, 0);
  const auto with_runs = [&](const std::function<void(std::vector<PointRun>&)>& change) {
    LoadedShard loaded = load_shard(second);
    Shard shard{std::move(loaded.table), {}, std::move(loaded.inputs), {}, std::move(loaded.runs)};
    change(shard.runs);
    save_shard(second, shard, loaded.place);
  };
  const std::string whole = read_file(second);
  // One point stands where the one before it does: a gap, and a point twice.
  with_runs([](std::vector<PointRun>& runs) {
    const PointRun last = runs.back();
    --runs.back().count;
    runs.push_back({last.first + last.count - 2, 1});
  });
  const RanksRun run = run_ranks(3, "verify " + baked.shards);
  EXPECT_EQ(run.status, 3);
  EXPECT_NE(run.err.find("in two shards"), std::string::npos) << run.err;
  EXPECT_NE(run.err.find("in no shard"), std::string::npos) << run.err;
  std::ofstream(second, std::ios::binary) << whole;
  // A shard of another bake under the name of one of this.
  const std::string other = (baked.directory / "other").string();
  ASSERT_EQ(run_ranks(2, "bake " + baked.obj + " -s catmull-clark -l 1 -o " + other).status, 0);
  fs::copy_file(fs::path(other) / shard_name(1, 2), second, fs::copy_options::overwrite_existing);
  EXPECT_NE(run_ranks(2, "verify " + baked.shards).err.find("another bake"), std::string::npos);
  expect_one_line(run_ranks(2, "apply " + baked.shards + " " + baked.obj + " -o " + baked.npy), 3, {"another bake"});
  fs::remove(second);
  EXPECT_NE(run_ranks(2, "verify " + baked.shards).err.find("missing"), std::string::npos);
  std::ofstream(second, std::ios::binary) << whole;
  fs::copy_file(first, directory / shard_name(0, 7));
  EXPECT_NE(run_ranks(2, "verify " + baked.shards).err.find("another set"), std::string::npos);
}

/// A rank of a job, by a word of its command line.
pid_t find_rank(const std::string& word) {
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator("/proc", ignored)) {
    const std::string name = entry.path().filename().string();
    if (!std::ranges::all_of(name, [](char c) { return c >= '0' && c <= '9'; })) continue;
    std::ifstream comm(entry.path() / "comm"), line(entry.path() / "cmdline");
    std::string program, arguments((std::istreambuf_iterator<char>(line)), {});
    std::getline(comm, program);
    if (program == "sublimit-mpi" && arguments.find(word) != std::string::npos) return std::stoi(name);
  }
  return 0;
}

TEST(RankFailures, AKilledRankLeavesNothingHalfAndTheNextRunGoesOn) {
  const BakedFiles baked(torus(60, 50), false);
  const std::string bake = "bake " + baked.obj + " -s catmull-clark -l 3 --shards 400 -o " + baked.shards;
  RanksRun killed;
  std::thread job([&] { killed = run_ranks(2, bake); });
  const auto until = std::chrono::steady_clock::now() + std::chrono::seconds(30);
  while (files(baked.shards).size() < 20 && std::chrono::steady_clock::now() < until)
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  const pid_t rank = find_rank(baked.shards);
  if (rank > 0) ::kill(rank, SIGKILL);
  job.join();
  EXPECT_GT(rank, 0) << "the job was done before it was seen";
  EXPECT_NE(killed.status, 0);
  EXPECT_FALSE(fs::exists(baked.shards + "/shards.json"));
  const RanksRun early = run_ranks(2, "apply " + baked.shards + " " + baked.obj + " -o " + baked.npy);
  expect_one_line(early, 3, {"shards.json", "missing"});
  const RanksRun again = run_ranks(2, bake);
  EXPECT_EQ(again.status, 0) << again.err;
  EXPECT_NE(again.out.find("there before"), std::string::npos) << again.out;
  EXPECT_EQ(files(baked.shards).size(), 402u);
  EXPECT_EQ(run_ranks(2, "verify " + baked.shards).status, 0);
}

TEST(RankFailures, LinksAreFollowedAndDevicesRefused) {
  const BakedFiles baked;
  fs::create_symlink("new.npy", baked.directory / "link.npy");
  fs::create_symlink("/dev/null", baked.directory / "null.npy");
  const std::string apply = "apply " + baked.shards + " " + baked.obj + " -o " + baked.directory.path().string();
  EXPECT_EQ(run_ranks(2, apply + "/link.npy").status, 0);
  EXPECT_TRUE(fs::is_symlink(baked.directory / "link.npy"));
  EXPECT_TRUE(fs::is_regular_file(baked.directory / "new.npy"));
  expect_one_line(run_ranks(2, apply + "/null.npy"), 3, {"null.npy: cannot write", "name a file"});
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

TEST(RankFailures, AClosedPipeIsAQuietEnd) {
  const BakedFiles baked(torus(4, 3), false);
  const std::string info = SUBLIMIT_MPI_PROGRAM " info " + baked.obj + " -s catmull-clark";
  for (const std::string& line : {info, std::string(SUBLIMIT_MPI_PROGRAM " help bake")}) {
    const std::string script = "bash -c '" + line + " | true; exit ${PIPESTATUS[0]}'";
    EXPECT_EQ(std::system(script.c_str()), 0) << line;
  }
}

TEST(RankFailures, AFullDiskIsToldBeforeAnyWork) {
  const BakedFiles baked;
  // A file system of 64 KB, seen by this job alone.
  const std::string disk = (baked.directory / "disk").string();
  fs::create_directory(disk);
  const std::string alone = "unshare -rm sh -c 'mount -t tmpfs -o size=64k none " + disk + "'";
  if (std::system((alone + " 2> /dev/null").c_str()) != 0)
    GTEST_SKIP() << "NO FULL DISK: this machine does not let us mount a file system";
  const auto in_it = [&](const std::string& arguments) {
    const std::string script = (baked.directory / "job.sh").string();
    std::ofstream(script) << "mount -t tmpfs -o size=64k none " << disk << "; \"$@\"; status=$?; ls -A " << disk
                          << " | tr '\\n' ' ' > " << disk << ".files; exit $status\n";
    return run_ranks(2, arguments, "unshare -rm sh " + script + " ");
  };
  // 480 points of 24 bytes go in, 1920 do not fit beside the header of 128 bytes.
  EXPECT_EQ(in_it("apply " + baked.shards + " " + baked.obj + " -o " + disk + "/o.npy").status, 0);
  EXPECT_EQ(read_file(disk + ".files"), "o.npy ");
  const std::string finer = (baked.directory / "finer").string();
  ASSERT_EQ(run_ranks(2, "bake " + baked.obj + " -s catmull-clark -l 4 -o " + finer).status, 0);
  expect_one_line(in_it("apply " + finer + " " + baked.obj + " -o " + disk + "/o.npy"), 4, {"o.npy", "No space"});
  EXPECT_EQ(read_file(disk + ".files"), "");
  expect_one_line(in_it("bake " + baked.obj + " -s catmull-clark -l 6 --shards 9 -o " + disk + "/d"), 4,
                  {"shard-", "No space"});
  EXPECT_EQ(read_file(disk + ".files"), "d ");
}

}  // namespace
}  // namespace sublimit::testing
