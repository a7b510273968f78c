// SPDX-License-Identifier: Apache-2.0
// Help, and command lines that are nearly right: a line that says what is wrong and offers what was meant.
#include <gtest/gtest.h>

#include <utility>

#include "meshes/meshes.h"
#include "stencils/subcommands.h"
#include "sublimit/io/detail/obj.h"

namespace sublimit::testing {
namespace {

using Words = std::vector<std::string>;

/// The second letter and the third in each other's place.
std::string mistyped(std::string name) {
  std::swap(name.at(1), name.at(2));
  return name;
}

/// Expects status 2 and a line with every part.
void expect_misuse(const Words& words, std::initializer_list<std::string_view> parts) {
  const Outcome outcome = sublimit(words);
  expect_failure(outcome, 2, parts);
  EXPECT_TRUE(outcome.err.starts_with("sublimit")) << outcome.err;
  EXPECT_EQ(count_of(outcome.err, "\n"), 1u) << outcome.err;
}

TEST(CliHelp, EverySubcommandHasExamples) {
  const std::set<std::string> all_names = subcommands();
  EXPECT_GE(all_names.size(), 12u);
  size_t turn = 0;  // a form of asking for each
  for (const std::string& name : all_names) {
    const std::string text = expect_done(sublimit({name, "--help"})).out;
    expect_parts(text, {"Examples:", "Usage: sublimit " + name, "  sublimit " + name});
    const Words others[] = {{name, "-h"}, {"help", name}, {"--help", name}, {"-h", name}};
    const Words& other = others[turn++ % std::size(others)];
    EXPECT_EQ(expect_done(sublimit(other)).out, text) << other[0] << " " << other[1];
  }
  const std::string all = expect_done(sublimit({"--help"})).out;
  expect_parts(all, {"Examples:", "Exit status"});
  EXPECT_EQ(expect_done(sublimit({"help"})).out, all);
  EXPECT_TRUE(expect_done(sublimit({"--version"})).out.starts_with("sublimit 0."));
}

TEST(CliHelp, OffersTheSubcommandThatWasMeant) {
  size_t turn = 0;  // a line for each
  for (const std::string& name : subcommands()) {
    const std::string wrong = mistyped(name), meant = "did you mean ";
    if (wrong == name) continue;  // "apply"
    const Words lines[] = {{wrong}, {wrong, "mesh.obj", "-o", "out.obj"}, {"help", wrong}};
    expect_misuse(lines[turn++ % std::size(lines)],
                  {"there is no subcommand '" + wrong + "'", meant, name, "`sublimit help`"});
  }
  expect_misuse({"refnie"}, {"did you mean refine?"});
  for (const char* far : {"polish", "mesh.obj", "7"}) {
    expect_misuse({far}, {"there is no subcommand '" + std::string(far) + "'; `sublimit help`"});
  }
  expect_misuse({}, {"a subcommand is required"});
}

TEST(CliHelp, OffersTheOptionThatWasMeant) {
  expect_misuse({"refine", "mesh.obj", "-s", "loop", "--levles", "2", "-o", "out.obj"},
                {"sublimit refine: there is no option --levles; did you mean --levels?", "`sublimit help refine`"});
  expect_misuse({"refine", "--levles=2"}, {"no option --levles;", "--levels?"});
  expect_misuse({"info", "mesh.obj", "-j"}, {"there is no option -j; did you mean --json?"});
  expect_misuse({"demo", "--qiuet"}, {"did you mean --quiet?"});
  expect_misuse({"apply", "a.safetensors", "b.obj", "c.obj", "-o", "out.obj"},
                {"'c.obj' is one argument too many; it takes TABLE POINTS"});
  expect_misuse({"schemes", "loop"}, {"'loop' is one argument too many; it takes options only"});
  for (const std::string& name : subcommands())
    expect_misuse({name, "--hepl"}, {"sublimit " + name + ": there is no option --hepl; did you mean --help"});
}

TEST(CliHelp, SaysWhatIsMissingAndWhereOptionsGo) {
  expect_misuse({"refine"}, {"sublimit refine: ", "is required; `sublimit help refine` shows"});
  expect_misuse({"verify"}, {"sublimit verify: TABLE is required"});
  expect_misuse({"-s", "loop", "refine", "mesh.obj"}, {"sublimit refine: write -s behind the subcommand"});
  expect_misuse({"--quiet", "demo"}, {"write --quiet behind the subcommand"});
  expect_misuse({"--quiet"}, {"there is no option --quiet before a subcommand"});
}

TEST(CliHelp, SaysWhichValueIsWrong) {
  expect_misuse({"refine", "", "-s", "loop", "-l", "1", "-o", "out.obj"}, {"MESH is given an empty word"});
  expect_misuse({"info", "mesh.obj", "-s", ""}, {"sublimit info: --scheme is given an empty word"});
  expect_misuse({"refine", "mesh.obj", "-s", "-l", "1", "-o", "out.obj"},
                {"--scheme needs a value, and -l follows it"});
  expect_misuse({"refine", "mesh.obj", "-s", "loop", "-l", "1", "-l", "2", "-o", "a.obj"},
                {"--levels is given 2 times"});
  expect_misuse({"refine", "mesh.obj", "-l", "two"}, {"--levels two: it should be a number"});
}

TEST(CliHelp, OptionsStandBeforeAndBehindArguments) {
  const TemporaryDirectory directory;
  write_obj(directory / "mesh.obj", cube());
  const std::string mesh = (directory / "mesh.obj").string(), out = (directory / "out.obj").string();
  expect_done(sublimit({"refine", mesh, "-s", "loop", "--triangulate", "-l", "1", "-o", out}));
  const std::string expected = read_file(out);
  for (const Words& words : {Words{"refine", "-s", "loop", "--triangulate", "-l", "1", "-o", out, mesh},
                             {"refine", "--levels=1", "--triangulate", mesh, "--scheme=loop", "--output", out},
                             {"refine", "-sloop", "-l1", "-o" + out, "--triangulate", "--", mesh}}) {
    std::filesystem::remove(out);
    expect_done(sublimit(words));
    EXPECT_EQ(read_file(out), expected);
  }
}

// Numbers in files have points whatever the user's language has.
TEST(CliHelp, LanguagesOfTheUserChangeNothing) {
  const TemporaryDirectory directory;
  write_obj(directory / "mesh.obj", cube());
  const std::string mesh = (directory / "mesh.obj").string(), out = (directory / "out.csv").string();
  const Words words{"sample", mesh, "-s", "catmull-clark", "--random", "3", "-o", out};
  expect_done(sublimit(words));
  const std::string expected = read_file(out);
  for (const char* language : {"de_DE.UTF-8", "tr_TR.UTF-8", "ja_JP.eucJP", "nonsense"}) {
    expect_done(sublimit(words, [&] { ::setenv("LC_ALL", language, 1); }));
    EXPECT_EQ(read_file(out), expected) << language;
  }
}

}  // namespace
}  // namespace sublimit::testing
