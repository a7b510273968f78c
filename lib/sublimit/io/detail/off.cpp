// SPDX-License-Identifier: Apache-2.0
#include "sublimit/io/detail/off.h"

#include <array>
#include <exception>
#include <string>
#include <utility>
#include <vector>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/error.h"
#include "sublimit/io/detail/gzip.h"
#include "sublimit/io/detail/off_colours.h"
#include "sublimit/io/detail/text_scanner.h"

namespace sublimit {
namespace {

/// Values at vertices that are texture coordinates, as in a PLY file.
constexpr std::array<const char*, 2> texture_names{"s", "t"};

class OffReader {
 public:
  OffReader(std::string_view text, std::string_view name) : scanner_(text, name, TextScanner::Continuation::none) {}

  Mesh read() {
    read_header();
    read_counts();
    find_layout();
    mesh_.positions.resize(num_vertices_, 3);
    for (Index v = 0; v < num_vertices_; ++v) read_vertex(v);
    read_faces();
    if (scanner_.next_filled_line()) {
      mesh_.warnings.push_back(scanner_.place() + "lines behind the last face ignored");
    }
    vertex_colours_.finish(scanner_, mesh_.vertex_values, mesh_.warnings);
    face_colours_.finish(scanner_, mesh_.face_values, mesh_.warnings);
    if (keyword_.normals)
      mesh_.notes.push_back(scanner_.name() + ": normals of vertices left out; those of the surface are used instead");
    if (keyword_.texture)
      for (std::size_t i = 0; i < 2; ++i)
        mesh_.vertex_values.push_back({texture_names[i], std::move(texture_[i]), ValueType::float64});
    return std::move(mesh_);
  }

 private:
  void read_header() {
    const std::string_view word = scanner_.token_of_any_line();
    const std::optional<OffKeyword> keyword = parse_off_keyword(word);
    if (!keyword)
      throw FormatError(scanner_.place() + "the file starts with " + in_quotes(word) +
                        "; an OFF file starts with 'OFF'");
    if (keyword->other_dimension)
      throw FormatError(scanner_.place() + in_quotes(word) +
                        " has points of other than 3 dimensions; 'OFF' can be read");
    keyword_ = *keyword;
  }

  void read_counts() {
    // The shortest rows are "0 0 0" and "3 0 0 0": a file too short for its counts shows before memory is taken.
    num_vertices_ = read_count(keyword_.count.empty() ? scanner_.token_of_any_line() : keyword_.count, "vertices", 6);
    num_faces_ = read_count(scanner_.token_of_any_line(), "faces", 8);
    if (num_vertices_ == 0) throw InvalidMesh(scanner_.place() + "no vertices; a mesh should have some");
    if (num_faces_ == 0) throw InvalidMesh(scanner_.place() + "no faces; a mesh should have some");
    // The number of edges is never used. Some files do not have it: alone on a line it is no vertex.
    std::string_view edges = scanner_.token();
    if (edges.empty() && words_ahead(scanner_) == 1) edges = scanner_.token_of_any_line();
    if (!edges.empty()) scanner_.integer(edges, "number of edges");
  }

  Index read_count(std::string_view token, const char* what, std::int64_t shortest) const {
    if (token == "BINARY") throw FormatError(scanner_.place() + "binary OFF; only text can be read");
    const std::int64_t count = scanner_.integer(token, std::string("number of ") + what);
    if (count < 0 || count > (scanner_.rest() + 1) / shortest) {
      throw FormatError(scanner_.place() + format_number(count) + " " + what + " cannot be in the " +
                        format_number(scanner_.rest()) + " bytes that follow");
    }
    return checked_index(count, scanner_.name(), what);
  }

  /// Counts the words of the next line that has some, and moves there.
  static std::size_t next_words(TextScanner& scanner) {
    std::size_t count = 0;
    if (scanner.next_filled_line())
      while (!scanner.token().empty()) ++count;
    return count;
  }
  static std::size_t words_ahead(TextScanner scanner) { return next_words(scanner); }

  /// Finds whether each vertex is a line, which may then have numbers that the keyword does not announce, and how many
  /// numbers a colour has.
  void find_layout() {
    const std::size_t others = 3 + (keyword_.normals ? 3u : 0u) + (keyword_.texture ? 2u : 0u);
    const std::size_t least = others + (keyword_.colours ? 3 : 0);
    TextScanner ahead = scanner_;
    if (!ahead.token().empty()) return;  // the first vertex is on the line of the counts
    const std::size_t words = next_words(ahead);
    if (words <= least) return;
    by_line_ = true;
    for (Index v = 1; v < num_vertices_ && by_line_; ++v) by_line_ = next_words(ahead) == words;
    if (!by_line_) return;
    if (keyword_.colours) colour_size_ = 4;
    if (words > others + colour_size_)
      mesh_.warnings.push_back(scanner_.place(scanner_.line() + 1) + "vertices of " + format_number(words) +
                               " numbers; those that the keyword does not announce are ignored");
  }

  /// Without a layout by lines: three numbers of the first colour are read; is there a fourth one?
  std::size_t guess_colour_size() const {
    TextScanner ahead = scanner_;
    std::size_t rest = 0;
    while (!ahead.token().empty()) ++rest;
    if (keyword_.texture) return rest == 1 || rest == 3 ? 4 : 3;
    return rest % 6 == 0 ? 3 : 4;  // the line may go on with whole vertices
  }

