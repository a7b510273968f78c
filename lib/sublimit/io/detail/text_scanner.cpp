// SPDX-License-Identifier: Apache-2.0
#include "sublimit/io/detail/text_scanner.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <type_traits>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/error.h"

namespace sublimit {
namespace {

// What a byte is to the scanner. Looked up for every byte of a file, hence a table.
enum Kind : unsigned char { letter, blank, line_end, comment, backslash };

constexpr std::array<Kind, 256> make_kinds() {
  std::array<Kind, 256> kinds{};
  for (const char c : {' ', '\t', '\v', '\f'}) kinds[static_cast<unsigned char>(c)] = blank;
  kinds['\n'] = kinds['\r'] = line_end;
  kinds['#'] = comment;
  kinds['\\'] = backslash;
  return kinds;
}
constexpr std::array<Kind, 256> kinds = make_kinds();

Kind kind(char c) { return kinds[static_cast<unsigned char>(c)]; }

}  // namespace

TextScanner::TextScanner(std::string_view text, std::string_view name, Continuation continuation,
                         std::int64_t first_line)
    : begin_(text.data()),
      here_(text.data()),
      end_(text.data() + text.size()),
      name_(name),
      continued_(continuation == Continuation::backslash),
      line_(first_line) {
  if (text.starts_with("\xEF\xBB\xBF")) here_ += 3;  // the byte order mark of UTF-8
}

const char* TextScanner::behind_blanks(const char* at) const {
  return std::find_if(at, end_, [](char c) { return kind(c) != blank; });
}

bool TextScanner::at_continuation() const {
  if (!continued_ || *here_ != '\\') return false;
  const char* const next = behind_blanks(here_ + 1);
  return next == end_ || kind(*next) == line_end;
}

void TextScanner::skip_line_end() { here_ += *here_ == '\r' && here_ + 1 != end_ && here_[1] == '\n' ? 2 : 1; }

void TextScanner::skip_blanks() {
  while (here_ != end_) {
    if (kind(*here_) == blank) {
      ++here_;
    } else if (at_continuation()) {
      here_ = behind_blanks(here_ + 1);
      if (here_ == end_) break;
      skip_line_end();
      ++line_;
    } else {
      break;
    }
  }
}

std::string_view TextScanner::token() {
  skip_blanks();
  const char* const first = here_;
  while (here_ != end_ && (kind(*here_) == letter || (kind(*here_) == backslash && !at_continuation()))) ++here_;
  return {first, static_cast<std::size_t>(here_ - first)};
}

std::string_view TextScanner::name_token() {
  skip_blanks();
  const char* const first = here_;
  if (here_ != end_ && kind(*here_) == comment) return {};
  while (here_ != end_ &&
         (kind(*here_) == letter || kind(*here_) == comment || (kind(*here_) == backslash && !at_continuation())))
    ++here_;
  return {first, static_cast<std::size_t>(here_ - first)};
}

std::string_view TextScanner::token_of_any_line() {
  std::string_view found = started_ ? token() : std::string_view();
  if (found.empty() && next_filled_line()) found = token();
  return found;
}

bool TextScanner::next_line() {
  if (started_) {
    while (!token().empty()) {
    }
    here_ = std::find_if(here_, end_, [](char c) { return kind(c) == line_end; });
    if (here_ == end_) return false;
    skip_line_end();
    ++line_;
  }
  started_ = true;
  return here_ != end_;
}

bool TextScanner::next_filled_line() {
  while (next_line()) {
    const char* const here = here_;
    const std::int64_t line = line_;
    if (token().empty()) continue;
    here_ = here;
    line_ = line;
    return true;
  }
  return false;
}

std::string TextScanner::place(std::int64_t line) const {
  const auto after = std::ranges::find_if(origins_, [&](const Origin& origin) { return origin.first > line; });
  if (after == origins_.begin()) return name_ + ":" + format_number(line) + ": ";
  const Origin& origin = after[-1];
  return origin.name + ":" + format_number(origin.line + line - origin.first) + ": ";
}

template <class T>
T TextScanner::number(std::string_view token, std::string_view what) const {
  const Parsed<T> parsed = parse_number<T>(token);
  if (parsed) return parsed.value;
  const char* const kind = std::is_integral_v<T> ? "an integer" : "a decimal number";
  if (token.empty()) {
    throw FormatError(place() + "the line ends where " + std::string(what) + " should be; add " + kind);
  }
  if (parsed.status == ParseStatus::too_large) {
    throw FormatError(place() + std::string(what) + " " + in_quotes(token) + " is too large; at most " +
                      format_number(std::numeric_limits<T>::max()) + " can be read");
  }
  throw FormatError(place() + std::string(what) + " " + in_quotes(token) + " is not a number; it should be " + kind);
}

double TextScanner::real(std::string_view token, std::string_view what) const { return number<double>(token, what); }
float TextScanner::real_float(std::string_view token, std::string_view what) const {
  return number<float>(token, what);
}
std::int64_t TextScanner::integer(std::string_view token, std::string_view what) const {
  return number<std::int64_t>(token, what);
}

double TextScanner::finite(std::string_view token, std::string_view what) const {
  const double value = number<double>(token, what);
  if (std::isfinite(value)) return value;
  throw InvalidMesh(place() + std::string(what) + " is " + in_quotes(token) + "; it should be a finite number");
}

std::string in_quotes(std::string_view token) {
  constexpr std::size_t longest = 40;
  constexpr char digits[] = "0123456789abcdef";
  std::string text = "'";
  for (const char c : token.substr(0, longest)) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte >= 0x20 && byte < 0x7f) {
      text += c;
    } else {
      text += {'\\', 'x', digits[byte >> 4], digits[byte & 15]};
    }
  }
  return text + (token.size() > longest ? "...'" : "'");
}

void require_text(std::string_view text, std::string_view name, std::string_view format) {
  if (text.empty())
    throw FormatError(std::string(name) + ": the file is empty; a mesh in " + std::string(format) +
                      " format is expected");
  const std::size_t nul = text.find('\0');
  if (nul == std::string_view::npos) return;
  const auto line = 1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(nul), '\n');
  throw FormatError(std::string(name) + ":" + format_number(line) + ": byte " + format_number(nul) +
                    " is zero, so this is not a text " + std::string(format) + " file");
}

Index checked_index(std::int64_t count, std::string_view name, std::string_view what) {
  if (count <= std::numeric_limits<Index>::max()) return static_cast<Index>(count);
  throw ResourceError(std::string(name) + ": " + format_number(count) + " " + std::string(what) +
                      " are more than 32-bit indices can count; split the mesh");
}

}  // namespace sublimit
