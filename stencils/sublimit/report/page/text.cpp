// SPDX-License-Identifier: Apache-2.0
#include "sublimit/report/page/text.h"

#include <fmt/core.h>

#include <array>
#include <utility>

namespace sublimit::page {
namespace {

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

void replace(std::string& text, std::string_view from, std::string_view to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
    text.replace(at, from.size(), to);
}

/// Splits off the exponent after '^' at text[i]: a number, one letter, or what is in braces.
std::string_view exponent(std::string_view text, std::size_t i, std::size_t& end) {
  std::size_t begin = i + 1;
  if (begin < text.size() && text[begin] == '{') {
    const std::size_t close = text.find('}', begin);
    if (close == std::string_view::npos) return {};
    end = close + 1;
    return text.substr(begin + 1, close - begin - 1);
  }
  end = begin;
  if (end < text.size() && text[end] == '-') ++end;
  const std::size_t first = end;
  while (end < text.size() && is_digit(text[end])) ++end;
  if (end == first && end < text.size() && is_letter(text[end])) ++end;
  return end == first ? std::string_view() : text.substr(begin, end - begin);
}

std::string superscript(char sign, std::string_view digits) {
  if (sign == '_') return "_" + escaped(digits);
  static constexpr std::array<const char*, 10> raised = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text;
  for (char c : digits) text += is_digit(c) ? raised[c - '0'] : c == '-' ? "⁻" : c == 'k' ? "ᵏ" : c == 'p' ? "ᵖ" : "";
  return text;
}

/// Letters for their names, exponents raised by `raise`.
template <class Raise>
std::string typeset(std::string_view text, Raise raise) {
  static constexpr std::array<std::pair<std::string_view, const char*>, 4> greek = {
      {{"lambda", "λ"}, {"mu", "μ"}, {"pi", "π"}, {"+-", "±"}}};
  std::string result;
  for (std::size_t i = 0; i < text.size();) {
    const char c = text[i];
    std::size_t end = i;
    // a_n is an index only where one letter stands before it and one after.
    const bool after_letter = i > 0 && is_letter(text[i - 1]) && (i < 2 || !is_letter(text[i - 2]));
    const bool raised = c == '^' && i > 0 && (is_letter(text[i - 1]) || is_digit(text[i - 1]) || text[i - 1] == ')');
    if (raised || (c == '_' && after_letter)) {
      const std::string_view power = exponent(text, i, end);
      if (!power.empty() && (raised || end == text.size() || !is_letter(text[end]))) {
        result += raise(c, power);
        i = end;
        continue;
      }
      end = i;
    }
    if (is_letter(c)) {
      while (end < text.size() && is_letter(text[end])) ++end;
    } else {
      end = i + 1;
    }
    std::string_view word = text.substr(i, end - i);
    if (text.substr(i, 2) == "+-") word = text.substr(i, 2);
    const char* letter = nullptr;
    for (const auto& [name, sign] : greek)
      if (word == name) letter = sign;
    result += letter != nullptr ? letter : escaped(word);
    i += word.size();
  }
  return result;
}

}  // namespace

std::string digits(double value, int count) {
  if (value == 0) return "0";
  std::string text = fmt::format("{:.{}g}", value, count);
  const std::size_t e = text.find('e');
  if (e != std::string::npos) {  // 1e-05 -> 1e-5
    std::size_t first = e + 2;
    while (first + 1 < text.size() && text[first] == '0') text.erase(first, 1);
    if (text[e + 1] == '+') text.erase(e + 1, 1);
  }
  replace(text, "-", "−");
  return text;
}

std::string shown(std::optional<double> value, int count) {
  if (!value) return dash;
  std::string text = digits(*value, count);
  const std::size_t e = text.find('e');
  return e == std::string::npos ? text : text.substr(0, e) + "·10<sup>" + text.substr(e + 1) + "</sup>";
}

std::string shown(const Json& value, int count) {
  if (value.is_number_integer()) {
    std::string text = value.dump();
    replace(text, "-", "−");
    return text;
  }
  return shown(number(value), count);
}

std::string prose(std::string_view text) {
  return typeset(text, [](char sign, std::string_view power) {
    const std::string tag = sign == '^' ? "sup>" : "sub>";
    return "<" + tag + prose(power) + "</" + tag;
  });
}

std::string prose(const Json& value) {
  if (value.is_number()) return shown(value);
  return value.is_string() && !value.get_ref<const std::string&>().empty() ? prose(std::string_view(string(value)))
                                                                           : std::string(dash);
}

std::string exact_number(const Json& value) {
  if (!value.is_string()) return literal(value);
  std::string text = prose(value);
  replace(text, "*", "·");
  replace(text, "sqrt(", "√(");
  replace(text, "-", "−");
  return text;
}

std::string plain(std::string_view text) { return typeset(text, superscript); }

std::string literal(const Json& value) {
  if (value.is_string()) return escaped(string(value));
  if (value.is_number()) return shown(value);
  if (value.is_boolean()) return value.get<bool>() ? "yes" : "no";
  return dash;
}

std::string identifier(std::string_view name) {
  std::string id;
  for (char c : name) {
    const char low = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    if (is_letter(low) || is_digit(low)) {
      id += low;
    } else if (!id.empty() && id.back() != '-') {
      id += '-';
    }
  }
  return id.empty() ? "x" : id;
}

std::string badge(const Json& verdict) {
  static constexpr std::array<std::array<const char*, 3>, 6> known = {{{"proved", "✓", "proved"},
                                                                       {"disproved", "✗", "disproved"},
                                                                       {"evidence-for", "✓", "evidence for"},
                                                                       {"evidence-against", "✗", "evidence against"},
                                                                       {"borderline", "±", "borderline"},
                                                                       {"unknown", "?", "unknown"}}};
  const std::string word = string(verdict);
  for (const auto& [name, sign, says] : known)
    if (word == name)
      return std::string("<span class=\"badge ") + name + "\"><span aria-hidden=\"true\">" + sign + "</span> " + says +
             "</span>";
  return word.empty() ? dash : "<span class=\"badge unknown\">" + prose(word) + "</span>";
}

std::string html(const Table& table) {
  std::string text = "<div class=\"scroll\" tabindex=\"0\" role=\"region\" aria-label=\"" + escaped(table.caption) +
                     "\"><table" + (table.style.empty() ? "" : " class=\"" + table.style + "\"") + ">";
  if (!table.caption.empty()) text += "<caption>" + prose(std::string_view(table.caption)) + "</caption>";
  text += "\n<thead><tr>";
  for (const std::string& head : table.heads) text += "<th scope=\"col\">" + head + "</th>";
  text += "</tr></thead>\n<tbody>\n";
  for (const std::vector<std::string>& row : table.rows) {
    text += "<tr>";
    for (std::size_t i = 0; i < row.size(); ++i)
      text += i == 0 ? "<th scope=\"row\">" + row[i] + "</th>" : "<td>" + row[i] + "</td>";
    text += "</tr>\n";
  }
  return text + "</tbody></table></div>\n";
}

std::string facts(const std::vector<std::pair<std::string, std::string>>& items) {
  std::string text = "<dl class=\"facts\">";
  for (const auto& [term, description] : items)
    if (!description.empty()) text += "<div><dt>" + term + "</dt><dd>" + description + "</dd></div>";
  return text + "</dl>\n";
}

}  // namespace sublimit::page
