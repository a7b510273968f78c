// SPDX-License-Identifier: Apache-2.0
#include "sublimit/io/detail/usd_values.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <limits>
#include <system_error>
#include <type_traits>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/error.h"
#include "sublimit/io/detail/text_scanner.h"

namespace sublimit {
namespace {

[[noreturn]] void fail(const UsdLayer& layer, std::string_view at, const std::string& what) {
  throw FormatError(layer.place(at) + what);
}

/// The place behind blanks, commas and comments.
std::size_t skip_between(std::string_view text, std::size_t at) {
  while (at < text.size()) {
    const char c = text[at];
    if (c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == ',' || c == ';')
      ++at;
    else if (c == '#')
      at = std::min(text.find('\n', at), text.size());
    else
      break;
  }
  return at;
}

/// Walks over the numbers of a value: each(text of the number) returns its length, 0 if it is none.
template <class Each>
void walk_numbers(const UsdLayer& layer, std::string_view value, std::string_view what, int width, const Each& each) {
  const auto name = [&] { return std::string(what) + ": "; };
  std::size_t at = skip_between(value, 0);
  const bool is_list = value.substr(at, 1) == "[";
  if (is_list) ++at;
  int open = 0, numbers = 0;
  for (at = skip_between(value, at); at < value.size(); at = skip_between(value, at)) {
    const char c = value[at];
    if (c == '(' && width > 1) {
      if (open++ == 0) numbers = 0;
      ++at;
    } else if (c == ')' && open > 0) {
      if (--open == 0 && numbers != width)
        fail(layer, value.substr(at),
             name() + "a value has " + format_number(numbers) + " numbers; it should have " + format_number(width));
      ++at;
    } else if (c == ']' && is_list) {
      break;
    } else {
      if (width > 1 && open == 0)
        fail(layer, value.substr(at),
             name() + "values should be in parentheses, " + format_number(width) + " numbers each");
      const std::size_t length = each(value.substr(at));
      if (length == 0) {
        const std::size_t end = std::min(value.find_first_of(" \t\r\n,;()[]", at + 1), value.size());
        fail(layer, value.substr(at), name() + in_quotes(value.substr(at, end - at)) + " is not a number");
      }
      ++numbers;
      at += length;
    }
  }
}

template <class T>
std::size_t read_number(std::string_view text, T& number) {
  const std::size_t sign = text.starts_with('+') ? 1 : 0;
  const auto [end, error] = std::from_chars(text.data() + sign, text.data() + text.size(), number);
  const auto length = static_cast<std::size_t>(end - text.data());
  if constexpr (std::is_same_v<T, double>) {
    // Beyond the range of a double the nearest one is infinite or 0.
    const std::string_view word = text.substr(0, length);
    const bool tiny = word.find("e-") != std::string_view::npos || word.find("E-") != std::string_view::npos ||
                      word.find_first_of("eE") == std::string_view::npos;
    if (error == std::errc::result_out_of_range)
      number = (word[0] == '-' ? -1 : 1) * (tiny ? 0 : std::numeric_limits<double>::infinity());
    else if (error != std::errc())
      return 0;
  } else if (error != std::errc()) {
    return 0;
  }
  if (length < text.size() && (std::isalnum(static_cast<unsigned char>(text[length])) || text[length] == '_')) return 0;
  return length;
}

/// The text in quotes without them.
std::string unquoted(std::string_view text) {
  const std::size_t marks = text.size() >= 6 && text.substr(0, 3) == std::string(3, text[0]) ? 3 : 1;
  std::string out;
  for (std::size_t i = marks; i + marks < text.size(); ++i) {
    char c = text[i];
    if (c == '\\' && i + 1 + marks < text.size()) {
      c = text[++i];
      if (c == 'n') c = '\n';
      if (c == 't') c = '\t';
      if (c == 'r') c = '\r';
    }
    out += c;
  }
  return out;
}

}  // namespace

std::optional<UsdType> usd_type(std::string_view name) {
  UsdType type;
  type.is_array = name.ends_with(']');
  name = name.substr(0, std::min(name.find('['), name.size()));
  while (name.ends_with(' ')) name.remove_suffix(1);
  const auto word = [&](std::string_view wanted, ValueType numbers) {
    if (name != wanted) return false;
    type.numbers = numbers;
    return true;
  };
  if (word("float", ValueType::float32) || word("half", ValueType::float32) || word("double", ValueType::float64) ||
      word("int", ValueType::int32) || word("uint", ValueType::uint32) || word("uchar", ValueType::uint8))
    return type;
  if (name.size() < 2) return std::nullopt;
  const bool is_float =
      name.starts_with("float") || name.starts_with("half") || name.ends_with('f') || name.ends_with('h');
  type.numbers = is_float ? ValueType::float32 : ValueType::float64;
  if (name == "quatf" || name == "quatd" || name == "quath") {
    type.width = 4;
    return type;
  }
  const std::size_t digit = name.find_first_of("234");
  if (digit == std::string_view::npos || digit + 2 < name.size()) return std::nullopt;
  const std::string_view base = name.substr(0, digit), suffix = name.substr(digit + 1);
  const int n = name[digit] - '0';
  type.width = n;
  if (base == "int" && suffix.empty()) {
    type.numbers = ValueType::int32;
    return type;
  }
  if (base == "matrix" && suffix == "d") {
    type.width = n * n;
    return type;
  }
  const bool plain = (base == "float" || base == "double" || base == "half") && suffix.empty();
  const bool role =
      (base == "point" || base == "normal" || base == "vector" || base == "color" || base == "texCoord") &&
      (suffix == "f" || suffix == "d" || suffix == "h");
  if (!plain && !role) return std::nullopt;
  return type;
}

std::vector<double> usd_numbers(const UsdLayer& layer, std::string_view value, std::string_view what, int width) {
  std::vector<double> numbers;
  if (is_blocked(value)) return numbers;
  walk_numbers(layer, value, what, width, [&](std::string_view text) {
    double number = 0;
    const std::size_t length = read_number(text, number);
    if (length > 0) numbers.push_back(number);
    return length;
  });
  return numbers;
}

std::vector<Index> usd_indices(const UsdLayer& layer, std::string_view value, std::string_view what, Index least,
                               Index most) {
  std::vector<Index> numbers;
  if (is_blocked(value)) return numbers;
  walk_numbers(layer, value, what, 1, [&](std::string_view text) {
    std::int64_t number = 0;
    const std::size_t length = read_number(text, number);
    if (length == 0) return length;
    if (number < least || number > most)
      fail(layer, text,
           std::string(what) + ": entry " + format_number(numbers.size()) + " is " + format_number(number) +
               "; it should be " +
               (most < least ? "absent, as there is nothing that it could name"
                             : "from " + format_number(least) + " to " + format_number(most)));
    numbers.push_back(static_cast<Index>(number));
    return length;
  });
  return numbers;
}

std::vector<std::string> usd_texts(const UsdLayer& layer, std::string_view value, std::string_view what) {
  std::vector<std::string> texts;
  if (is_blocked(value)) return texts;
  for (std::size_t at = value.starts_with('[') ? 1 : 0; (at = skip_between(value, at)) < value.size();) {
    if (value[at] == ']') break;
    const std::size_t end = end_of_usd_value(value, at);
    if ((value[at] != '"' && value[at] != '\'') || end == std::string_view::npos)
      fail(layer, value.substr(at), std::string(what) + ": a text in quotes should be here");
    texts.push_back(unquoted(value.substr(at, end - at)));
    at = end;
  }
  return texts;
}

std::vector<std::string> usd_paths(std::string_view value) {
  std::vector<std::string> paths;
  for (std::size_t at = value.find('<'); at != std::string_view::npos; at = value.find('<', at)) {
    const std::size_t end = value.find('>', at);
    if (end == std::string_view::npos) break;
    paths.emplace_back(value.substr(at + 1, end - at - 1));
    at = end;
  }
  return paths;
}

std::vector<std::pair<std::string, std::string_view>> usd_dictionary(std::string_view value) {
  std::vector<std::pair<std::string, std::string_view>> entries;
  for (std::size_t at = value.find('{') + 1; (at = skip_between(value, at)) < value.size() && value[at] != '}';) {
    // TYPE NAME = VALUE: the name is the word before '='.
    std::string name;
    while (at < value.size() && value[at] != '=' && value[at] != '}') {
      const std::size_t end = end_of_usd_value(value, at);
      if (end == std::string_view::npos || end == at) return entries;
      const std::string_view word = value.substr(at, end - at);
      name = word[0] == '"' || word[0] == '\'' ? unquoted(word) : std::string(word);
      at = skip_between(value, end);
    }
    if (at >= value.size() || value[at] != '=') break;
    at = skip_between(value, at + 1);
    const std::size_t end = end_of_usd_value(value, at);
    if (end == std::string_view::npos || end == at) break;
    entries.emplace_back(std::move(name), value.substr(at, end - at));
    at = end;
  }
  return entries;
}

std::vector<UsdReference> usd_references(std::string_view value) {
  std::vector<UsdReference> references;
  if (is_blocked(value)) return references;
  for (std::size_t at = value.starts_with('[') ? 1 : 0; (at = skip_between(value, at)) < value.size();) {
    const std::size_t end = end_of_usd_value(value, at);
    if (end == std::string_view::npos || end == at) break;  // ']'
    const std::string_view part = value.substr(at, end - at);
    if (part[0] == '@') {
      const std::size_t marks = part.starts_with("@@@") ? 3 : 1;
      references.push_back({.file = std::string(part.substr(marks, part.size() - 2 * marks)), .text = part});
    } else if (part[0] == '<') {
      const bool continues = !references.empty() && references.back().path.empty() &&
                             value.substr(0, at).find_last_not_of(" \t\r\n") != std::string_view::npos &&
                             value[value.substr(0, at).find_last_not_of(" \t\r\n")] == '@';
      if (!continues) references.push_back({.text = part});
      references.back().path = std::string(part.substr(1, part.size() - 2));
    } else if (part[0] == '(' && !references.empty()) {
      references.back().moved_in_time = part.find('=') != std::string_view::npos;
    }
    at = end;
  }
  return references;
}

std::vector<std::pair<double, std::string_view>> usd_samples(const UsdLayer& layer, std::string_view value,
                                                             std::string_view what) {
  std::vector<std::pair<double, std::string_view>> samples;
  if (is_blocked(value)) return samples;
  if (!value.starts_with('{')) fail(layer, value, std::string(what) + ": samples in time should be in braces");
  for (std::size_t at = 1; (at = skip_between(value, at)) < value.size() && value[at] != '}';) {
    double time = 0;
    const std::size_t length = read_number(value.substr(at), time);
    if (length == 0 || !std::isfinite(time))
      fail(layer, value.substr(at), std::string(what) + ": a time should be here, 'TIME: value'");
    std::size_t begin = skip_between(value, at + length);
    if (value.substr(begin, 1) != ":")
      fail(layer, value.substr(std::min(begin, value.size())), std::string(what) + ": ':' should follow a time");
    begin = skip_between(value, begin + 1);
    const std::size_t end = end_of_usd_value(value, begin);
    if (end == std::string_view::npos || end == begin)
      fail(layer, value.substr(begin), std::string(what) + ": a value should follow");
    samples.emplace_back(time, value.substr(begin, end - begin));
    at = end;
  }
  std::ranges::stable_sort(samples, {}, [](const auto& sample) { return sample.first; });
  return samples;
}

}  // namespace sublimit
