// SPDX-License-Identifier: Apache-2.0
#pragma once
// The manual: one description of the subcommands, read from CLI11's options, from which `--help`, manual pages,
// completions for shells and reference pages are made. They have no text of their own, so they cannot disagree.
#include <CLI/CLI.hpp>

#include <string>
#include <utility>
#include <vector>

#include "sublimit/core/scheme_options.h"

namespace sublimit::cli {

/// Kind of the value of an option or argument.
enum class ValueKind { none, text, words, scheme, scheme_option, in_file, out_file, directory, verb };

struct OptionPage {
  std::vector<std::string> names;  ///< "-l", "--levels"; an argument has one name
  ValueKind kind = ValueKind::text;
  std::string value;                    ///< "LEVELS", "float|double"; empty for a flag
  std::string text;                     ///< description
  std::vector<std::string> words;       ///< values to choose from
  std::vector<std::string> extensions;  ///< extensions of files that it reads, "obj"; empty: any
  bool argument = false, required = false, repeats = false;
};

struct OptionGroup {
  std::string title;
  std::vector<OptionPage> options;
};

struct Example {
  std::string line, remark;
};

/// A paragraph of sentences, or lines that are kept as they are.
struct Note {
  bool as_it_is = false;
  std::string text;
};

struct VerbPage {
  std::string name, sentence;  ///< "refine", "Refine a mesh or curves"
  std::string usage;           ///< "sublimit refine [OPTIONS] MESH"
  std::vector<Example> examples;
  std::vector<OptionPage> arguments;
  std::vector<OptionGroup> groups;
  std::vector<Note> notes;
  std::vector<std::pair<int, std::string>> exits;          ///< status, meaning
  std::vector<std::pair<std::string, std::string>> files;  ///< "MESH", "a control mesh, .obj, ..., is read"
};

struct ProgramPage {
  std::string name, version;
  VerbPage program;             ///< the program itself: its sentence, options, examples
  std::vector<VerbPage> verbs;  ///< in the order of `sublimit --help`
};

/// Returns the names of all schemes for surfaces and curves with their options: the values of `-s` and
/// `--option`.
std::vector<std::pair<std::string, std::vector<OptionInfo>>> scheme_words();

/// Returns words in one line.
std::string joined(const std::vector<std::string>& parts, const char* between = " ");

/// Returns the page of a subcommand, or of the program itself.
VerbPage verb_page(const CLI::App& command);
ProgramPage program_page(const CLI::App& app);

/// Returns true if an option names a file to write.
bool writes_file(const CLI::Option& option);
/// Returns true if an option or argument names a directory.
bool takes_directory(const CLI::Option& option);

/// Formats `--help` from these pages.
class HelpFormatter : public CLI::Formatter {
 public:
  std::string make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const override;
};

/// Returns the kinds of `--generate`: man, bash, zsh, fish, markdown.
const std::vector<std::string>& manual_kinds();

/// Returns the files of a kind as names ("sublimit-refine.1", "_sublimit") and texts.
std::vector<std::pair<std::string, std::string>> manual_files(const ProgramPage& page, const std::string& kind);

/// Writes the files of a kind into a directory, which is made if it does not exist: all files, or none.
/// @throws InvalidOption  no such kind, with the nearest names
/// @throws IoError        the directory cannot be made, a file cannot be written
void write_manual(const ProgramPage& page, const std::string& kind, const std::string& directory);

}  // namespace sublimit::cli
