// SPDX-License-Identifier: Apache-2.0
#include "support/manual.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <list>
#include <regex>
#include <sstream>
#include <string_view>

#include "support/common.h"
#include "support/input_files.h"
#include "sublimit/base/detail/atomic_file.h"
#include "sublimit/base/error.h"
#include "sublimit/core/detail/nearest_names.h"

namespace sublimit::cli {
namespace {

/// What the name of an option says wherever it has a value: its value's name, the group that it stands in, its kind.
/// An empty value: that of the option's type; an empty group: "Options".
struct OptionWords {
  std::string_view name, value, group;
  ValueKind kind;
};
constexpr std::string_view output = "Output", rules = "Scheme and rules", running = "Running";
using enum ValueKind;
constexpr auto option_words = std::to_array<OptionWords>({
    {"output", "OUT", output, out_file},
    {"matrix", "OUT.mtx", output, out_file},
    {"report", "OUT.json", output, out_file},
    {"json", "OUT.json", output, out_file},
    {"picture", "OUT.svg", output, out_file},
    {"places", "OUT.csv", output, out_file},
    {"log", "LOG.jsonl", output, out_file},
    {"export", "DIR", output, directory},
    {"gallery", "DIR", output, directory},
    {"format", "FORMAT", output, text},
    {"no-tags", "", output, none},
    {"unit", "", output, words},
    {"scheme", "SCHEME", rules, scheme},
    {"option", "NAME=VALUE", rules, scheme_option},
    {"boundary", "", rules, words},
    {"creasing", "", rules, words},
    {"triangles", "", rules, words},
    {"face-varying", "", rules, words},
    {"attributes", "", rules, words},
    {"triangulate", "", rules, none},
    {"no-creases", "", rules, none},
    {"orient", "", rules, none},
    {"crease-angle", "DEG", rules, text},
    {"crease-smoothing-groups", "", rules, none},
    {"sidecar", "IN.json", rules, in_file},
    {"strict", "", rules, none},
    {"threads", "N", running, text},
    {"quiet", "", running, none},
    {"mem-limit", "SIZE", running, text},
    {"help", "", running, none},
    {"version", "", running, none},
    {"levels", "LEVELS", "", text},
    {"at", "IN.csv", "", in_file},
    {"grid", "N", "", text},
    {"random", "N", "", text},
    {"seed", "K", "", text},
    {"nearest", "K", "", text},
    {"radius", "R", "", text},
    {"most-parts", "N", "", text},
    {"points", "IN", "", in_file},
    {"frames", "A-B", "", text},
    {"rays", "IN.csv", "", in_file},
    {"rates", "RATES.csv", "", in_file},
    {"targets", "IN.csv", "", in_file},
    {"cloud", "IN", "", in_file},
    {"pin", "LIST|IN.csv", "", in_file},
    {"tessellation", "IN.ply", "", in_file},
    {"manifest", "JOBS.jsonl", "", in_file},
    {"dictionary", "FILE", "", in_file},
    {"chord", "D", "", text},
    {"angle", "DEGREES", "", text},
    {"tolerance", "D", "", text},
    {"join", "g0|g1", "", words},
    {"shard", "I/N", "", text},
    {"valence", "RANGE", "", text},
    {"mask", "WEIGHTS", "", text},
    {"sweep", "NAME=FROM:TO:STEP", "", text},
    {"claim", "NAME=VALUE", "", text},
    {"refine", "N|auto", "", text},
    {"thin-plate", "W", "", text},
    {"membrane", "W", "", text},
    {"generate", "KIND DIR", "", words},
    {"SUBCOMMAND", "SUBCOMMAND", "", verb},
    {"DIR", "DIR", "", directory},
});

const OptionWords* words_of(const CLI::Option& option) {
  const auto names = option.get_positional() ? std::vector{option.get_name(true)} : option.get_lnames();
  const auto found = std::ranges::find_if(
      option_words, [&](const OptionWords& w) { return !names.empty() && names.front() == w.name; });
  return found == option_words.end() ? nullptr : &*found;
}

/// The choices in a type like "TEXT:{a,b,c}"; those of a short range, "INT in [0 - 2]", too.
std::vector<std::string> choices(const std::string& type) {
  std::vector<std::string> found;
  std::smatch match;
  if (std::regex_search(type, match, std::regex(R"(\{([^}]*)\})"))) {
    std::istringstream list(match[1]);
    for (std::string word; std::getline(list, word, ',');) found.push_back(word);
  } else if (std::regex_search(type, match, std::regex(R"(INT in \[(\d) - (\d)\])"))) {
    for (int i = std::stoi(match[1]); i <= std::stoi(match[2]); ++i) found.push_back(std::to_string(i));
  }
  return found;
}

OptionPage option_page(const CLI::App& command, const CLI::Option& option) {
  OptionPage page;
  page.argument = option.get_positional();
  page.required = option.get_required();
  page.repeats = option.get_expected_max() == CLI::detail::expected_max_vector_size ||
                 (option.get_multi_option_policy() == CLI::MultiOptionPolicy::TakeAll && !page.argument);
  page.text = option.get_description();
  if (page.argument) {
    page.names = {option.get_name(true)};
  } else {
    for (const std::string& name : option.get_snames()) page.names.push_back("-" + name);
    for (const std::string& name : option.get_lnames()) page.names.push_back("--" + name);
  }
  if (option.get_items_expected_max() == 0) {
    page.kind = none;
    page.repeats = false;
    return page;
  }
  const std::string type = option.get_type_name();
  page.words = choices(type);
  page.extensions = input_extensions(command, option);
  const OptionWords* known = words_of(option);
  page.kind = known && known->kind != none ? known->kind : page.words.empty() ? text : words;
  if (!page.extensions.empty() && page.kind == text) page.kind = in_file;
  if (page.argument)
    page.value = page.names.front();
  else if (known && !known->value.empty())
    page.value = known->value;
  else if (!page.words.empty())
    page.value = joined(page.words, "|");
  else
    page.value = type.starts_with("FLOAT") ? "X" : type.starts_with("INT") || type.starts_with("UINT") ? "N" : "VALUE";
  if (page.kind == words && page.words.empty()) {  // as of --join, whose value lists them
    std::istringstream list(page.value);
    for (std::string word; std::getline(list, word, '|');) page.words.push_back(word);
  }
  std::smatch range;
  static const std::regex ends(R"(in \[(\d+) - (\d+)\])");
  if (page.words.empty() && std::regex_search(type, range, ends))
    page.text += fmt::format(" ({} to {})", range[1].str(), range[2].str());
  if (!option.get_default_str().empty()) page.text += " (default " + option.get_default_str() + ")";
  for (const CLI::Option* other : option.get_needs()) page.text += "; needs " + other->get_name();
  return page;
}

/// Options by group, those of their own first.
std::vector<OptionGroup> groups_of(const CLI::App& command) {
  std::vector<OptionGroup> groups;
  for (const std::string_view title : {std::string_view("Options"), output, rules, running}) {
    OptionGroup group{std::string(title), {}};
    for (const CLI::Option* option : command.get_options()) {
      if (option->get_positional()) continue;
      const OptionWords* known = words_of(*option);
      const bool flag_with_words = known && known->kind == out_file && option->get_items_expected_max() == 0;
      const std::string_view own = !known || known->group.empty() || flag_with_words ? "Options" : known->group;
      if (own == title) group.options.push_back(option_page(command, *option));
    }
    if (!group.options.empty()) groups.push_back(std::move(group));
  }
  return groups;
}

/// The footer's examples and notes. Examples come first, a line each, with remarks behind at least three blanks;
/// paragraphs stand between empty lines; lines that begin with blanks are kept.
void read_footer(const std::string& footer, VerbPage& page) {
  std::istringstream lines(footer);
  bool in_examples = false, new_paragraph = true;
  for (std::string line; std::getline(lines, line);) {
    if (line == "Examples:") {
      in_examples = true;
      continue;
    }
    const bool indented = line.starts_with("  ");
    in_examples = in_examples && indented;
    if (in_examples) {
      const size_t end = line.find("   ", 2);
      const size_t remark = end == std::string::npos ? line.size() : line.find_first_not_of(' ', end);
      page.examples.push_back({line.substr(2, end == std::string::npos ? end : end - 2), line.substr(remark)});
    } else if (line.empty()) {
      new_paragraph = true;
    } else {
      const std::string text = indented ? line.substr(2) : line;
      if (new_paragraph || page.notes.empty() || page.notes.back().as_it_is != indented)
        page.notes.push_back({indented, text});
      else
        page.notes.back().text += (indented ? "\n" : " ") + text;
      new_paragraph = false;
    }
  }
}

/// Exit statuses of a verb; its own reason for a verdict that is no, if it gives verdicts.
std::vector<std::pair<int, std::string>> exits_of(const std::string& name) {
  struct Verdict {
    std::string_view verb, meaning;
  };
  static constexpr auto verdicts = std::to_array<Verdict>({
      {"info", "the scheme does not take the mesh"},
      {"verify", "a check fails"},
      {"analyze", "a claim of the scheme is disproved, or seams or joints are beyond a --tolerance"},
      {"intersect", "a ray was given up"},
      {"implicit", "the tolerance is not met, or faces are folded; the nearest mesh is written"},
      {"step",
       "the tolerance is not met, or the shape is not valid by OpenCASCADE's check, as of some non-manifold meshes; the "
       "file is written all the same"},
  });
  std::vector<std::pair<int, std::string>> exits{{0, "done"}};
  if (name == "sublimit") exits.emplace_back(1, "the verdict is no: see the subcommands that give one");
  for (const Verdict& verdict : verdicts)
    if (verdict.verb == name) exits.emplace_back(1, std::string(verdict.meaning));
  exits.insert(exits.end(), {{2, "bad command line, unknown scheme or option value: the nearest names are offered"},
                             {3, "unreadable or invalid input, unwritable output: the message names file and place"},
                             {4, "more memory or disk than there is, predicted or met"},
                             {70, "a fault of ours"},
                             {130, "interrupted"}});
  return exits;
}

std::vector<std::pair<std::string, std::string>> files_of(const CLI::App& command, const VerbPage& page) {
  std::vector<std::pair<std::string, std::string>> files;
  std::vector<std::string> written;
  for (const CLI::Option* option : command.get_options()) {
    const std::string takes = input_meaning(command, *option), name = option->get_name(option->get_positional());
    const size_t comma = name.find(',');
    if (!takes.empty()) files.emplace_back(name.substr(comma == std::string::npos ? 0 : comma + 1), "read: " + takes);
    if (name == "MESH" && page.name != "analyze")
      files.emplace_back("MESH.json", "read if it is beside the mesh: tags by USD's names, which override the mesh's");
  }
  for (const OptionGroup& group : page.groups)
    for (const OptionPage& option : group.options)
      if (option.kind == out_file) written.push_back(option.names.back());
  if (!written.empty())
    files.emplace_back(joined(written, ", "), "written: each file appears whole or not at all; a link stays a link");
  return files;
}

/// Words of a text in lines of at most `width` letters, all but the first one indented.
std::string filled(const std::string& text, size_t indent, size_t width) {
  std::istringstream words(text);
  std::string lines;
  size_t column = indent;
  for (std::string word; words >> word;) {
    if (!lines.empty() && column + 1 + word.size() > width) {
      lines += "\n" + std::string(indent, ' ');
      column = indent;
    } else if (!lines.empty()) {
      lines += ' ';
      ++column;
    }
    lines += word;
    column += word.size();
  }
  return lines;
}

constexpr size_t help_width = 112, help_column = 28;

std::string help_row(const std::string& name, const std::string& text) {
  std::string row = "  " + name;
  row +=
      row.size() + 2 > help_column ? "\n" + std::string(help_column, ' ') : std::string(help_column - row.size(), ' ');
  return row + filled(text, help_column, help_width) + "\n";
}

std::string help_row(const OptionPage& option) {
  std::string name = option.argument || !option.names.front().starts_with("--") ? "" : "    ";
  name += joined(option.names, ", ");
  if (!option.argument && !option.value.empty()) name += " " + option.value;
  std::string text = option.text;
  if (option.required && !option.argument) text += " (required)";
  return help_row(name, text);
}

}  // namespace

std::string joined(const std::vector<std::string>& parts, const char* between) {
  std::string text;
  for (const std::string& part : parts) text += (text.empty() ? "" : between) + part;
  return text;
}

bool writes_file(const CLI::Option& option) {
  const OptionWords* const known = words_of(option);
  return known && known->kind == out_file && option.get_items_expected_max() != 0;
}

bool takes_directory(const CLI::Option& option) {
  const OptionWords* const known = words_of(option);
  return (known && known->kind == directory) || option.check_name("--dictionary");
}

VerbPage verb_page(const CLI::App& command) {
  VerbPage page;
  page.name = command.get_name();
  page.sentence = command.get_description();
  page.usage = (command.get_parent() ? command.get_parent()->get_name() + " " : "") + page.name + " [OPTIONS]";
  for (const CLI::Option* option : command.get_options())
    if (option->get_positional()) {
      page.arguments.push_back(option_page(command, *option));
      page.usage += option->get_required() ? " " + option->get_name(true) : " [" + option->get_name(true) + "]";
    }
  if (!command.get_subcommands({}).empty()) page.usage += " SUBCOMMAND ...";
  page.groups = groups_of(command);
  read_footer(command.get_footer(), page);
  page.exits = exits_of(page.name);
  page.files = files_of(command, page);
  return page;
}

ProgramPage program_page(const CLI::App& app) {
  ProgramPage page{app.get_name(), app.version(), verb_page(app), {}};
  for (const CLI::App* command : app.get_subcommands({})) page.verbs.push_back(verb_page(*command));
  return page;
}

std::string HelpFormatter::make_help(const CLI::App* app, std::string, CLI::AppFormatMode) const {
  const VerbPage page = verb_page(*app);
  std::string help = page.sentence + (page.sentence.ends_with('.') ? "" : ".") + "\nUsage: " + page.usage + "\n";
  help += "\nExamples:\n";
  for (const Example& example : page.examples)
    help += "  " + example.line + (example.remark.empty() ? "" : "   # " + example.remark) + "\n";
  if (!page.arguments.empty()) help += "\nArguments:\n";
  for (const OptionPage& argument : page.arguments) help += help_row(argument);
  for (const OptionGroup& group : page.groups) {
    help += "\n" + group.title + ":\n";
    for (const OptionPage& option : group.options) help += help_row(option);
  }
  if (const auto verbs = app->get_subcommands({}); !verbs.empty()) {
    help += "\nSubcommands:\n";
    for (const CLI::App* verb : verbs) help += help_row(verb->get_name(), verb->get_description());
  }
  for (bool first = true; const Note& note : page.notes) {
    if (first || !note.as_it_is) help += "\n";
    first = false;
    std::istringstream lines(note.as_it_is ? note.text : filled(note.text, 0, help_width));
    for (std::string line; std::getline(lines, line);) help += (note.as_it_is ? "  " : "") + line + "\n";
  }
  help += "\nExit status:\n";
  for (const auto& [status, meaning] : page.exits)
    help += fmt::format("  {:<4}{}\n", status, filled(meaning, 6, help_width));
  if (!page.files.empty()) help += "\nFiles:\n";
  for (const auto& [name, meaning] : page.files) help += help_row(name, meaning);
  return help;
}

void write_manual(const ProgramPage& page, const std::string& kind, const std::string& directory) {
  const std::vector<std::string>& kinds = manual_kinds();
  const std::vector<std::string> meant = nearest_names(kind, kinds, 1);
  if (std::ranges::find(kinds, kind) == kinds.end())
    throw InvalidOption(fmt::format("--generate {}: there is no such kind;{} they are {}", kind,
                                    meant.empty() ? "" : " did you mean " + meant.front() + "?", joined(kinds, ", ")));
  const auto texts = manual_files(page, kind);
  make_output_directory(directory);
  std::list<AtomicFile> files;
  for (const auto& [name, text] : texts) {
    check_output_path((std::filesystem::path(directory) / name).string(), {});
    files.emplace_back(std::filesystem::path(directory) / name).write(text);
  }
  for (AtomicFile& file : files) file.commit();
}

}  // namespace sublimit::cli
