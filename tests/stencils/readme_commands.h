// SPDX-License-Identifier: Apache-2.0
#pragma once
// Command lines in the project's documents, extracted from Markdown.
#include <algorithm>
#include <filesystem>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "sublimit/base/detail/read_file.h"

namespace sublimit::testing {

/// Lines of a document that are indented by four spaces, or between fences.
struct CodeBlock {
  std::string document, section;
  std::string language;  ///< language of a fence; empty for indented blocks
  std::vector<std::string> lines;
};

/// A sentence, list or table of a document, as text.
struct Paragraph {
  std::string section, text;
};

struct Page {
  std::vector<CodeBlock> blocks;
  std::vector<Paragraph> paragraphs;
};

/// Reads the code blocks and paragraphs of a document.
/// @param name  path of the document from the root of the project
inline Page read_page(const std::string& name, const std::string& text) {
  Page page;
  std::string section;
  enum { prose, indented, fenced } state = prose;
  bool after_blank = true;  // indented lines that go on with a list are no code
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    const bool fence = line.starts_with("```");
    if (state == fenced) {
      if (fence)
        state = prose;
      else
        page.blocks.back().lines.push_back(line);
      continue;
    }
    if (fence) {
      state = fenced;
      page.blocks.push_back({name, section, line.substr(3), {}});
    } else if (line.starts_with("    ") && (state == indented || after_blank)) {
      if (state != indented) page.blocks.push_back({name, section, "", {}});
      state = indented;
      page.blocks.back().lines.push_back(line.substr(4));
    } else {
      state = prose;
      if (line.starts_with("#")) section = line.substr(line.find(' ') + 1);
      if (after_blank || page.paragraphs.empty()) page.paragraphs.push_back({section, ""});
      page.paragraphs.back().text += line + "\n";
    }
    after_blank = line.empty();
  }
  return page;
}

/// Returns the paths of all Markdown files of the project, from its root.
inline std::vector<std::string> documents() {
  const std::filesystem::path root = SUBLIMIT_SOURCE;
  std::vector<std::string> names;
  for (std::filesystem::recursive_directory_iterator at(root), end; at != end; ++at) {
    const std::string name = at->path().filename().string();
    if (at->is_directory() && (name == "build" || name == "node_modules" || name.starts_with(".")))
      at.disable_recursion_pending();
    if (at->path().extension() == ".md") names.push_back(at->path().lexically_relative(root).string());
  }
  std::ranges::sort(names);
  return names;
}

inline const std::vector<std::pair<std::string, Page>>& pages() {
  static const std::vector<std::pair<std::string, Page>> all = [] {
    std::vector<std::pair<std::string, Page>> read;
    for (const std::string& name : documents())
      read.emplace_back(name, read_page(name, read_file(SUBLIMIT_SOURCE "/" + name)));
    return read;
  }();
  return all;
}

struct CommandLine {
  std::string document, section;
  std::string text;  ///< as written: a line with its continuations, or a whole script

  /// Returns the text as one line.
  std::string line() const {
    std::string one = text;
    std::ranges::replace(one, '\n', ' ');
    return one;
  }
};

inline bool begins_with_program(const std::string& text) {
  static const std::regex program(
      R"((\$ )?(\w+=\S* )*((\S*/)?(sublimit\S*|parallel|cmake|ctest|ninja|make|python3?|pip3?|mpirun|bash|sh|sudo)|)"
      R"(apt|apt-get|git|cd|mkdir|docker|curl|wget|for \w+ in|\.ci/\S+|build/\S+/bin/\S+)(\s[\s\S]*|$))");
  return std::regex_match(text, program);
}

/// Returns the texts between backticks, with line breaks as spaces.
inline std::vector<std::string> code_spans(const std::string& paragraph) {
  std::vector<std::string> spans;
  for (size_t at = 0; (at = paragraph.find('`', at)) != std::string::npos;) {
    const size_t end = paragraph.find('`', at + 1);
    if (end == std::string::npos) break;
    std::string span = paragraph.substr(at + 1, end - at - 1);
    std::ranges::replace(span, '\n', ' ');
    spans.push_back(span);
    at = end + 1;
  }
  return spans;
}

/// Returns the command lines of a block: lines that begin with a program's name, with their continuations, or
/// the block as one if it is a script.
inline std::vector<CommandLine> commands_of(const CodeBlock& block) {
  std::vector<CommandLine> commands;
  if (!block.language.empty() && block.language != "bash" && block.language != "sh" && block.language != "console")
    return commands;
  const bool script = block.lines.front().starts_with("#!");
  bool goes_on = false;
  for (const std::string& line : block.lines) {
    // Synopses go on in lines that are indented.
    if (!commands.empty() && (script || goes_on || line.starts_with(" ")))
      commands.back().text += "\n" + line;
    else if (script || begins_with_program(line))
      commands.push_back({block.document, block.section, line});
    else
      continue;
    goes_on = line.ends_with("\\");
  }
  return commands;
}

/// Returns every command line of every document, in order, except that those in sentences are last. In
/// sentences, only a program's name, or only a subcommand after it, is not a command line.
inline std::vector<CommandLine> command_lines() {
  std::vector<CommandLine> commands;
  static const std::regex name_alone(R"(sublimit \S+|[^/ ]\S*|\S*/sublimit)");
  for (const auto& [document, page] : pages()) {
    for (const CodeBlock& block : page.blocks) std::ranges::copy(commands_of(block), std::back_inserter(commands));
    for (const Paragraph& paragraph : page.paragraphs)
      for (const std::string& span : code_spans(paragraph.text))
        if (begins_with_program(span) &&
            (span.starts_with("build/") ? !span.ends_with("/sublimit") : !std::regex_match(span, name_alone)))
          commands.push_back({document, paragraph.section, span});
  }
  return commands;
}

}  // namespace sublimit::testing
