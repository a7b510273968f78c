// SPDX-License-Identifier: Apache-2.0
#include "sublimit/io/detail/obj_keywords.h"

#include <algorithm>
#include <array>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/error.h"

namespace sublimit {
namespace {

constexpr std::array<std::string_view, 18> attribute_keywords{
    "g",     "o",        "s",        "p",          "usemtl",    "mtllib", "usemap", "mg",    "lod",
    "bevel", "c_interp", "d_interp", "shadow_obj", "trace_obj", "maplib", "call",   "ctech", "stech"};
constexpr std::array<std::string_view, 11> free_form_keywords{"cstype", "deg",  "bmat", "step", "parm", "trim",
                                                              "hole",   "scrv", "sp",   "end",  "con"};

}  // namespace

bool ObjElements::count(const TextScanner& scanner, std::string_view keyword) {
  if (keyword == "f") {
    ++faces;
  } else if (keyword == "l") {
    ++lines;
  } else if (keyword == "curv" || keyword == "curv2" || keyword == "surf") {
    ++(keyword == "surf" ? surfaces : keyword == "curv" ? curves : curves_2d);
    if (first_free_form < 0) first_free_form = scanner.line();
  } else {
    return false;
  }
  return true;
}

std::string ObjElements::free_form() const {
  std::vector<std::string> parts;
  if (curves > 0) parts.push_back(counted(curves, "curve"));
  if (surfaces > 0) parts.push_back(counted(surfaces, "surface"));
  if (curves_2d > 0) parts.push_back(counted(curves_2d, "curve") + " in parameter space");
  std::string text;
  for (std::size_t i = 0; i < parts.size(); ++i)
    text += (i == 0 ? "" : i + 1 == parts.size() ? " and " : ", ") + parts[i];
  return text;
}

std::string counted(std::int64_t count, std::string_view singular) {
  return format_number(count) + " " + std::string(singular) + (count == 1 ? "" : "s");
}

bool is_attribute_keyword(std::string_view keyword) {
  return std::ranges::find(attribute_keywords, keyword) != attribute_keywords.end();
}

bool is_free_form_keyword(std::string_view keyword) {
  return std::ranges::find(free_form_keywords, keyword) != free_form_keywords.end();
}

void UnknownKeywords::warn(const TextScanner& scanner, std::string_view keyword, std::vector<std::string>& warnings) {
  constexpr std::size_t most = 20;
  const auto is_text = [](char c) { return c >= 0x20 && c < 0x7f; };
  if (!std::ranges::all_of(keyword, is_text)) {
    throw FormatError(scanner.place() + "the line starts with " + in_quotes(keyword) +
                      ", so this is not a text OBJ file; statements such as 'v' and 'f' are expected");
  }
  if (seen_.size() >= most || !seen_.emplace(keyword).second) return;
  warnings.push_back(scanner.place() + "unknown keyword " + in_quotes(keyword) + " ignored");
  if (seen_.size() == most) warnings.push_back(scanner.place() + "further unknown keywords are not listed");
}

}  // namespace sublimit
