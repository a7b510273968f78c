// SPDX-License-Identifier: Apache-2.0
#pragma once
// Reading CSV files that the program writes, whose fields have no quotes.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/detail/read_file.h"

namespace sublimit::testing {

using CsvRow = std::vector<std::string>;

inline std::vector<CsvRow> csv_rows(const std::filesystem::path& path) {
  std::vector<CsvRow> rows{{""}};
  for (const char c : sublimit::read_file(path)) {
    if (c == '\n') {
      rows.push_back({""});
    } else if (c == ',') {
      rows.back().emplace_back();
    } else {
      rows.back().back() += c;
    }
  }
  rows.pop_back();  // what follows the last line
  return rows;
}

inline double csv_number(const std::string& field) {
  const Parsed<double> parsed = parse_number<double>(field);
  EXPECT_TRUE(parsed) << "'" << field << "'";
  return parsed.value;
}

}  // namespace sublimit::testing
