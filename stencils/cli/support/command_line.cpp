// SPDX-License-Identifier: Apache-2.0
#include "support/command_line.h"

#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <string_view>
#include <vector>

#include "sublimit/core/detail/nearest_names.h"

namespace sublimit::cli {
namespace {

using Words = std::vector<std::string>;

/// "A", "A or B", "A, B or C".
std::string any_of_words(const Words& words) {
  std::string text;
  for (size_t i = 0; i < words.size(); ++i) text += (i == 0 ? "" : i + 1 == words.size() ? " or " : ", ") + words[i];
  return text;
}

/// Without dashes, and without the value that may follow.
std::string bare_name(const std::string& option) {
  const size_t begin = std::min(option.find_first_not_of('-'), option.size());
  return option.substr(begin, option.find('=') - begin);
}

bool is_option(const std::string& word) {
  return word.size() > 1 && word[0] == '-' && std::isdigit(static_cast<unsigned char>(word[1])) == 0 && word[1] != '.';
}

Words subcommand_names(const CLI::App& app) {
  Words names;
  for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
  return names;
}

ParsedCommandLine refused(const CLI::App& app, const std::string& verb, const std::string& what) {
  const std::string program = app.get_name();
  const std::string help = program + " help" + (verb.empty() ? "" : " " + verb);
  return {false, 2, "",
          fmt::format("{}{}{}: {}{} `{}` {}\n", program, verb.empty() ? "" : " ", verb, what,
                      what.ends_with('?') ? "" : ";", help,
                      verb.empty() ? "lists the subcommands" : "shows options and examples")};
}

/// What to say about a word that should be a subcommand.
ParsedCommandLine unknown_subcommand(const CLI::App& app, const std::string& word) {
  std::string what = fmt::format("there is no subcommand '{}'", word);
  const Words meant = nearest_names(word, subcommand_names(app));
  if (!meant.empty()) what += "; did you mean " + any_of_words(meant) + "?";
  return refused(app, "", what);
}

/// What to say about an option that a subcommand does not have.
ParsedCommandLine unknown_option(const CLI::App& app, const CLI::App& command, const std::string& word) {
  Words names;
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back(name);
  }
  Words meant = nearest_names(bare_name(word), names);
  for (std::string& name : meant) name = "--" + name;
  std::string what = fmt::format("there is no option {}", word.substr(0, word.find('=')));
  if (!meant.empty()) what += "; did you mean " + any_of_words(meant) + "?";
  return refused(app, command.get_name(), what);
}

ParsedCommandLine superfluous_argument(const CLI::App& app, const CLI::App& command, const std::string& word) {
  std::string takes;
  for (const CLI::Option* option : command.get_options())
    if (option->get_positional()) takes += (takes.empty() ? "" : " ") + option->get_name(true);
  return refused(
      app, command.get_name(),
      fmt::format("'{}' is one argument too many; it takes {}", word, takes.empty() ? "options only" : takes));
}

/// What is wrong with the values of options, or nothing: "" where a script's variable is not set, `-s -l 2`.
std::string wrong_value(const CLI::App& command) {
  for (const CLI::Option* option : command.get_options()) {
    const bool is_flag = option->get_items_expected_max() == 0;
    for (const std::string& value : is_flag ? Words{} : option->results()) {
      if (value.empty()) return option->get_name() + " is given an empty word";
      for (const CLI::Option* other : command.get_options())
        if (is_option(value) && other->check_name(value))
          return fmt::format("{} needs a value, and {} follows it", option->get_name(), value);
    }
  }
  return {};
}

/// The library's words as ours, where these are not clear.
std::string plain_words(const CLI::ParseError& error) {
  const std::string text = error.what();
  const auto behind = [&](std::string_view mark) {
    const size_t at = text.find(mark);
    return at == std::string::npos ? std::string() : text.substr(at + mark.size());
  };
  if (const std::string given = behind("Could not convert: "); !given.empty()) {
    const size_t equals = std::min(given.find(" = "), given.size());
    const std::string value = given.substr(std::min(equals + 3, given.size()));
    const bool digits = !value.empty() && value.find_first_not_of("+-0123456789") == std::string::npos;
    return fmt::format("{} {}: {}", given.substr(0, equals), value,
                       digits ? "it is too large" : "it should be a number, a whole one for levels and counts");
  }
  if (const std::string count = behind(": At Most 1 required but received "); !count.empty())
    return fmt::format("{} is given {} times", text.substr(0, text.find(':')), count);
  return text;
}

/// Whether the word before a subcommand is one of the program's own options.
bool is_own_option(const CLI::App& app, const std::string& word) {
  return std::ranges::any_of(app.get_options(), [&](const CLI::Option* option) { return option->check_name(word); });
}

}  // namespace

ParsedCommandLine parse_command_line(CLI::App& app, int argc, const char* const* argv) {
  std::string asked;
  CLI::App* help = app.add_subcommand("help", "Show what a subcommand does, its options and examples");
  help->add_option("SUBCOMMAND", asked, "Its name; without one, all subcommands are listed");
  help->footer(fmt::format("Examples:\n  {0} help\n  {0} help info\n  {0} info --help", app.get_name()));

  const Words names = subcommand_names(app);
  const auto is_subcommand = [&](const std::string& word) { return std::ranges::find(names, word) != names.end(); };
  const Words words(argv + 1, argv + argc);
  if (!words.empty() && words.front() == "--generate" && app.get_option_no_throw("--generate")) {
    if (words.size() != 3) return refused(app, "", "--generate takes a kind of manual and a directory");
    return {true, 0, "", "", words[1], words[2]};
  }
  const auto first = std::ranges::find_if_not(words, [&](const std::string& w) { return is_own_option(app, w); });
  if (first != words.end() && !is_subcommand(*first)) {
    if (!is_option(*first)) return unknown_subcommand(app, *first);
    const auto verb = std::find_if(first, words.end(), is_subcommand);
    return verb == words.end() ? refused(app, "", fmt::format("there is no option {} before a subcommand", *first))
                               : refused(app, *verb, fmt::format("write {} behind the subcommand", *first));
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForVersion& version) {
    return {false, 0, std::string(version.what()) + "\n", ""};
  } catch (const CLI::Success&) {
    return {false, 0, app.help(), ""};
  } catch (const CLI::ParseError& error) {
    const std::vector<CLI::App*> chosen = app.get_subcommands();
    if (chosen.empty()) return refused(app, "", "a subcommand is required");
    const CLI::App& command = *chosen.front();
    for (const std::string& word : command.remaining())
      if (is_option(word)) return unknown_option(app, command, word);
    if (const std::string wrong = wrong_value(command); !wrong.empty()) return refused(app, command.get_name(), wrong);
    for (const std::string& word : command.remaining())
      if (word != "--") return superfluous_argument(app, command, word);
    return refused(app, command.get_name(), plain_words(error));
  }
  if (!help->parsed()) {
    const CLI::App& command = *app.get_subcommands().front();
    const std::string wrong = wrong_value(command);
    return wrong.empty() ? ParsedCommandLine{} : refused(app, command.get_name(), wrong);
  }
  if (asked.empty()) return {false, 0, app.get_formatter()->make_help(&app, app.get_name(), {}), ""};
  if (!is_subcommand(asked)) return unknown_subcommand(app, asked);
  return {false, 0, app.get_subcommand(asked)->help(app.get_name()), ""};
}

}  // namespace sublimit::cli
