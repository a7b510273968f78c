// SPDX-License-Identifier: Apache-2.0
#include "support/stream_arguments.h"

#include <fmt/core.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sublimit/base/detail/file_error.h"
#include "sublimit/base/detail/memory.h"
#include "sublimit/base/detail/read_file.h"
#include "sublimit/base/detail/standard_files.h"
#include "sublimit/base/error.h"
#include "sublimit/core/detail/nearest_names.h"
#include "sublimit/stencils/formats/formats.h"
#include "support/common.h"
#include "support/input_files.h"
#include "support/manual.h"
#include "support/memory_limit.h"
#include "support/standard_streams.h"

namespace sublimit::cli {
namespace {

/// What an output holds that is written in one format alone: it needs no --format.
struct OutputContent {
  std::string_view verb;  ///< empty: any
  std::string_view option;
  Content content;
};
constexpr OutputContent output_contents[] = {
    {"", "--matrix", contents::matrices},     {"", "--report", contents::reports},
    {"analyze", "--json", contents::reports}, {"", "--picture", contents::pictures},
    {"", "--places", contents::rows},         {"sample", "--output", contents::rows},
    {"closest", "--output", contents::rows},  {"intersect", "--output", contents::rows},
    {"bake", "--output", contents::tables},   {"construct", "--output", contents::free_form},
    {"analyze", "--output", contents::pages},
};

/// A file of the command line that is a stream.
struct StreamArgument {
  CLI::Option* option;
  StandardFile file;
  std::string name() const { return option->get_name(option->get_positional()); }
};

StandardFile stream_of(const std::string& value, bool is_output) {
  if (value != "-") return standard_file(value).value();
  return is_output ? StandardFile{STDOUT_FILENO, "/dev/stdout", ""} : StandardFile{STDIN_FILENO, "/dev/stdin", ""};
}

bool is_stream(const CLI::Option& option) {
  return option.count() == 1 && (option.results().front() == "-" || standard_file(option.results().front()));
}

std::vector<StreamArgument> streams(CLI::App& command, bool outputs) {
  std::vector<StreamArgument> found;
  for (CLI::Option* option : command.get_options(
           [&](CLI::Option* o) { return outputs ? writes_file(*o) : !input_meaning(command, *o).empty(); }))
    if (is_stream(*option)) found.push_back({option, stream_of(option->results().front(), outputs)});
  for (size_t i = 1; i < found.size(); ++i)
    for (size_t j = 0; j < i; ++j)
      if (found[i].file.descriptor == found[j].file.descriptor)
        throw InvalidOption(fmt::format("{} and {} are both {}, which is one file; give one of them another name",
                                        found[j].name(), found[i].name(),
                                        outputs ? "standard output" : "standard input"));
  return found;
}

/// The extension that a word of --format means.
std::string extension_of(const std::string& word) {
  std::vector<std::string> words;
  const std::string wanted = file_extension("x." + word.substr(word.starts_with('.') ? 1 : 0));
  for (const FileFormat& row : all_formats().rows())
    for (const std::string_view extension : row.extensions) {
      if (extension == wanted) return wanted;
      words.emplace_back(extension.substr(1));
    }
  const std::vector<std::string> meant = nearest_names(word, words, 1);
  throw InvalidOption(fmt::format("--format {}: there is no such format;{} they are {}", word,
                                  meant.empty() ? "" : " did you mean " + meant.front() + "?", listed(words, "and")));
}

/// Formats of the streams that the command line gives: "ply" of the output, if there is one, else of the input;
/// "off:ply" of both.
struct GivenFormats {
  std::string input, output;  ///< extensions; empty if not given
};

GivenFormats given_formats(const CLI::App& command, bool any_input, bool any_output) {
  GivenFormats formats;
  const CLI::Option* const option = command.get_option("--format");
  if (option->count() == 0) return formats;
  const std::string text = option->results().front();
  if (!any_input && !any_output)
    throw InvalidOption(fmt::format(
        "--format {} is for `-`, standard input or output; other files have the format of their name", text));
  const size_t colon = text.find(':');
  if (colon != std::string::npos && !(any_input && any_output))
    throw InvalidOption(fmt::format("--format {}: formats of two files, and one of them alone is `-`", text));
  if (colon != std::string::npos) formats.input = extension_of(text.substr(0, colon));
  (any_output ? formats.output : formats.input) =
      extension_of(colon == std::string::npos ? text : text.substr(colon + 1));
  return formats;
}

/// A file in memory, without a name.
class MemoryFile {
 public:
  MemoryFile() : file_(::memfd_create("sublimit", MFD_CLOEXEC)) {
    if (file_ < 0) throw_file_error("standard input", "keep", errno);
  }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  ~MemoryFile() { ::close(file_); }

  void write(std::string_view bytes) {
    while (!bytes.empty()) {
      const ssize_t count = ::write(file_, bytes.data(), bytes.size());
      if (count < 0 && errno == EINTR) continue;
      if (count <= 0) throw_file_error("standard input", "keep", count < 0 ? errno : EIO);
      bytes.remove_prefix(size_t(count));
    }
  }
  /// Gives it the number of an open descriptor.
  void replace(int descriptor) {
    ::lseek(file_, 0, SEEK_SET);
    if (::dup2(file_, descriptor) < 0) throw_file_error("standard input", "keep", errno);
  }

