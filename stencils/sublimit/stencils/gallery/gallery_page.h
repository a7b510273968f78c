// SPDX-License-Identifier: Apache-2.0
#pragma once
// The gallery as one page of HTML, with its pictures beside it.
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace sublimit::gallery {

/// A line of pictures and what was measured on it.
struct PageRow {
  std::string name, source;
  std::vector<std::pair<std::string, std::string>> numbers;  ///< names and values
  std::string picture;                                       ///< a file
};
struct PageTable {
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;
};
/// Text, a picture of all that it has, a table and rows, as far as there are any.
struct PageSection {
  std::string id, title;
  std::vector<PageRow> rows;
  std::string text = {};                       ///< HTML as it is
  std::string picture = {}, description = {};  ///< a file, and what it shows
  PageTable table = {};
};

std::string page(const std::string& overview, std::span<const PageSection> sections);

}  // namespace sublimit::gallery
