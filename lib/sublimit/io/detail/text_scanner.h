// SPDX-License-Identifier: Apache-2.0
#pragma once
// Scanner of text files as lines of tokens, with line numbers for messages.
#include <concepts>
#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "sublimit/core/types.h"

namespace sublimit {

/// A temporary string, which functions that keep references to text reject.
template <class Text>
concept TemporaryString = std::same_as<std::remove_const_t<Text>, std::string>;

/// Walks over text that outlives it. Blanks separate tokens; '#' starts a comment; lines end with LF, CRLF or CR.
class TextScanner {
 public:
  enum class Continuation {
    none,
    backslash,  ///< a backslash at the end of a line, or with blanks behind it, joins the line to the next one
  };

  /// @param first_line  number of the first line, for text from the middle of a file
  TextScanner(std::string_view text, std::string_view name, Continuation continuation, std::int64_t first_line = 1);
  template <TemporaryString Text>
  TextScanner(Text&& text, std::string_view name, Continuation continuation, std::int64_t first_line = 1) = delete;

  /// Lines of another file that stand in the text.
  struct Origin {
    std::int64_t first;  ///< the first line in the text, from 1
    std::string name;    ///< the file
    std::int64_t line;   ///< the number of that line there
  };
  /// Tells where lines of the text come from, for messages; each origin holds to the next one.
  void set_origins(std::vector<Origin> origins) { origins_ = std::move(origins); }

  /// Moves to the next line (the first time: to the first line). Returns false at the end of the text.
  bool next_line();
  /// Moves to the next line that has a token. Returns false at the end of the text.
  bool next_filled_line();
  /// Returns the next token of this line; empty at its end.
  std::string_view token();
  /// Returns the same of a name: a '#' inside of it belongs to it.
  std::string_view name_token();
  /// Returns the next token of this line or of those after it; empty at the end of the text.
  std::string_view token_of_any_line();

  std::int64_t line() const { return line_; }
  /// Returns the bytes that are not yet read.
  std::int64_t rest() const { return end_ - here_; }
  /// Returns the number of bytes that have been read.
  std::int64_t offset() const { return here_ - begin_; }
  const std::string& name() const { return name_; }

  /// Returns the prefix of messages, "NAME:LINE: ", for the current line, or for a given one.
  std::string place() const { return place(line_); }
  std::string place(std::int64_t line) const;

  /// Returns the number that a token denotes.
  /// @param what  the expected thing, for the message: "a coordinate"
  /// @throws FormatError  a token that is not a number
  double real(std::string_view token, std::string_view what) const;
  float real_float(std::string_view token, std::string_view what) const;
  std::int64_t integer(std::string_view token, std::string_view what) const;
  /// Returns the number that `real` returns.
  /// @throws InvalidMesh  an infinite number, or NaN
  double finite(std::string_view token, std::string_view what) const;

 private:
  template <class T>
  T number(std::string_view token, std::string_view what) const;
  void skip_blanks();
  const char* behind_blanks(const char* at) const;
  bool at_continuation() const;
  void skip_line_end();

  const char* begin_;
  const char* here_;
  const char* end_;
  std::string name_;
  bool continued_;
  bool started_ = false;
  std::int64_t line_;
  std::vector<Origin> origins_;
};

/// Returns a token for messages: in quotes, shortened, with unprintable bytes as hexadecimal numbers.
std::string in_quotes(std::string_view token);

/// Throws unless bytes are text.
/// @throws FormatError    empty text, or text with NUL bytes ("not a text OBJ file")
void require_text(std::string_view text, std::string_view name, std::string_view format);

/// Returns a count as an index.
/// @param what  name of the elements for the message ("vertices")
/// @throws ResourceError  more than 32-bit indices can count
Index checked_index(std::int64_t count, std::string_view name, std::string_view what);

}  // namespace sublimit
