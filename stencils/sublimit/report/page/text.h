// SPDX-License-Identifier: Apache-2.0
#pragma once
// Words and numbers as HTML: escaped and typeset, with dashes for missing ones.
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sublimit/report/page/json.h"
#include "sublimit/stencils/picture/svg.h"

namespace sublimit::page {

using svg::escaped;

inline constexpr const char* dash = "<span class=\"none\" title=\"does not exist or is not known\">–</span>";

/// Returns a number with a minus sign (not a hyphen), to so many digits, as plain text: "0.54999", "−2.5",
/// "1.2e−5".
std::string digits(double value, int count = 5);

/// Returns a number as HTML, with raised powers of ten; a dash if absent.
std::string shown(std::optional<double> value, int count = 5);
std::string shown(const Json& value, int count = 5);
inline std::string shown(double value, int count = 5) { return shown(std::optional(value), count); }

/// Returns a sentence as HTML: C^1 with a superscript, lambda and mu as Greek letters.
std::string prose(std::string_view text);
std::string prose(const Json& value);
inline std::string prose(const std::string& text) { return prose(std::string_view(text)); }

/// Returns the text without markup, for drawings: C².
std::string plain(std::string_view text);

/// Returns an exact number of a report, "(11+sqrt(5))/24", "1/2*cos(2pi/5)", with mathematical signs; a dash if
/// absent.
std::string exact_number(const Json& value);

/// Returns text unchanged but escaped; a dash if absent.
std::string literal(const Json& value);

/// Returns a name as the value of an id: letters, digits and hyphens, never empty.
std::string identifier(std::string_view name);

/// Returns a verdict ("proved", "evidence-for", ...) as a word and a sign in a coloured box.
std::string badge(const Json& verdict);

/// A table of HTML cells with column heads; the first cell of a row is its head. It scrolls within its own box.
struct Table {
  std::string caption;
  std::vector<std::string> heads;
  std::vector<std::vector<std::string>> rows;
  std::string style = {};  ///< class of the table
};
std::string html(const Table& table);

/// Returns a list of terms and descriptions; entries with empty descriptions are left out.
std::string facts(const std::vector<std::pair<std::string, std::string>>& items);

}  // namespace sublimit::page
