// SPDX-License-Identifier: Apache-2.0
#pragma once
// Text files as lines of tokens, with the line number at hand for every message.
#include <concepts>
#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>

#include "sublimit/core/types.h"

namespace sublimit {

/// A string without a name, which what refers to text does not take.
template <class Text>
concept TemporaryString = std::same_as<std::remove_const_t<Text>, std::string>;

/// Walks over text that outlives it. Blanks separate tokens; '#' starts a comment; lines end with LF, CRLF or CR.
class TextScanner {
 public:
  enum class Continuation {
    none,
    backslash,  ///< a backslash at its end joins a line to the next one
  };

  /// @param first_line  number of the first line, of text from the middle of a file
  TextScanner(std::string_view text, std::string_view name, Continuation continuation, std::int64_t first_line = 1);
  template <TemporaryString Text>
  TextScanner(Text&& text, std::string_view name, Continuation continuation, std::int64_t first_line = 1) = delete;

  /// Moves behind the end of this line (at first: to the first line); false at the end of the text.
  bool next_line();
  /// Moves to the next line that has a token; false at the end of the text.
  bool next_filled_line();
  /// Returns the next token of this line; empty at its end.
  std::string_view token();

  std::int64_t line() const { return line_; }
  /// Returns the bytes that are not yet read.
  std::int64_t rest() const { return end_ - here_; }
  /// Bytes that are read.
  std::int64_t offset() const { return here_ - begin_; }
  const std::string& name() const { return name_; }

  /// "NAME:LINE: " of the current line, or of any.
  std::string place() const { return place(line_); }
  std::string place(std::int64_t line) const;

  /// Returns the number that `token` spells.
  /// @param what  the expected thing, for the message: "a coordinate"
  /// @throws FormatError  a token that is not a number
  double real(std::string_view token, std::string_view what) const;
  float real_float(std::string_view token, std::string_view what) const;
  std::int64_t integer(std::string_view token, std::string_view what) const;
  /// Returns the number that `real` returns.
  /// @throws InvalidMesh  an infinite number, or not a number
  double finite(std::string_view token, std::string_view what) const;

 private:
  template <class T>
  T number(std::string_view token, std::string_view what) const;
  bool at_continuation() const;
  void skip_line_end();

  const char* begin_;
  const char* here_;
  const char* end_;
  std::string name_;
  bool continued_;
  bool started_ = false;
  std::int64_t line_;
};

/// A token as messages show it: in quotes, shortened, with unprintable bytes as hexadecimal numbers.
std::string in_quotes(std::string_view token);

/// @throws FormatError    empty text, or text with NUL bytes ("not a text OBJ file")
void require_text(std::string_view text, std::string_view name, std::string_view format);

/// Returns a count as an index.
/// @throws ResourceError  more than 32-bit indices can count; `what` are they ("vertices")
Index checked_index(std::int64_t count, std::string_view name, std::string_view what);

}  // namespace sublimit
