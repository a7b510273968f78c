// SPDX-License-Identifier: Apache-2.0
#pragma once
// The gallery as one page of HTML, with its pictures beside it.
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace sublimit::gallery {

/// A row of pictures, with the measured numbers.
struct PageRow {
  std::string name, source;
  std::vector<std::pair<std::string, std::string>> numbers;  ///< names and values
  std::string picture;                                       ///< file of the picture
};
struct PageTable {
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;
};
/// A section: text, a picture of everything in it, a table, rows; each may be absent.
struct PageSection {
  std::string id, title;
  std::vector<PageRow> rows;
  std::string text = {};                       ///< text as HTML
  std::string picture = {}, description = {};  ///< file of a picture, and its description
  PageTable table = {};
};

std::string page(const std::string& overview, std::span<const PageSection> sections);

}  // namespace sublimit::gallery
