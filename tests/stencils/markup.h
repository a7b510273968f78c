// SPDX-License-Identifier: Apache-2.0
#pragma once
// A strict reader for the markup of pages: every element must be closed, every attribute quoted, every entity
// known.
#include <gtest/gtest.h>

#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace sublimit::testing {

struct Markup {
  std::string fault;                    ///< first fault; empty if well-formed
  std::map<std::string, int> elements;  ///< number of occurrences
  std::map<std::string, int> ids;       ///< number of occurrences
  std::vector<std::string> links;       ///< values of href
  int images = 0, untitled = 0;         ///< SVG with role img; of these, ones that do not start with a title
};

/// Reads HTML in which only `meta`, `br`, `img` and elements that end in "/>" have no end tag.
inline Markup read_markup(std::string_view text) {
  Markup markup;
  std::vector<std::string> open;
  bool title_next = false;
  const auto fail = [&](std::size_t at, const std::string& what) {
    if (markup.fault.empty()) markup.fault = what + " near: " + std::string(text.substr(at, 100));
  };
  const auto check_text = [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (text[i] == '>') fail(i, "a bare >");
      if (text[i] != '&') continue;
      const std::string_view rest = text.substr(i, 6);
      bool known = false;
      for (std::string_view entity : {"&amp;", "&lt;", "&gt;", "&quot;"})
        known |= rest.substr(0, entity.size()) == entity;
      if (!known) fail(i, "an unknown entity");
    }
  };
  std::size_t i = 0;
  while (i < text.size() && markup.fault.empty()) {
    const std::size_t tag = text.find('<', i);
    if (!open.empty() && (open.back() == "style" || open.back() == "script")) {  // no markup
      i = text.find("</" + open.back() + ">", i);
    } else {
      check_text(i, std::min(tag, text.size()));
      i = tag;
    }
    if (i >= text.size()) break;
    // The end of the tag: the first > outside quotes.
    std::size_t end = i + 1;
    for (bool quoted = false; end < text.size() && (quoted || text[end] != '>'); ++end) quoted ^= text[end] == '"';
    if (end >= text.size()) {
      fail(i, "a tag that does not end");
      break;
    }
    std::string_view inner = text.substr(i + 1, end - i - 1);
    const std::size_t here = i;
    i = end + 1;
    if (inner.substr(0, 8) == "!DOCTYPE") continue;
    if (inner[0] == '/') {
      if (open.empty() || open.back() != inner.substr(1))
        fail(here, "an end tag of nothing open");
      else
        open.pop_back();
      continue;
    }
    const bool closed = inner.back() == '/';
    if (closed) inner.remove_suffix(1);
    const std::string name(inner.substr(0, inner.find(' ')));
    if (name.empty() ||
        name.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789") != std::string::npos)
      fail(here, "no name of an element");
    ++markup.elements[name];
    if (title_next && name != "title") ++markup.untitled;
    title_next = false;
    std::set<std::string> seen;
    std::size_t a = std::min(name.size(), inner.size());
    while (a < inner.size()) {  // ` name="value"` or ` name`
      if (inner[a] != ' ') {
        fail(here, "attributes that are not apart");
        break;
      }
      ++a;
      const std::size_t stop = std::min(inner.find_first_of("= ", a), inner.size());
      const std::string attribute(inner.substr(a, stop - a));
      if (!seen.insert(attribute).second) fail(here, "an attribute twice");
      a = stop;
      if (a < inner.size() && inner[a] == '=') {
        const std::size_t close =
            a + 1 < inner.size() && inner[a + 1] == '"' ? inner.find('"', a + 2) : std::string_view::npos;
        if (close == std::string_view::npos) {
          fail(here, "an attribute without quotes");
          break;
        }
        const std::string value(inner.substr(a + 2, close - a - 2));
        if (value.find('<') != std::string::npos) fail(here, "< in an attribute");
        check_text(here + 1 + a + 2, here + 1 + close);
        if (attribute == "id") ++markup.ids[value];
        if (attribute == "href") markup.links.push_back(value);
        if (name == "svg" && attribute == "role" && value == "img") ++markup.images, title_next = true;
        a = close + 1;
      }
    }
    if (!closed && name != "meta" && name != "br" && name != "img") open.push_back(name);
  }
  if (markup.fault.empty() && !open.empty()) markup.fault = "never closed: " + open.back();
  return markup;
}

}  // namespace sublimit::testing