  std::string_view next(const char* what, Index row, Index count) {
    const std::string_view token = scanner_.token_of_any_line();
    if (!token.empty()) return token;
    throw FormatError(scanner_.place() + "the file ends at " + what + " " + format_number(row) + " of " +
                      format_number(count));
  }

  void read_vertex(Index v) {
    const auto next_word = [&] { return next("vertex", v, num_vertices_); };
    constexpr const char* names[] = {"coordinate x", "coordinate y", "coordinate z"};
    for (Index i = 0; i < 3; ++i) mesh_.positions(v, i) = scanner_.finite(next_word(), names[i]);
    for (int i = 0; keyword_.normals && i < 3; ++i) scanner_.real(next_word(), "number of a normal");
    if (keyword_.colours) {
      words_.clear();
      for (int i = 0; i < 3; ++i) words_.push_back(next_word());
      if (colour_size_ == 0) colour_size_ = guess_colour_size();
      if (colour_size_ == 4) words_.push_back(next_word());
      vertex_colours_.add(scanner_, words_);
    }
    for (std::size_t i = 0; keyword_.texture && i < 2; ++i)
      texture_[i].push_back(scanner_.finite(next_word(), "texture coordinate"));
    if (by_line_)
      for (std::string_view token; !(token = scanner_.token()).empty();) scanner_.real(token, "number at the end");
  }

  /// Reads faces by lines, with the numbers at their ends as colours; if the file then ends too early, free of line
  /// ends and without colours.
  void read_faces() {
    const TextScanner first = scanner_;
    try {
      for (Index f = 0; f < num_faces_; ++f) read_face(f);
    } catch (const Error&) {
      if (!has_words_) throw;
      const std::exception_ptr reason = std::current_exception();
      scanner_ = first;
      mesh_.face_sizes.clear();
      mesh_.face_vertices.clear();
      face_colours_ = OffColours("faces");
      faces_by_line_ = false;
      try {
        for (Index f = 0; f < num_faces_; ++f) read_face(f);
      } catch (const Error&) {
        std::rethrow_exception(reason);
      }
      if (!scanner_.token_of_any_line().empty()) std::rethrow_exception(reason);
    }
  }

  void read_face(Index f) {
    const auto next_word = [&] { return next("face", f, num_faces_); };
    const std::int64_t size = scanner_.integer(next_word(), "number of corners");
    if (size < 3) {
      throw InvalidMesh(scanner_.place() + "face " + format_number(f) + " has " + format_number(size) +
                        " corners; it should have at least 3");
    }
    for (std::int64_t i = 0; i < size; ++i) {  // ends with the file at the latest
      const std::int64_t vertex = scanner_.integer(next_word(), "index");
      if (vertex < 0 || vertex >= num_vertices_) {
        throw InvalidMesh(scanner_.place() + "index " + format_number(vertex) + " is out of range; the file has " +
                          format_number(num_vertices_) + " vertices, 0 to " + format_number(num_vertices_ - 1));
      }
      mesh_.face_vertices.push_back(static_cast<Index>(vertex));
    }
    checked_index(std::int64_t(mesh_.face_vertices.size()), scanner_.name(), "corners of faces");
    mesh_.face_sizes.push_back(static_cast<Index>(size));
    if (!faces_by_line_) return;
    words_.clear();
    for (std::string_view token; !(token = scanner_.token()).empty();) words_.push_back(token);
    has_words_ = has_words_ || !words_.empty();
    face_colours_.add(scanner_, words_);
  }

  TextScanner scanner_;
  Mesh mesh_;
  OffKeyword keyword_;
  Index num_vertices_ = 0, num_faces_ = 0;
  bool by_line_ = false, faces_by_line_ = true, has_words_ = false;  // words behind faces
  std::size_t colour_size_ = 0;                                      // of vertices, 0: not known yet
  OffColours vertex_colours_{"vertices"}, face_colours_{"faces"};
  std::array<std::vector<double>, 2> texture_;
  std::vector<std::string_view> words_;
};

}  // namespace

std::optional<OffKeyword> parse_off_keyword(std::string_view word) {
  OffKeyword keyword;
  const auto skip = [&](std::string_view part) {
    if (!word.starts_with(part)) return false;
    word.remove_prefix(part.size());
    return true;
  };
  while (!skip("OFF")) {
    if (skip("ST")) {
      keyword.texture = true;
    } else if (skip("C")) {
      keyword.colours = true;
    } else if (skip("N")) {
      keyword.normals = true;
    } else if (skip("4") || skip("n")) {
      keyword.other_dimension = true;
    } else {
      return std::nullopt;
    }
  }
  if (word.find_first_not_of("0123456789") != std::string_view::npos) return std::nullopt;
  keyword.count = word;
  return keyword;
}

Mesh read_off(const std::filesystem::path& path) { return parse_off(read_inflated(path), path.string()); }

Mesh parse_off(std::string_view text, std::string_view name) {
  // Binary OFF says so in its first line, and a reader of text can only point there.
  const std::string_view head = text.substr(0, text.find('\n'));
  if (head.find("BINARY") == std::string_view::npos) require_text(text, name, "OFF");
  return OffReader(text, name).read();
}

}  // namespace sublimit
