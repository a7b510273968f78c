// SPDX-License-Identifier: Apache-2.0
#include "support/output_files.h"

#include <fmt/core.h>
#include <sys/stat.h>

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sublimit/base/detail/followed_links.h"
#include "sublimit/base/detail/standard_files.h"
#include "sublimit/base/error.h"
#include "support/input_files.h"
#include "support/manual.h"

namespace sublimit::cli {
namespace {

namespace fs = std::filesystem;

/// What makes a file the same as another one: its place on a disk, or where it will be.
struct Identity {
  std::optional<std::pair<dev_t, ino_t>> inode;  ///< of a file or pipe that is there
  std::string place;                             ///< of one that is not
  friend bool operator==(const Identity&, const Identity&) = default;
};

/// Absent for terminals, sockets and devices like /dev/null, which anybody may share, and for directories.
std::optional<Identity> identity_of(const std::string& name) {
  const fs::path path = opened_path(name);
  struct ::stat status {};
  if (::stat(path.c_str(), &status) == 0) {
    if (!S_ISREG(status.st_mode) && !S_ISFIFO(status.st_mode)) return std::nullopt;
    return Identity{std::pair(status.st_dev, status.st_ino), ""};
  }
  try {
    std::error_code failed;
    const fs::path end = followed_links(path), directory = fs::canonical(directory_of(end), failed);
    if (failed) return std::nullopt;  // it cannot be written
    return Identity{std::nullopt, (directory / end.filename()).string()};
  } catch (const IoError&) {  // links in a circle: the writer says so
    return std::nullopt;
  }
}

struct NamedFile {
  std::string option, path;
  std::optional<Identity> identity;
  bool is_main = false;   ///< of -o
  bool in_place = false;  ///< written as work goes on
};

std::vector<NamedFile> named_files(const CLI::App& command, bool outputs) {
  std::vector<NamedFile> files;
  for (const CLI::Option* option : command.get_options()) {
    const bool is_dictionary = option->check_name("--dictionary");  // read and written
    const bool wanted =
        outputs ? writes_file(*option) || is_dictionary : !is_dictionary && !input_meaning(command, *option).empty();
    if (!wanted || option->count() != 1) continue;
    const std::string path = option->results().front();
    std::error_code ignored;
    const bool in_place = standard_file(path) || option->check_name("--log") || fs::is_fifo(path, ignored);
    files.push_back({option->get_name(option->get_positional()), path, identity_of(path),
                     option->check_name("--output"), in_place});
  }
  return files;
}

}  // namespace

void check_output_files(const CLI::App& command) {
  const std::vector<NamedFile> inputs = named_files(command, false), outputs = named_files(command, true);
  for (size_t i = 0; i < outputs.size(); ++i) {
    const NamedFile& output = outputs[i];
    if (!output.identity) continue;
    for (size_t j = 0; j < i; ++j)
      if (outputs[j].identity == output.identity)
        throw InvalidOption(fmt::format("{} {} and {} {} are the same file; choose another name for one of them",
                                        outputs[j].option, outputs[j].path, output.option, output.path));
    for (const NamedFile& input : inputs)
      if (input.identity == output.identity && (!output.is_main || output.in_place))
        throw InvalidOption(fmt::format("{} {}: this file is {}, which is read; choose another name", output.option,
                                        output.path, input.option));
  }
}

}  // namespace sublimit::cli
