// SPDX-License-Identifier: Apache-2.0
#pragma once
// Words and numbers as HTML: escaped, typeset, missing ones as dashes.
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sublimit/report/page/json.h"
#include "sublimit/stencils/picture/svg.h"

namespace sublimit::page {

using svg::escaped;

inline constexpr const char* dash = "<span class=\"none\" title=\"does not exist or is not known\">–</span>";

/// A number with a true minus, to so many digits, as plain text: "0.54999", "−2.5", "1.2e−5".
std::string digits(double value, int count = 5);

/// Returns a number as HTML, with raised powers of ten; a dash if absent.
std::string shown(std::optional<double> value, int count = 5);
std::string shown(const Json& value, int count = 5);
inline std::string shown(double value, int count = 5) { return shown(std::optional(value), count); }

/// A sentence as HTML: C^1 gets its superscript, lambda and mu their letters.
std::string prose(std::string_view text);
std::string prose(const Json& value);
inline std::string prose(const std::string& text) { return prose(std::string_view(text)); }

/// Returns the text without markup, for drawings: C².
std::string plain(std::string_view text);

/// An exact number as reports write it, "(11+sqrt(5))/24", "1/2*cos(2pi/5)", in signs; a dash if there is none.
std::string exact_number(const Json& value);

/// Text as it stands, escaped; a dash if there is none.
std::string literal(const Json& value);

/// A name as the value of an id: letters, digits and hyphens, never empty.
std::string identifier(std::string_view name);

/// "proved", "evidence-for", ...: a word and a sign in a coloured box.
std::string badge(const Json& verdict);

/// Rows of HTML cells under heads; the first cell of a row is its head. Scrolls within its own box.
struct Table {
  std::string caption;
  std::vector<std::string> heads;
  std::vector<std::vector<std::string>> rows;
  std::string style = {};  ///< class of the table
};
std::string html(const Table& table);

/// A list of terms and descriptions; empty descriptions are left out.
std::string facts(const std::vector<std::pair<std::string, std::string>>& items);

}  // namespace sublimit::page
