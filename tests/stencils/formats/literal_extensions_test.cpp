// SPDX-License-Identifier: Apache-2.0
// What a format can is known by the table of formats alone: no source compares an extension.
#include <gtest/gtest.h>

#include <filesystem>
#include <regex>
#include <sstream>

#include "sublimit/base/detail/read_file.h"

namespace sublimit::testing {
namespace {

namespace fs = std::filesystem;

TEST(House, NoSourceComparesExtensions) {
  const std::regex compared("[!=]= ?\"\\.[a-z0-9]+\"");
  EXPECT_TRUE(std::regex_search(std::string("if (file_extension(path) != \".obj\")"), compared));
  size_t sources = 0;
  for (const char* folder : {"lib", "stencils"})
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(SUBLIMIT_SOURCE) / folder)) {
      if (entry.path().extension() != ".h" && entry.path().extension() != ".cpp") continue;
      ++sources;
      std::istringstream text(read_file(entry.path()));
      for (std::string line; std::getline(text, line);) {
        if (line.find("= \".") == std::string::npos) continue;
        EXPECT_FALSE(std::regex_search(line, compared))
            << entry.path() << ": " << line << "\nask io_formats() or all_formats() what the format can";
      }
    }
  EXPECT_GT(sources, 500u);
}

}  // namespace
}  // namespace sublimit::testing
