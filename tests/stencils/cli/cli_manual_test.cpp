// SPDX-License-Identifier: Apache-2.0
// The manual that the program writes of itself: pages for `man` and for the site, completions for three shells.
#include <gtest/gtest.h>

#include <cstdlib>
#include <map>
#include <regex>
#include <sstream>

#include "stencils/subcommands.h"
#include "support/skip.h"

namespace sublimit::testing {
namespace {

using Path = std::filesystem::path;

bool is_installed(const std::string& program) {
  return std::system(("command -v " + program + " > /dev/null 2>&1").c_str()) == 0;
}

/// What a shell prints.
std::string said(const std::string& command, const Path& folder) {
  const std::string out = (folder / "said").string();
  EXPECT_EQ(std::system((command + " > '" + out + "' 2>&1").c_str()), 0) << command << "\n" << read_file(out);
  return read_file(out);
}

std::set<std::string> names_in(const Path& folder) {
  std::set<std::string> names;
  for (const auto& file : std::filesystem::directory_iterator(folder)) names.insert(file.path().filename().string());
  return names;
}

TEST(CliManual, HasAPageForEverySubcommand) {
  const TemporaryDirectory directory;
  for (const char* kind : {"man", "markdown"}) {
    const std::string extension = kind == std::string("man") ? ".1" : ".md";
    std::set<std::string> expected{"sublimit" + extension};
    for (const std::string& verb : subcommands()) expected.insert("sublimit-" + verb + extension);
    expect_done(sublimit({"--generate", kind, (directory / kind).string()}));
    EXPECT_EQ(names_in(directory / kind), expected);
  }
  // Each of them has the options, statuses and examples of --help.
  const std::string help = expect_done(sublimit({"sample", "--help"})).out;
  const std::string page = read_file(directory / "markdown/sublimit-sample.md");
  for (const char* part : {"--derivatives", "--mem-limit", "a fault of ours", "sublimit sample cage.obj -s loop"}) {
    EXPECT_NE(help.find(part), std::string::npos) << part;
    EXPECT_NE(page.find(part), std::string::npos) << part;
  }
}

TEST(CliManual, HelpHasThreeExamplesGroupsStatusesAndFiles) {
  for (const std::string& verb : subcommands()) {
    SCOPED_TRACE(verb);
    const std::string help = expect_done(sublimit({verb, "--help"})).out;
    const size_t sentence = help.find('\n');
    EXPECT_EQ(help[sentence - 1], '.') << help.substr(0, sentence);
    expect_parts(help, {"\nUsage: sublimit " + verb, "\nExamples:\n", "\nRunning:\n", "\nExit status:\n  0   done\n"});
    const std::string examples = help.substr(help.find("\nExamples:\n"));
    EXPECT_GE(count_of(examples.substr(0, examples.find("\n\n")), "\n  sublimit "), 3u);
    std::istringstream lines(help);
    for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 132u) << line;
  }
  expect_parts(expect_done(sublimit({"refine", "--help"})).out,
               {"\nOutput:\n", "\nScheme and rules:\n", "\nFiles:\n", "MESH.json"});
  expect_parts(expect_done(sublimit({"verify", "--help"})).out, {"  1   a check fails\n"});
}

TEST(CliManual, ManFindsNoFault) {
  SUBLIMIT_NEEDS_PROGRAM(is_installed("mandoc"), "mandoc");
  const TemporaryDirectory directory;
  expect_done(sublimit({"--generate", "man", (directory / "man").string()}));
  // Without a date, since the same program has the same pages on any day.
  const std::string faults =
      said("mandoc -T lint -W warning '" + (directory / "man").string() + "'/*.1 | grep -v 'missing date' || true",
           directory.path());
  EXPECT_EQ(faults, "");
  const std::string shown =
      said("mandoc -T ascii '" + (directory / "man/sublimit-refine.1").string() + "' | col -b", directory.path());
  expect_parts(shown, {"sublimit-refine - refine a mesh or curves", "-l, --levels LEVELS", "EXIT STATUS"});
}

TEST(CliManual, BashCompletesVerbsOptionsSchemesAndFiles) {
  const TemporaryDirectory directory;
  expect_done(sublimit({"--generate", "bash", directory.path().string()}));
  const Path work = directory / "work";
  std::filesystem::create_directories(work / "dir");
  for (const char* name : {"cage.obj", "notes.txt", "t.safetensors", "r.json", "two words.ply"})
    std::ofstream(work / name) << "x";
  const std::map<std::string, std::string> expected{
      {"re", "refine"},
      {"refine --le", "--levels"},
      {"refine -s catmull", "catmull-clark|catmull-clark-intervals"},
      {"refine ''", "cage.obj|dir|r.json|two words.ply"},
      {"refine cage.obj ''", ""},
      {"refine cage.obj --boundary ''", "edge-and-corner|edge-only|fixed|none"},
      {"refine cage.obj --boundary=edge-o", "edge-only"},
      {"refine --option quads = ''", "catmull-clark|edges"},
      {"refine -s loop --quiet c", "cage.obj"},
      {"apply ''", "dir|t.safetensors"},
      {"apply t.safetensors c", "cage.obj"},
      {"help cl", "closest"},
      {"analyze -s al", "all"},
      {"--generate z", "zsh"},
      {"--generate zsh ''", "dir"},
      {"construct r", "r.json"},
      {"schemes --gallery ''", "dir"},
  };
  std::string script =
      "set -u\nCOMP_WORDBREAKS=$' \\t\\n\"=:'\nsource '" + (directory / "sublimit").string() + "'\ncd '" +
      work.string() +
      "'\n"
      "try() { COMP_WORDS=(sublimit \"$@\"); COMP_CWORD=$#; COMPREPLY=(); _sublimit;"
      " if ((${#COMPREPLY[@]})); then printf '%s\\n' \"${COMPREPLY[@]}\" | LC_ALL=C sort | paste -sd'|';"
      " else echo; fi; }\n";
  std::string all;
  for (const auto& [line, words] : expected) {
    script += "try " + line + "\n";
    all += words + "\n";
  }
  std::ofstream(directory / "try.bash") << script;
  EXPECT_EQ(said("bash '" + (directory / "try.bash").string() + "'", directory.path()), all);
}

TEST(CliManual, ZshAndFishTakeTheirCompletions) {
  const TemporaryDirectory directory;
  for (const char* kind : {"zsh", "fish"}) expect_done(sublimit({"--generate", kind, directory.path().string()}));
  EXPECT_EQ(names_in(directory.path()), (std::set<std::string>{"_sublimit", "sublimit.fish"}));
  SUBLIMIT_NEEDS_PROGRAM(is_installed("zsh") && is_installed("fish"), "zsh, fish");
  EXPECT_EQ(said("zsh -n '" + (directory / "_sublimit").string() + "'", directory.path()), "");
  const std::string fish = (directory / "sublimit.fish").string();
  const auto completed = [&](const std::string& line) {
    return said("HOME='" + directory.path().string() + "' fish --no-config -c \"source '" + fish + "'; complete -C '" +
                    line + "'\"",
                directory.path());
  };
  EXPECT_EQ(completed("sublimit ref"), "refine\tRefine a mesh or curves\n");
  expect_parts(completed("sublimit refine -s catmull"), {"catmull-clark\t", "catmull-clark-intervals\t"});
  expect_parts(completed("sublimit refine --bound"), {"--boundary\t"});
}

TEST(CliManual, RefusesWhatItCannotWriteAndLeavesNothing) {
  const TemporaryDirectory directory;
  const std::string folder = (directory / "out").string();
  expect_failure(sublimit({"--generate", "mna", folder}), 2, {"did you mean man?", "markdown"});
  expect_failure(sublimit({"--generate", "man"}), 2, {"--generate takes a kind of manual and a directory"});
  expect_failure(sublimit({"--generate", "man", folder, "more"}), 2, {"a kind of manual and a directory"});
  EXPECT_FALSE(std::filesystem::exists(folder));
  std::ofstream(directory / "file") << "x";
  expect_failure(sublimit({"--generate", "man", (directory / "file").string()}), 3, {"cannot make the directory"});
  // One page that is in the way, and none is written.
  std::filesystem::create_directories(directory / "out/sublimit-verify.1");
  expect_failure(sublimit({"--generate", "man", folder}), 3, {"sublimit-verify.1", "directory"});
  EXPECT_EQ(names_in(folder), (std::set<std::string>{"sublimit-verify.1"}));
}

}  // namespace
}  // namespace sublimit::testing
