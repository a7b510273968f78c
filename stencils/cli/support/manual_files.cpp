// SPDX-License-Identifier: Apache-2.0
// What the pages look like in each format.
#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <set>
#include <string_view>
#include <utility>

#include "support/manual.h"

namespace sublimit::cli {
namespace {

using Files = std::vector<std::pair<std::string, std::string>>;
using Words = std::vector<std::string>;
using enum ValueKind;

std::string with_replaced(std::string text, std::string_view what, std::string_view by) {
  for (size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += by.size())
    text.replace(at, what.size(), by);
  return text;
}

std::string lower_first(std::string text) {
  // "N x N places": a capital that is a name stays.
  if (text.size() > 1 && std::islower(static_cast<unsigned char>(text[1])) != 0)
    text[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(text[0])));
  return text;
}

std::string without_dot(std::string text) {
  if (text.ends_with('.')) text.pop_back();
  return text;
}

/// All options of a page, without their groups.
std::vector<OptionPage> options_of(const VerbPage& page) {
  std::vector<OptionPage> all;
  for (const OptionGroup& group : page.groups) all.insert(all.end(), group.options.begin(), group.options.end());
  return all;
}

Words scheme_names() {
  Words names;
  for (const auto& [name, options] : scheme_words()) names.push_back(name);
  return names;
}

/// "tension=", "quads=edges": with each value, or without where it is a number.
Words scheme_option_words() {
  std::set<std::string> all;
  for (const auto& [name, options] : scheme_words())
    for (const OptionInfo& option : options)
      if (option.range)
        all.insert(option.name + "=");
      else
        for (const std::string& value : option.values) all.insert(option.name + "=" + value);
  return {all.begin(), all.end()};
}

/// What may stand for an option's value, if it is one of a list.
Words candidates(const OptionPage& option, const ProgramPage& page) {
  if (option.kind == words) return option.names.back() == "--generate" ? manual_kinds() : option.words;
  if (option.kind == scheme_option) return scheme_option_words();
  if (option.kind == scheme) {
    Words names = scheme_names();
    if (option.text.ends_with("or all")) names.emplace_back("all");
    return names;
  }
  if (option.kind != verb) return {};
  Words names;
  for (const VerbPage& known : page.verbs) names.push_back(known.name);
  return names;
}

// Manual pages.

std::string roff(std::string text) {
  text = with_replaced(std::move(text), "\\", "\\e");
  text = with_replaced(std::move(text), "-", "\\-");
  text = with_replaced(std::move(text), "'", "\\(aq");
  text = with_replaced(std::move(text), "`", "\\(ga");
  text = with_replaced(std::move(text), "^", "\\(ha");
  text = with_replaced(std::move(text), "~", "\\(ti");
  std::string lines;
  for (size_t at = 0; at < text.size();) {
    const size_t end = std::min(text.find('\n', at), text.size() - 1) + 1;
    if (text[at] == '.') lines += "\\&";
    lines += text.substr(at, end - at);
    at = end;
  }
  return lines;
}

/// Sentences begin a line each, as roff wants them.
std::string roff_sentences(const std::string& text) {
  std::string lines = roff(text);
  for (size_t at = 0; (at = lines.find(". ", at)) != std::string::npos; ++at)
    if (at + 2 < lines.size() && std::isupper(static_cast<unsigned char>(lines[at + 2])) != 0) lines[at + 1] = '\n';
  return lines;
}

std::string roff_option(const OptionPage& option) {
  std::string head;
  for (const std::string& name : option.names)
    head += (head.empty() ? "" : ", ") + (option.argument ? "\\fI" + roff(name) : "\\fB" + roff(name)) + "\\fR";
  if (!option.argument && !option.value.empty()) head += " \\fI" + roff(option.value) + "\\fR";
  std::string text = roff_sentences(option.text);
  if (option.required && !option.argument) text += " (required)";
  if (option.repeats && option.text.find("repeated") == std::string::npos) text += "; may be repeated";
  return ".TP\n" + head + "\n" + text + "\n";
}

std::string man_page(const VerbPage& page, const ProgramPage& all) {
  const bool is_program = page.name == all.name;
  std::string title = is_program ? all.name : all.name + "-" + page.name;
  std::string upper = title;
  std::ranges::transform(upper, upper.begin(), [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  std::string text = fmt::format(".TH {} 1 \"\" \"{}\" \"{} manual\"\n", roff(upper), roff(all.version), all.name);
  text += fmt::format(".SH NAME\n{} \\- {}\n", roff(title), roff(without_dot(lower_first(page.sentence))));
  text += ".SH SYNOPSIS\n";
  for (const char* part = ".B "; const std::string& word : {all.name, is_program ? std::string() : page.name}) {
    if (!word.empty()) text += part + word + "\n";
    part = ".B ";
  }
  text += ".RI [ OPTIONS ]\n";
  for (const OptionPage& argument : page.arguments)
    text += argument.required ? ".I " + argument.names.front() + "\n" : ".RI [ " + argument.names.front() + " ]\n";
  if (is_program) text += ".I SUBCOMMAND\n.RI [ ARGUMENTS ]\n";
  text += ".SH DESCRIPTION\n" + roff(without_dot(page.sentence)) + ".\n";
  for (const Note& note : page.notes)
    text += note.as_it_is ? ".PP\n.nf\n.RS 4\n" + roff(note.text) + "\n.RE\n.fi\n"
                          : ".PP\n" + roff_sentences(note.text) + "\n";
  if (is_program) {
    text += ".SH SUBCOMMANDS\n";
    for (const VerbPage& verb : all.verbs)
      text += ".TP\n.B " + verb.name + "\n" + roff(verb.sentence) + ": see\n.BR " + roff(all.name + "-" + verb.name) +
              " (1).\n";
  }
  if (!page.arguments.empty()) text += ".SH ARGUMENTS\n";
  for (const OptionPage& argument : page.arguments) text += roff_option(argument);
  text += ".SH OPTIONS\n";
  for (const OptionGroup& group : page.groups) {
    if (group.title != "Options") text += ".SS " + roff(group.title) + "\n";
    for (const OptionPage& option : group.options) text += roff_option(option);
  }
  text += ".SH EXIT STATUS\n";
  for (const auto& [status, meaning] : page.exits) text += fmt::format(".TP\n.B {}\n{}\n", status, roff(meaning));
  if (!page.files.empty()) text += ".SH FILES\n";
  for (const auto& [name, meaning] : page.files) text += ".TP\n.I " + roff(name) + "\n" + roff(meaning) + "\n";
  text += ".SH EXAMPLES\n";
  for (bool first = true; const Example& example : page.examples) {
    if (!std::exchange(first, false)) text += ".PP\n";
    if (!example.remark.empty()) text += roff(example.remark) + ":\n";
    text += ".nf\n.RS 4\n" + roff(example.line) + "\n.RE\n.fi\n";
  }
  text += ".SH SEE ALSO\n";
  if (is_program) {
    for (size_t i = 0; i < all.verbs.size(); ++i)
      text +=
          fmt::format(".BR {} (1){}\n", roff(all.name + "-" + all.verbs[i].name), i + 1 < all.verbs.size() ? "," : "");
  } else {
    text += fmt::format(".BR {} (1)\n", all.name);
  }
  return text;
}

// Pages in Markdown.

/// A cell of a table: bars and stars are letters in it.
std::string cell(std::string text) {
  text = with_replaced(std::move(text), "|", "\\|");
  return with_replaced(std::move(text), "*", "\\*");
}

/// Text with what would be markup as letters, but for code between backticks.
std::string prose(const std::string& text) {
  std::string out;
  bool code = false;
  for (const char c : text) {
    if (c == '`') code = !code;
    if (!code && (c == '*' || c == '_' || c == '[' || c == ']' || c == '<' || c == '>' || c == '^' || c == '\\'))
      out += '\\';
    out += c;
  }
  return out;
}

std::string markdown_rows(const std::vector<OptionPage>& options) {
  std::string rows = "| | |\n|---|---|\n";
  for (const OptionPage& option : options) {
    std::string name = joined(option.names, ", ");
    if (!option.argument && !option.value.empty()) name += " " + option.value;
    rows += "| `" + with_replaced(name, "|", "\\|") + "` | " + with_replaced(prose(option.text), "|", "\\|") +
            (option.required && !option.argument ? " (required)" : "") + " |\n";
  }
  return rows + "\n";
}

std::string markdown_page(const VerbPage& page, const ProgramPage& all) {
  const bool is_program = page.name == all.name;
  std::string text = "# " + (is_program ? all.name : all.name + " " + page.name) + "\n\n";
  text += prose(without_dot(page.sentence)) + ".\n\n```text\n" + page.usage + "\n```\n\n";
  text += "## Examples\n\n```shell\n";
  for (const Example& example : page.examples)
    text += example.line + (example.remark.empty() ? "" : "   # " + example.remark) + "\n";
  text += "```\n\n";
  if (is_program) {
    text += "## Subcommands\n\n| | |\n|---|---|\n";
    for (const VerbPage& verb : all.verbs)
      text += fmt::format("| [{1}]({0}-{1}.md) | {2} |\n", all.name, verb.name, cell(prose(verb.sentence)));
    text += "\n";
  }
  if (!page.arguments.empty()) text += "## Arguments\n\n" + markdown_rows(page.arguments);
  for (const OptionGroup& group : page.groups)
    text +=
        "## " + std::string(group.title == "Options" ? "Options" : group.title) + "\n\n" + markdown_rows(group.options);
  if (!page.notes.empty()) text += "## Notes\n\n";
  for (const Note& note : page.notes)
    text += note.as_it_is ? "```text\n" + note.text + "\n```\n\n" : prose(note.text) + "\n\n";
  text += "## Exit status\n\n| | |\n|---|---|\n";
  for (const auto& [status, meaning] : page.exits) text += fmt::format("| {} | {} |\n", status, cell(prose(meaning)));
  if (!page.files.empty()) text += "\n## Files\n\n| | |\n|---|---|\n";
  for (const auto& [name, meaning] : page.files) text += "| `" + name + "` | " + cell(prose(meaning)) + " |\n";
  return text;
}

// Completions.

/// In single quotes of a shell.
std::string quoted(const std::string& text) { return "'" + with_replaced(text, "'", "'\\''") + "'"; }

std::string patterns_of(const OptionPage& option) { return joined(option.extensions, "|"); }

/// A line of a `case`: what to complete behind one of the option's names.
std::string bash_values(const OptionPage& option, const ProgramPage& page) {
  if (const Words list = candidates(option, page); !list.empty()) return "_sublimit_words " + quoted(joined(list, " "));
  if (option.kind == in_file) return "_sublimit_files " + quoted(patterns_of(option));
  if (option.kind == out_file) return "_sublimit_files ''";
  if (option.kind == directory) return "_sublimit_directories";
  return "COMPREPLY=()";
}

std::string bash_verb(const VerbPage& verb, const ProgramPage& page) {
  Words names;
  std::string values, arguments;
  for (const OptionPage& option : options_of(verb)) {
    names.insert(names.end(), option.names.begin(), option.names.end());
    if (option.kind != none)
      values += fmt::format("        {}) {}; return ;;\n", joined(option.names, "|"), bash_values(option, page));
  }
  for (size_t i = 0; i < verb.arguments.size(); ++i)
    arguments += fmt::format("        {}) {} ;;\n", i, bash_values(verb.arguments[i], page));
  std::string text = fmt::format("    {})\n      options={}\n", verb.name, quoted(joined(names)));
  if (!values.empty()) text += "      case $previous in\n" + values + "      esac\n";
  text += "      [[ $current == -* ]] && { _sublimit_words \"$options\"; return; }\n";
  if (!arguments.empty()) text += "      case $arguments in\n" + arguments + "      esac\n";
  return text + "      ;;\n";
}

std::string bash_completion(const ProgramPage& page) {
  Words verbs, with_values, own;
  for (const VerbPage& verb : page.verbs) {
    verbs.push_back(verb.name);
    for (const OptionPage& option : options_of(verb))
      if (option.kind != none) with_values.insert(with_values.end(), option.names.begin(), option.names.end());
  }
  for (const OptionPage& option : options_of(page.program))
    own.insert(own.end(), option.names.begin(), option.names.end());
  std::ranges::sort(with_values);
  with_values.erase(std::unique(with_values.begin(), with_values.end()), with_values.end());
  std::string text = "# Completion of " + page.version + " for bash, made by `sublimit --generate bash DIR`.\n";
  text += R"bash(
# Words that begin with what is typed.
_sublimit_words() {
  local word
  COMPREPLY=()
  for word in $1; do [[ $word == "$current"* ]] && COMPREPLY+=("$word"); done
  if [[ ${#COMPREPLY[@]} -eq 1 && ${COMPREPLY[0]} == *= ]]; then compopt -o nospace 2>/dev/null; fi
  # What stands before the last '=' is a word of its own to readline.
  if [[ $current == *=* && $COMP_WORDBREAKS == *=* ]]; then COMPREPLY=("${COMPREPLY[@]#*=}"); fi
}

_sublimit_directories() {
  local name
  compopt -o filenames 2>/dev/null
  COMPREPLY=()
  while IFS= read -r name; do [[ -n $name ]] && COMPREPLY+=("$name"); done < <(compgen -d -- "$current")
}

# Files with one of these extensions (all of them if none is named), and directories.
_sublimit_files() {
  local name
  compopt -o filenames 2>/dev/null
  COMPREPLY=()
  while IFS= read -r name; do
    if [[ -d $name || -z $1 || ${name##*.} =~ ^($1)$ ]]; then COMPREPLY+=("$name"); fi
  done < <(compgen -f -- "$current")
}

_sublimit() {
  local current previous verb='' options='' word
  local -i arguments=0 at=1 end=COMP_CWORD
  current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD-1]}
  # `name=value` comes as three words.
  if [[ $current == = ]]; then
    current="$previous=" previous=${COMP_WORDS[COMP_CWORD-2]} end=COMP_CWORD-1
  elif [[ $previous == = && COMP_CWORD -gt 2 ]]; then
    current="${COMP_WORDS[COMP_CWORD-2]}=$current" previous=${COMP_WORDS[COMP_CWORD-3]} end=COMP_CWORD-2
  fi
  if [[ $current == --*=* ]]; then previous=${current%%=*} current=${current#*=}; fi
  COMPREPLY=()
)bash";
  text +=
      "  # The subcommand, and how many arguments stand before the word.\n  for ((at = 1; at < end; ++at)); do\n"
      "    word=${COMP_WORDS[at]}\n    if [[ -z $verb ]]; then\n      [[ $word == -* ]] || verb=$word\n      continue\n"
      "    fi\n    case $word in\n      " +
      joined(with_values, "|") +
      ") if [[ ${COMP_WORDS[at+1]-} == = ]]; then at+=2; else at+=1; fi ;;\n      -*) ;;\n"
      "      *) arguments+=1 ;;\n    esac\n  done\n";
  text += "  if [[ -z $verb ]]; then\n    if [[ $previous == --generate ]]; then _sublimit_words " +
          quoted(joined(manual_kinds())) + "\n    elif [[ $current == -* ]]; then _sublimit_words " +
          quoted(joined(own)) + "\n    else _sublimit_words " + quoted(joined(verbs)) + "\n    fi\n    return\n  fi\n";
  text += "  if [[ ${COMP_WORDS[1]} == --generate ]]; then _sublimit_directories; return; fi\n";
  text += "  case $verb in\n";
  for (const VerbPage& verb : page.verbs) text += bash_verb(verb, page);
  return text + "  esac\n}\n\ncomplete -F _sublimit " + page.name + "\n";
}

/// A description in zsh's brackets.
std::string zsh_text(std::string text) {
  for (const char* special : {"\\", "[", "]", ":", "`", "$", "\""})
    text = with_replaced(std::move(text), special, std::string("\\") + special);
  return with_replaced(std::move(text), "'", "'\\''");
}

std::string zsh_action(const OptionPage& option, const ProgramPage& page) {
  const Words list = candidates(option, page);
  if (option.kind == scheme_option) return "{compadd -S \"\" -- " + joined(list, " ") + "}";
  if (!list.empty()) return "(" + joined(list, " ") + ")";
  if (option.kind == in_file)
    return option.extensions.empty() ? "_files" : "_files -g \"*.(" + patterns_of(option) + ")(-.)\"";
  if (option.kind == out_file) return "_files";
  if (option.kind == directory) return "_files -/";
  return " ";
}

std::string zsh_option(const OptionPage& option, const ProgramPage& page) {
  std::string lines;
  for (const std::string& name : option.names) {
    const bool is_long = name.starts_with("--");
    lines += "        '" + (option.repeats ? std::string("*") : "(" + joined(option.names) + ")") + name +
             (option.kind == none ? ""
              : is_long           ? "="
                                  : "+") +
             "[" + zsh_text(option.text) + "]";
    if (option.kind != none) lines += ":" + zsh_text(option.value) + ":" + zsh_action(option, page);
    lines += "' \\\n";
  }
  return lines;
}

std::string zsh_completion(const ProgramPage& page) {
  std::string text = "#compdef " + page.name + "\n# Completion of " + page.version +
                     " for zsh, made by `sublimit --generate zsh DIR`.\n\n_sublimit() {\n"
                     "  local curcontext=$curcontext state line\n  typeset -A opt_args\n  local -a verbs=(\n";
  for (const VerbPage& verb : page.verbs) text += "    '" + verb.name + ":" + zsh_text(verb.sentence) + "'\n";
  text += "  )\n  _arguments -C \\\n";
  for (const OptionPage& option : options_of(page.program)) {
    if (option.names.back() == "--generate")
      text += "    '--generate[" + zsh_text(option.text) + "]:kind:(" + joined(manual_kinds()) +
              "):directory:_files -/' \\\n";
    else
      text += with_replaced(zsh_option(option, page), "        '", "    '");
  }
  text +=
      "    '1:subcommand:->verb' '*::argument:->rest'\n  case $state in\n"
      "    verb) _describe subcommand verbs ;;\n    rest)\n      case $words[1] in\n";
  for (const VerbPage& verb : page.verbs) {
    text += "      " + verb.name + ")\n        _arguments -s \\\n";
    for (const OptionPage& option : options_of(verb)) text += zsh_option(option, page);
    for (const OptionPage& argument : verb.arguments)
      text += "        '" + std::string(argument.required ? "" : ":") + ":" + zsh_text(argument.value) + ":" +
              zsh_action(argument, page) + "' \\\n";
    text.resize(text.size() - 3);
    text += "\n        ;;\n";
  }
  return text + "      esac\n      ;;\n  esac\n}\n\n_sublimit \"$@\"\n";
}

std::string fish_completion(const ProgramPage& page) {
  std::string text = "# Completion of " + page.version + " for fish, made by `sublimit --generate fish DIR`.\n";
  const auto fish_quoted = [](const std::string& raw) {
    return "'" + with_replaced(with_replaced(raw, "\\", "\\\\"), "'", "\\'") + "'";
  };
  Words verbs;
  for (const VerbPage& verb : page.verbs) verbs.push_back(verb.name);
  const std::string none_yet = "not __fish_seen_subcommand_from " + joined(verbs);
  text += "complete -c sublimit -f\n";
  const auto add = [&](const OptionPage& option, const std::string& condition) {
    std::string line = "complete -c sublimit -n " + fish_quoted(condition);
    for (const std::string& name : option.names) {
      if (option.argument) break;
      line += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
    }
    const Words list = candidates(option, page);
    std::string values;
    if (!list.empty())
      values = " -a " + fish_quoted(joined(list, " "));
    else if (option.kind == directory)
      values = " -a '(__fish_complete_directories)'";
    else if (option.kind == in_file && !option.extensions.empty())
      for (const std::string& extension : option.extensions)
        values += (values.empty() ? " -a '(__fish_complete_suffix ." : "; __fish_complete_suffix .") + extension;
    if (values.find("_suffix") != std::string::npos) values += ")'";
    const bool any_file = option.kind == out_file || (option.kind == in_file && option.extensions.empty());
    if (option.kind != none && !option.argument) line += any_file ? " -r -F" : " -x";
    if (option.argument && any_file) line += " -F";
    text += line + values + " -d " + fish_quoted(option.argument ? option.value : option.text) + "\n";
  };
  for (const VerbPage& verb : page.verbs)
    text += "complete -c sublimit -n " + fish_quoted(none_yet) + " -a " + verb.name + " -d " +
            fish_quoted(verb.sentence) + "\n";
  for (const OptionPage& option : options_of(page.program)) add(option, none_yet);
  for (const VerbPage& verb : page.verbs) {
    const std::string seen = "__fish_seen_subcommand_from " + verb.name;
    for (const OptionPage& option : options_of(verb)) add(option, seen);
    for (const OptionPage& argument : verb.arguments) add(argument, seen);
  }
  return text;
}

}  // namespace

const Words& manual_kinds() {
  static const Words kinds{"man", "bash", "zsh", "fish", "markdown"};
  return kinds;
}

Files manual_files(const ProgramPage& page, const std::string& kind) {
  if (kind == "bash") return {{page.name, bash_completion(page)}};
  if (kind == "zsh") return {{"_" + page.name, zsh_completion(page)}};
  if (kind == "fish") return {{page.name + ".fish", fish_completion(page)}};
  const bool man = kind == "man";
  const char* extension = man ? ".1" : ".md";
  const auto text = [&](const VerbPage& verb) { return man ? man_page(verb, page) : markdown_page(verb, page); };
  Files files{{page.name + extension, text(page.program)}};
  for (const VerbPage& verb : page.verbs) files.emplace_back(page.name + "-" + verb.name + extension, text(verb));
  return files;
}

}  // namespace sublimit::cli
