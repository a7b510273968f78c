// SPDX-License-Identifier: Apache-2.0
// Outputs named by links: the file at the end of the link is written, whether or not it is there, and the link stays.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <linux/capability.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/stat.h>

#include "meshes/meshes.h"
#include "stencils/cli_program.h"
#include "sublimit/io/detail/obj.h"

namespace sublimit::testing {
namespace {

namespace fs = std::filesystem;

class CliLinks : public ::testing::Test {
 protected:
  CliLinks() {
    write_obj(mesh, cube());
    fs::create_directory(directory / "there");
    fs::create_directory(directory / "empty");
  }
  std::string path(const std::string& name) const { return (directory / name).string(); }
  void link(const std::string& name, const std::string& to) const { fs::create_symlink(to, directory / name); }
  Outcome refine(const std::string& out, const std::function<void()>& prepare = {}) const {
    return sublimit({"refine", mesh, "-s", "catmull-clark", "-l", "1", "-o", path(out)}, prepare);
  }

  const TemporaryDirectory directory;
  const std::string mesh = path("mesh.obj");
};

TEST_F(CliLinks, AreFollowedToTheirEnd) {
  expect_done(refine("plain.obj"));
  const std::string expected = read_file(path("plain.obj"));
  directory.write("old.obj", "what was there");
  link("dangling.obj", "there/new.obj");
  link("of_link.obj", "second.obj");
  link("second.obj", path("there/newer.obj"));
  link("existing.obj", "old.obj");
  for (const auto& [name, end] : {std::pair("dangling.obj", "there/new.obj"),
                                  {"of_link.obj", "there/newer.obj"},
                                  {"second.obj", "there/newer.obj"},
                                  {"existing.obj", "old.obj"}}) {
    expect_done(refine(name));
    EXPECT_TRUE(fs::is_symlink(directory / name)) << name;
    EXPECT_FALSE(fs::is_symlink(directory / end)) << end;
    EXPECT_EQ(read_file(path(end)), expected);
  }
}

TEST_F(CliLinks, ThatLeadNowhereAreErrors) {
  link("circle.obj", "round.obj");
  link("round.obj", "circle.obj");
  link("missing.obj", "none/out.obj");
  link("folder.obj", "there");
  const long files = directory.num_files();
  expect_failure(refine("circle.obj"), 3, {"circle.obj", "cannot write", "Too many levels of symbolic links"});
  expect_failure(refine("missing.obj"), 3, {"missing.obj", "it is a link to", "none/out.obj", "is not a directory"});
  expect_failure(refine("folder.obj"), 3, {"folder.obj", "it is a directory; name a file in it"});
  EXPECT_EQ(directory.num_files(), files);
  EXPECT_TRUE(fs::is_symlink(directory / "circle.obj"));
}

TEST_F(CliLinks, ToDevicesAndPipesAreWrittenInPlace) {
  link("null.obj", "/dev/null");
  expect_done(refine("null.obj"));
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
  link("full.obj", "/dev/full");
  expect_failure(refine("full.obj"), 4, {"full.obj: cannot write: No space left on device"});
  link("stdout.obj", "/dev/stdout");
  expect_done(refine("plain.obj"));
  const std::string text = read_file(path("plain.obj"));
  int ends[2];
  ASSERT_EQ(::pipe2(ends, O_CLOEXEC), 0);
  expect_done(refine("stdout.obj", [&] { ::dup2(ends[1], STDOUT_FILENO); }));  // fits into the pipe
  ::close(ends[1]);
  std::string piped(text.size() + 1, '\0');
  piped.resize(size_t(std::max<ssize_t>(::read(ends[0], piped.data(), piped.size()), 0)));
  ::close(ends[0]);
  EXPECT_EQ(piped, text);
}

TEST_F(CliLinks, LeadOutOfDirectoriesThatAreReadOnly) {
  fs::create_directory(directory / "closed");
  link("closed/out.obj", "../there/out.obj");
  link("inwards.obj", "closed/new.obj");
  ::chmod(path("closed").c_str(), 0555);
  const auto obey = [] { ::prctl(PR_CAPBSET_DROP, CAP_DAC_OVERRIDE); };  // permissions hold for root, too
  expect_done(refine("closed/out.obj", obey));
  EXPECT_TRUE(fs::is_regular_file(directory / "there/out.obj"));
  expect_failure(refine("inwards.obj", obey), 3, {"inwards.obj", "it is a link to", "closed is not writable"});
  ::chmod(path("closed").c_str(), 0755);
}

TEST_F(CliLinks, ToDirectoriesAreFilled) {
  link("tables", "there/tables");
  link("of_empty", "empty");
  link("masks", "there/masks");
  const std::string table = path("t.safetensors");
  expect_done(sublimit({"bake", mesh, "-s", "catmull-clark", "-l", "1", "-o", table}));
  for (const auto& [name, end] : {std::pair("tables", "there/tables"), {"of_empty", "empty"}}) {
    expect_done(sublimit({"export", table, "-o", path(name)}));
    EXPECT_TRUE(fs::is_symlink(directory / name));
    EXPECT_TRUE(fs::is_regular_file(directory / end / "metadata.json"));
  }
  EXPECT_EQ(sublimit({"analyze", "-s", "loop", "--valence", "4", "--export", path("masks"), "--quiet"}).status, 0);
  EXPECT_TRUE(fs::is_symlink(directory / "masks"));
  EXPECT_FALSE(fs::is_empty(directory / "there/masks"));
}

}  // namespace
}  // namespace sublimit::testing
