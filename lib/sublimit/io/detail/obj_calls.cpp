// SPDX-License-Identifier: Apache-2.0
#include "sublimit/io/detail/obj_calls.h"

#include <algorithm>
#include <utility>

#include "sublimit/base/detail/memory.h"
#include "sublimit/base/detail/standard_files.h"
#include "sublimit/base/error.h"
#include "sublimit/io/detail/gzip.h"
#include "sublimit/io/detail/obj_names.h"

namespace sublimit {
namespace {

namespace fs = std::filesystem;

/// Where a statement `call` begins in a text, from a position on; npos if there is none.
size_t find_call(std::string_view text, size_t from) {
  for (size_t at = from; (at = text.find("call", at)) != std::string_view::npos; ++at) {
    size_t begin = at;
    while (begin > 0 && (text[begin - 1] == ' ' || text[begin - 1] == '\t')) --begin;
    const bool first = begin == 0 || text[begin - 1] == '\n' || text[begin - 1] == '\r';
    const bool whole =
        at + 4 == text.size() || std::string_view(" \t\r\n").find(text[at + 4]) != std::string_view::npos;
    if (first && whole) return at;
  }
  return std::string_view::npos;
}

class Caller {
 public:
  CalledText take(const std::string& text, const fs::path& path) {
    add(text, path);
    return std::move(result_);
  }

 private:
  void add(std::string_view text, const fs::path& path) {
    open_.push_back(fs::weakly_canonical(path));
    TextScanner scanner(text, path.string(), TextScanner::Continuation::backslash);
    size_t done = 0;
    begin_lines(path, 1);
    while (scanner.next_line()) {
      const auto line = scanner.line();
      if (scanner.token() != "call") continue;
      const std::string name = rest_of_line(scanner);  // to the end of the line
      const size_t end = std::min(text.find_first_of("\r\n", static_cast<size_t>(scanner.offset())), text.size());
      const size_t begin = find_call(text, done);
      put(text.substr(done, begin - done));
      call(path, name, scanner.place(line));
      begin_lines(path, scanner.line());
      done = end;
    }
    put(text.substr(done));
    open_.pop_back();
  }

  void call(const fs::path& from, const std::string& name, const std::string& place) {
    fs::path path = directory_of_names_in(from) / name;
    std::error_code failed;
    if (name.empty()) {
      result_.warnings.push_back(place + "call left out: it names no file");
      return;
    }
    if (fs::is_directory(path, failed)) {
      result_.warnings.push_back(place + "call of " + in_quotes(name) + " left out: it is a directory");
      return;
    }
    if (!fs::is_regular_file(path, failed) && name.find(' ') != std::string::npos) {
      result_.warnings.push_back(place + "call of " + in_quotes(name) +
                                 " left out: arguments of calls are not understood");
      return;
    }
    if (!fs::is_regular_file(path, failed)) {
      result_.warnings.push_back(place + "call of " + in_quotes(name) + " left out: there is no such file");
      return;
    }
    if (std::ranges::find(open_, fs::weakly_canonical(path)) != open_.end())
      throw FormatError(place + "call of " + in_quotes(name) +
                        ", which is being read: files call each other in a circle");
    constexpr int most = 1000;  // files that call others twice each would be read without end
    if (++calls_ > most)
      throw FormatError(place + "call of " + in_quotes(name) + ": more than " + std::to_string(most) +
                        " calls; put the lines into one file");
    const std::string text = read_inflated(path);
    require_text(text, path.string(), "OBJ");
    check_memory(path.string() + " and the files that call it", 2.0 * double(result_.text.size() + text.size()),
                 "call fewer files");
    add(text, path);
    if (!text.ends_with('\n') && !text.ends_with('\r')) put("\n");
  }

  void put(std::string_view text) {
    for (size_t i = 0; i < text.size(); ++i)
      lines_ += text[i] == '\n' || (text[i] == '\r' && (i + 1 == text.size() || text[i + 1] != '\n'));
    result_.text += text;
  }
  /// Begins lines of a file: `put` adds them from here on.
  void begin_lines(const fs::path& path, std::int64_t line) {
    result_.origins.push_back({lines_ + 1, path.string(), line});
  }

  CalledText result_;
  std::int64_t lines_ = 0;  // complete ones
  std::vector<fs::path> open_;
  int calls_ = 0;
};

}  // namespace

CalledText with_called_files(std::string text, const fs::path& path) {
  if (find_call(text, 0) == std::string::npos) return {std::move(text), {}, {}};
  return Caller().take(text, path);
}

}  // namespace sublimit
