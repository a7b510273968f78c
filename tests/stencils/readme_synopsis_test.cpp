// SPDX-License-Identifier: Apache-2.0
// Verbs and options that documents name are those of the program, and one document has a synopsis of every verb.
#include <gtest/gtest.h>

#include <map>
#include <set>

#include "stencils/cli_program.h"
#include "stencils/readme_commands.h"
#include "stencils/subcommands.h"

namespace sublimit::testing {
namespace {

std::set<std::string> matches(const std::string& text, const std::regex& pattern) {
  std::set<std::string> found;
  for (std::sregex_iterator at(text.begin(), text.end(), pattern), end; at != end; ++at) found.insert((*at)[1]);
  return found;
}

/// "-o", "--grid", ... wherever they stand in a text.
std::set<std::string> options_in(const std::string& text) {
  static const std::regex option(R"((?:^|[\s\[(|,])(--?[a-z][a-z0-9-]*))");
  return matches(text, option);
}

/// Verbs of the program by its own help, and what options each has.
const std::map<std::string, std::set<std::string>>& verbs() {
  static const std::map<std::string, std::set<std::string>> all = [] {
    std::map<std::string, std::set<std::string>> found;
    for (const std::string& name : subcommands()) found[name] = options_in(expect_done(sublimit({name, "--help"})).out);
    return found;
  }();
  return all;
}

TEST(ReadmeSynopsis, NamesVerbsAndOptionsOfTheProgram) {
  for (const CommandLine& command : command_lines()) {
    std::smatch parts;
    if (!std::regex_match(command.text, parts, std::regex(R"(sublimit +(\S+)([\s\S]*))"))) continue;
    SCOPED_TRACE(command.text);
    if (parts[1].str().starts_with("-")) {  // an option of the program itself
      EXPECT_TRUE(options_in(expect_done(sublimit({"--help"})).out).contains(parts[1])) << parts[1];
      continue;
    }
    std::istringstream names(parts[1]);
    for (std::string name; std::getline(names, name, '|');) {
      const auto verb = verbs().find(name);
      ASSERT_NE(verb, verbs().end()) << name;
      const std::string rest = parts[2];
      for (const std::string& option : options_in(rest.substr(0, rest.find(" && "))))
        EXPECT_TRUE(verb->second.contains(option)) << name << " has no " << option;
    }
  }
}

TEST(ReadmeSynopsis, HasEveryVerb) {
  std::set<std::string> described;
  for (const CommandLine& command : command_lines())
    if (command.document == "stencils/docs/program.md" && command.section == "The program")
      described.merge(matches(command.text, std::regex(R"((?:^sublimit +|\|)([a-z]+))")));
  EXPECT_GE(verbs().size(), 12u);
  for (const auto& [name, options] : verbs()) {
    EXPECT_TRUE(described.contains(name)) << "stencils/docs/program.md does not describe " << name;
    EXPECT_TRUE(options.contains("--help")) << name;
  }
}

TEST(ReadmeSynopsis, OptionsInSentencesAreOfSomeVerb) {
  // Of the program itself; of the benchmarks and of what runs them.
  std::set<std::string> options =
      matches(read_file(SUBLIMIT_SOURCE "/bench/run_all"), std::regex(R"re("(--[a-z-]+)")re"));
  options.insert("--version");
  for (const auto& file : std::filesystem::directory_iterator(SUBLIMIT_SOURCE "/stencils/cli_mpi"))
    options.merge(matches(read_file(file.path()), std::regex(R"re((--[a-z-]+))re")));  // it may not be built here
  for (const auto& [name, own] : verbs()) options.insert(own.begin(), own.end());
  int seen = 0;
  for (const auto& [document, page] : pages())
    for (const Paragraph& paragraph : page.paragraphs)
      for (const std::string& span : code_spans(paragraph.text))
        if (document != "CHANGELOG.md" && span.starts_with("--"))  // which also tells what once was
          for (const std::string& option : options_in(span)) {
            ++seen;
            EXPECT_TRUE(options.contains(option))
                << document << ", " << paragraph.section << ": no verb has " << option;
          }
  EXPECT_GE(seen, 30);
}

}  // namespace
}  // namespace sublimit::testing
