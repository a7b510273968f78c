// SPDX-License-Identifier: Apache-2.0
#pragma once
// Numbers as text, independent of the locale: written in the shortest form that reads back to the same bits, and read
// strictly, from the whole of a text or not at all:
//
//   const std::string text = format_number(0.1);                 // "0.1"
//   const Parsed<int> levels = parse_number<int>("12");
//   if (levels) std::cout << levels.value << "\n";               // 12
//   parse_number<float>("1e99").status;                          // ParseStatus::too_large
#include <charconv>
#include <concepts>
#include <cstdint>
#include <string>
#include <string_view>
#include <system_error>
#include <type_traits>

namespace sublimit {

/// Floating and integral types.
template <class T>
concept PlainNumber = std::floating_point<T> || std::integral<T>;

/// Appends the shortest decimal form of `value` that reads back to the same bits ("0.1", "-0", "1e+300", "inf").
template <PlainNumber T>
void append_number(std::string& out, T value) {
  char digits[64];  // the longest double has 24 characters
  const std::to_chars_result end = std::to_chars(digits, digits + sizeof digits, value);
  out.append(digits, end.ptr);
}

/// Returns the shortest decimal form of `value` that reads back to the same bits.
template <PlainNumber T>
std::string format_number(T value) {
  std::string out;
  append_number(out, value);
  return out;
}

/// Outcome of reading a number.
enum class ParseStatus {
  ok,         ///< a number
  malformed,  ///< not a number, or a number with something behind it
  too_large,  ///< a number beyond the range of its type
};

/// A number that was read, true if its status is ok.
template <PlainNumber T>
struct Parsed {
  T value{};                                    ///< 0 unless `status` is ok
  ParseStatus status = ParseStatus::malformed;  ///< outcome
  explicit operator bool() const { return status == ParseStatus::ok; }
};

namespace detail {

/// Returns true if decimal text that is out of range is too close to zero, false if it is too far from it. The power
/// of ten of the first digit that is not zero decides.
inline bool is_tiny(std::string_view text) {
  std::int64_t power = 0;  // power of the first non-zero digit, without the exponent
  bool started = false, fraction = false;
  std::size_t i = 0;
  for (; i < text.size() && text[i] != 'e' && text[i] != 'E'; ++i) {
    if (text[i] == '.') {
      fraction = true;
    } else if (text[i] >= '0' && text[i] <= '9') {
      if (!fraction && started) ++power;
      if (fraction && !started) --power;
      started = started || text[i] != '0';
    }
  }
  std::int64_t exponent = 0;
  if (i < text.size()) {
    std::string_view digits = text.substr(i + 1);
    if (digits.starts_with('+')) digits.remove_prefix(1);
    const std::from_chars_result end = std::from_chars(digits.data(), digits.data() + digits.size(), exponent);
    if (end.ec == std::errc::result_out_of_range) return digits.starts_with('-');
  }
  return exponent < -power;
}

}  // namespace detail

/// Returns the number that the whole of `text` spells. A leading '+' is accepted; blanks, hexadecimal and partial
/// numbers are malformed.
/// @note  "inf" and "nan" are numbers of a floating type; check with `std::isfinite` where these are not wanted.
///        Numbers closer to zero than the smallest of the type are read as zero.
template <PlainNumber T>
Parsed<T> parse_number(std::string_view text) {
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  if (text.empty()) return {};
  Parsed<T> result;
  const char* const last = text.data() + text.size();
  const std::from_chars_result end = std::from_chars(text.data(), last, result.value);
  if (end.ptr != last || end.ec == std::errc::invalid_argument) return {};
  if (end.ec == std::errc::result_out_of_range) {
    if (!std::is_floating_point_v<T> || !detail::is_tiny(text)) return {.value = T{}, .status = ParseStatus::too_large};
    result.value = text[0] == '-' ? -T{} : T{};
  }
  result.status = ParseStatus::ok;
  return result;
}

}  // namespace sublimit
