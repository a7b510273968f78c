// SPDX-License-Identifier: Apache-2.0
// `sublimit verify`: what it says of sound tables, of broken ones, and of what it cannot read.
#include <gtest/gtest.h>

#include "stencils/cli_tables.h"

namespace sublimit::testing {
namespace {

TEST(CliVerify, TellsWhatWasChecked) {
  const Tables on(creased_cube());
  for (const std::vector<std::string>& arguments : {std::vector<std::string>{"-l", "2"},
                                                    {"--grid", "3", "--derivatives", "2", "--precision", "double"},
                                                    {"-l", "1", "--limit", "--derivatives", "1"}}) {
    expect_done(on.bake(arguments));
    expect_parts(expect_done(sublimit({"verify", on.table})).out,
                 {"table.safetensors: sound", "layout", "row sums", "checksums", "catmull-clark", "creasing uniform",
                  arguments.back() == "double" ? "double" : "float", "points from 8", "blocks"});
    EXPECT_EQ(expect_done(sublimit({"verify", on.table, "--quiet"})).out, "");
  }
}

/// Some bytes of a table may be any: padding of the header. A change of any other is found.
TEST(CliVerify, FindsChangedBytes) {
  const Tables on(jittered(cube()));
  expect_done(on.bake({"-l", "2"}));
  const std::string sound = read_file(on.table);
  const size_t data = sound.find_first_of('}') + 1;
  for (size_t at = sound.size() - 1; at > data; at -= sound.size() / 13) {
    std::string changed = sound;
    changed[at] = static_cast<char>(changed[at] ^ 0x10);
    on.directory.write("table.safetensors", changed);
    const Outcome outcome = sublimit({"verify", on.table});
    EXPECT_EQ(outcome.status, 1) << at;
    EXPECT_EQ(outcome.err, "");
    expect_parts(outcome.out, {"table.safetensors: "});
    EXPECT_EQ(count_of(outcome.out, "sound"), 0u);
  }
}

TEST(CliVerify, RefusesWhatIsNoTable) {
  const Tables on(cube());
  for (const std::string text : {"", "x", "not a table, but a text", "\1\0\0\0\0\0\0\0{"}) {
    on.directory.write("table.safetensors", text);
    const Outcome outcome = sublimit({"verify", on.table});
    EXPECT_EQ(outcome.status, 1);
    expect_parts(outcome.out, {"table.safetensors"});
  }
  expect_failure(sublimit({"verify", on.path("none")}), 3, {"none", "No such file"});
  expect_failure(sublimit({"verify", on.directory.path().string()}), 3, {"directory"});
  expect_failure(sublimit({"verify"}), 2, {"TABLE"});
}

}  // namespace
}  // namespace sublimit::testing