 private:
  int file_;
};

/// Whether readers can open it from its beginning.
bool is_whole_file(const StandardFile& file) {
  struct ::stat status {};
  if (::fstat(file.descriptor, &status) != 0) throw_file_error(file.device, "read", errno);
  if (S_ISDIR(status.st_mode)) throw_file_error(file.device, "read", EISDIR, "name a file in it");
  return S_ISREG(status.st_mode) && ::lseek(file.descriptor, 0, SEEK_CUR) == 0;
}

/// Reads a stream to its end, and makes its descriptor a file that has what was read.
void keep_in_memory(const StandardFile& file, bool quiet) {
  const bool is_terminal = ::isatty(file.descriptor) != 0;
  if (is_terminal && !quiet)
    fmt::print(stderr, "sublimit: note: reading {} from the terminal; Ctrl-D in an empty line ends it\n", file.device);
  Progress progress(quiet || is_terminal);
  progress.step("reading " + file.device);
  const std::function<void(std::int64_t)> tell = progress.bytes_written();
  MemoryFile kept;
  std::string block(size_t{1} << 18, '\0');
  double bytes = 0;
  for (;;) {
    const ssize_t count = ::read(file.descriptor, block.data(), block.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0 && errno == EAGAIN) {  // whoever shares the pipe made it so
      pollfd ready{file.descriptor, POLLIN, 0};
      ::poll(&ready, 1, -1);
      continue;
    }
    if (count < 0) throw_file_error(file.device, "read", errno);
    if (count == 0) break;
    bytes += double(count);
    if (bytes > memory_limit())
      throw ResourceError(fmt::format("{}: more than {}; {}; give a file, or a smaller one", file.device,
                                      bytes_in_words(bytes - double(count)), memory_limit_in_words()));
    kept.write({block.data(), size_t(count)});
    tell(std::int64_t(bytes));
  }
  kept.replace(file.descriptor);
  progress.step("");
}

std::string first_bytes(const StandardFile& file) {
  std::string bytes(4096, '\0');
  bytes.resize(size_t(std::max<ssize_t>(::pread(file.descriptor, bytes.data(), bytes.size(), 0), 0)));
  return bytes;
}

/// The name that an input has from here on.
std::string opened_name(const CLI::App& command, const StreamArgument& input, const std::string& extension,
                        bool quiet) {
  const StandardFile& file = input.file;
  check_standard_stream(file.descriptor);
  if (!is_whole_file(file)) keep_in_memory(file, quiet);
  std::string start = first_bytes(file);
  if (is_gzip(start)) {
    MemoryFile whole;
    whole.write(inflated(read_file(file.device), file.device));
    whole.replace(file.descriptor);
    start = first_bytes(file);
  }
  if (!file.extension.empty()) return file.device + file.extension;
  if (!extension.empty()) return file.device + extension;
  const std::optional<std::string> found = input_extension(command, *input.option, start);
  if (found) return file.device + *found;
  const std::string meaning = input_meaning(command, *input.option);
  if (start.empty()) throw FormatError(fmt::format("{}: empty; {} is {}", file.device, input.name(), meaning));
  throw FormatError(fmt::format("{}: its first bytes do not tell its format; --format does ({} is {})", file.device,
                                input.name(), meaning));
}

/// The extension of an output without --format, if it has one alone.
std::string only_extension(const CLI::App& command, const CLI::Option& option) {
  for (const OutputContent& row : output_contents)
    if ((row.verb.empty() || row.verb == command.get_name()) && option.check_name(std::string(row.option)))
      return all_formats().writers({row.content}).front();
  return "";
}

/// Gives an option another value.
void set_value(CLI::Option& option, const std::string& value) {
  option.clear();
  option.add_result(value);
  option.run_callback();
}

bool is_given(const CLI::App& command, const std::string& name) {
  const CLI::Option* const option = command.get_option_no_throw(name);
  return option && option->count() > 0;
}

}  // namespace

void add_stream_format(CLI::App& command) {
  const std::vector<CLI::Option*> files = command.get_options(
      [&](CLI::Option* option) { return writes_file(*option) || !input_meaning(command, *option).empty(); });
  if (files.empty()) return;
  command.add_option_function<std::string>(
      "--format", [](const std::string&) {},  // `open_stream_arguments` reads it
      "Format of `-`, standard output or input, as the end of a file's name: ply; IN:OUT of both. Input needs it only "
      "where its first bytes do not tell");
}

void open_stream_arguments(CLI::App& command) {
  if (!command.get_option_no_throw("--format")) return;
  for (const CLI::Option* option : command.get_options())
    if (is_stream(*option) && takes_directory(*option))
      throw InvalidOption(option->get_name(option->get_positional()) + " " + option->results().front() +
                          ": it should be a directory, which standard streams are not");
  const std::vector<StreamArgument> inputs = streams(command, false), outputs = streams(command, true);
  const GivenFormats formats = given_formats(command, !inputs.empty(), !outputs.empty());
  if (is_given(command, "--mem-limit")) limit_memory(command.get_option("--mem-limit")->results().front());
  for (const StreamArgument& output : outputs) {
    std::string extension = output.file.extension;
    if (extension.empty()) extension = formats.output;
    if (extension.empty()) extension = only_extension(command, *output.option);
    check_standard_stream(output.file.descriptor);
    set_value(*output.option, output.file.device + extension);
    if (output.file.descriptor == STDOUT_FILENO) print_on_stderr();
  }
  for (const StreamArgument& input : inputs)
    set_value(*input.option, opened_name(command, input, formats.input, is_given(command, "--quiet")));
}

}  // namespace sublimit::cli
