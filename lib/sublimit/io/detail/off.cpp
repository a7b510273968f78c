// SPDX-License-Identifier: Apache-2.0
#include "sublimit/io/detail/off.h"

#include <string>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/detail/read_file.h"
#include "sublimit/base/error.h"
#include "sublimit/io/detail/text_scanner.h"

namespace sublimit {
namespace {

class OffReader {
 public:
  OffReader(std::string_view text, std::string_view name) : scanner_(text, name, TextScanner::Continuation::none) {}

  Mesh read() {
    read_header();
    // The shortest lines are "0 0 0" and "3 0 0 0": a file too short for its counts shows before memory is taken.
    const Index vertices = read_count("vertices", 6);
    num_faces_ = read_count("faces", 8);
    if (const std::string_view edges = scanner_.token(); !edges.empty()) scanner_.integer(edges, "number of edges");
    if (vertices == 0) throw InvalidMesh(scanner_.place() + "no vertices; a mesh should have some");
    if (num_faces_ == 0) throw InvalidMesh(scanner_.place() + "no faces; a mesh should have some");
    mesh_.positions.resize(vertices, 3);
    for (Index v = 0; v < vertices; ++v) read_vertex(v);
    for (Index f = 0; f < num_faces_; ++f) read_face(f);
    if (scanner_.next_filled_line()) {
      mesh_.warnings.push_back(scanner_.place() + "lines behind the last face ignored");
    }
    return std::move(mesh_);
  }

 private:
  void read_header() {
    scanner_.next_filled_line();
    const std::string_view keyword = scanner_.token();
    std::string_view prefix = keyword;
    if (prefix.ends_with("OFF")) {
      prefix.remove_suffix(3);
      if (prefix.starts_with("ST")) prefix.remove_prefix(2);
      if (prefix.starts_with("C")) prefix.remove_prefix(1);
      if (prefix.starts_with("N")) prefix.remove_prefix(1);
      if (prefix.empty()) return;
      if (prefix == "4" || prefix == "n" || prefix == "4n") {
        throw FormatError(scanner_.place() + in_quotes(keyword) +
                          " has points of other than 3 dimensions; 'OFF' can be read");
      }
    }
    throw FormatError(scanner_.place() + "the file starts with " + in_quotes(keyword) +
                      "; an OFF file starts with 'OFF'");
  }

  // Counts may follow the keyword on its line or stand on the next one; that of edges is never used.
  Index read_count(const char* what, std::int64_t shortest) {
    std::string_view token = scanner_.token();
    if (token.empty() && scanner_.next_filled_line()) token = scanner_.token();
    if (token == "BINARY") throw FormatError(scanner_.place() + "binary OFF; only text can be read");
    const std::int64_t count = scanner_.integer(token, std::string("number of ") + what);
    if (count < 0 || count > (scanner_.rest() + 1) / shortest) {
      throw FormatError(scanner_.place() + format_number(count) + " " + what + " cannot be in the " +
                        format_number(scanner_.rest()) + " bytes that follow");
    }
    return checked_index(count, scanner_.name(), what);
  }

  void next_row(const char* what, Index row, Index count) {
    if (scanner_.next_filled_line()) return;
    throw FormatError(scanner_.place() + "the file ends at " + what + " " + format_number(row) + " of " +
                      format_number(count));
  }

  void read_vertex(Index v) {
    next_row("vertex", v, mesh_.num_vertices());
    constexpr const char* names[] = {"coordinate x", "coordinate y", "coordinate z"};
    for (Index i = 0; i < 3; ++i) mesh_.positions(v, i) = scanner_.finite(scanner_.token(), names[i]);
    skip_numbers();
  }

  void read_face(Index f) {
    next_row("face", f, num_faces_);
    const std::int64_t size = scanner_.integer(scanner_.token(), "number of corners");
    if (size < 3) {
      throw InvalidMesh(scanner_.place() + "face " + format_number(f) + " has " + format_number(size) +
                        " corners; it should have at least 3");
    }
    for (std::int64_t i = 0; i < size; ++i) {  // ends with the line at the latest
      const std::int64_t vertex = scanner_.integer(scanner_.token(), "index");
      if (vertex < 0 || vertex >= mesh_.num_vertices()) {
        throw InvalidMesh(scanner_.place() + "index " + format_number(vertex) + " is out of range; the file has " +
                          format_number(mesh_.num_vertices()) + " vertices, 0 to " +
                          format_number(mesh_.num_vertices() - 1));
      }
      mesh_.face_vertices.push_back(static_cast<Index>(vertex));
    }
    checked_index(std::int64_t(mesh_.face_vertices.size()), scanner_.name(), "corners of faces");
    mesh_.face_sizes.push_back(static_cast<Index>(size));
    skip_numbers();
  }

  void skip_numbers() {
    for (std::string_view token; !(token = scanner_.token()).empty();) scanner_.real(token, "number at the end");
  }

  TextScanner scanner_;
  Mesh mesh_;
  Index num_faces_ = 0;
};

}  // namespace

Mesh read_off(const std::filesystem::path& path) { return parse_off(read_file(path), path.string()); }

Mesh parse_off(std::string_view text, std::string_view name) {
  // Binary OFF says so in its first line, and a reader of text can only point there.
  const std::string_view head = text.substr(0, text.find('\n'));
  if (head.find("BINARY") == std::string_view::npos) require_text(text, name, "OFF");
  return OffReader(text, name).read();
}

}  // namespace sublimit
