// SPDX-License-Identifier: Apache-2.0
#pragma once
// Parts of the text of USD: identifiers for prims and primvars, texts in quotes, lists of values.
#include <Eigen/Core>

#include <array>
#include <cctype>
#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/detail/row_writer.h"

namespace sublimit {

/// Words of USD for rules, in the order of the enumerators of mesh/mesh.h.
inline constexpr std::array<std::string_view, 3> usd_boundary_words{"none", "edgeOnly", "edgeAndCorner"};
inline constexpr std::array<std::string_view, 2> usd_creasing_words{"uniform", "chaikin"};
inline constexpr std::array<std::string_view, 2> usd_triangles_words{"catmullClark", "smooth"};
inline constexpr std::array<std::string_view, 6> usd_face_varying_words{"none",         "cornersOnly", "cornersPlus1",
                                                                        "cornersPlus2", "boundaries",  "all"};
/// Words for the interpolation of primvars, in the order of `UsdPrimvar::Interpolation`.
inline constexpr std::array<std::string_view, 5> usd_interpolation_words{"constant", "uniform", "varying", "vertex",
                                                                         "faceVarying"};

/// Name of the only mesh of a file, which is no object's.
inline constexpr const char* unnamed_usd_mesh = "mesh";

/// Identifiers for names of the same prim.
class UsdNames {
 public:
  /// Returns an identifier that none of the earlier names has: other characters than ASCII letters and digits become _.
  std::string unique(std::string_view name) {
    std::string identifier;
    for (const char c : name)
      identifier += std::isalnum(static_cast<unsigned char>(c)) && static_cast<unsigned char>(c) < 128 ? c : '_';
    if (identifier.empty() || std::isdigit(static_cast<unsigned char>(identifier[0])))
      identifier.insert(identifier.begin(), '_');
    std::string made = identifier;
    for (int& next = next_[identifier]; !used_.insert(made).second;) made = identifier + "_" + format_number(++next);
    return made;
  }

 private:
  std::unordered_set<std::string> used_;
  std::unordered_map<std::string, int> next_;  // the last number that was put behind an identifier
};

/// Writes a list of values in square brackets, eight of them in each line.
/// @param indent  of the line in which the list begins
/// @param append  append(text, i) appends value i; called by any thread
template <class Append>
void write_usd_list(RowWriter& out, const std::string& indent, std::int64_t count, const Append& append) {
  constexpr std::int64_t values_per_block = 4096;
  out.write("[");
  out.rows(count, values_per_block, [&](std::string& text, std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i < end; ++i) {
      if (i > 0) text += i % 8 == 0 ? ",\n" + indent + "    " : ", ";
      append(text, i);
    }
  });
  out.write("]");
}

/// Appends a value of one number, or of several in parentheses.
/// @tparam Number  float or double: the digits that are written
template <class Number, class Row>
void append_usd_row(std::string& text, const Row& row) {
  if (row.size() > 1) text += '(';
  for (Eigen::Index c = 0; c < row.size(); ++c) {
    if (c > 0) text += ", ";
    append_number(text, static_cast<Number>(row[c]));
  }
  if (row.size() > 1) text += ')';
}

/// Returns metadata as they stand behind a property or a prim, one in a line, as other readers expect them.
/// @param lines   empty: none
/// @param indent  of the line that they stand behind
inline std::string usd_metadata(std::string lines, const std::string& indent) {
  if (lines.empty()) return lines;
  for (std::size_t at = 0; (at = lines.find('\n', at)) != std::string::npos;) lines.insert(at += 1, indent + "    ");
  return " (\n" + indent + "    " + lines + "\n" + indent + ")";
}

/// Returns a text in quotes.
inline std::string usd_text(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '\n')
      out += "\\n";
    else if (c == '"' || c == '\\')
      out += std::string("\\") + c;
    else if (static_cast<unsigned char>(c) >= ' ' || c == '\t')
      out += c;
  }
  return out + "\"";
}

}  // namespace sublimit
