// SPDX-License-Identifier: Apache-2.0
#include "sublimit/io/detail/stl.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <utility>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/error.h"
#include "sublimit/io/detail/equal_rows.h"
#include "sublimit/io/detail/gzip.h"
#include "sublimit/io/detail/obj_names.h"
#include "sublimit/io/detail/text_scanner.h"

namespace sublimit {
namespace {

constexpr std::size_t header_size = 80, count_size = 4, triangle_size = 50;

/// Words of text in either case.
bool is_word(std::string_view token, std::string_view lower) {
  if (token.size() != lower.size()) return false;
  for (std::size_t i = 0; i < token.size(); ++i)
    if (token[i] != lower[i] && token[i] != lower[i] - 'a' + 'A') return false;
  return true;
}

std::uint32_t load(std::string_view bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) value |= std::uint32_t{static_cast<unsigned char>(bytes[at + i])} << (8 * i);
  return value;
}

/// Triangles whose equal corners become one vertex.
class StlTriangles {
 public:
  using Corners = std::array<EqualRows::Row, 3>;

  explicit StlTriangles(std::string_view name) : name_(name) {}

  /// Adds the next triangle of the file. Returns false if it was left out.
  bool add(const Corners& corners) {
    const std::int64_t number = count_++;
    if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0]) {
      if (degenerate_++ == 0) first_degenerate_ = number;
      return false;
    }
    for (const EqualRows::Row& corner : corners) mesh.face_vertices.push_back(rows_.add(corner));
    checked_index(std::ssize(mesh.face_vertices), name_, "corners of triangles");
    return true;
  }
  std::int64_t count() const { return count_; }

  Mesh finish() {
    if (mesh.face_vertices.empty()) throw InvalidMesh(name_ + ": no triangles; a mesh should have some");
    const std::vector<EqualRows::Row>& rows = rows_.rows();
    mesh.face_sizes.assign(mesh.face_vertices.size() / 3, 3);
    mesh.positions.resize(std::ssize(rows), 3);
    for (std::size_t v = 0; v < rows.size(); ++v)
      for (std::size_t i = 0; i < 3; ++i) mesh.positions(Eigen::Index(v), Eigen::Index(i)) = rows[v][i];
    mesh.notes.push_back(name_ + ": welded " + format_number(mesh.face_vertices.size()) + " corners to " +
                         format_number(rows.size()) + " vertices");
    if (degenerate_ > 0)
      mesh.warnings.push_back(name_ + ": " + format_number(degenerate_) + " of " + format_number(count_) +
                              " triangles have two equal corners and are left out; the first is number " +
                              format_number(first_degenerate_));
    return std::move(mesh);
  }

  Mesh mesh;

 private:
  std::string name_;
  EqualRows rows_;
  std::int64_t count_ = 0, degenerate_ = 0, first_degenerate_ = 0;
};

Mesh read_binary(std::string_view bytes, std::string_view name) {
  const std::string file(name);
  if (bytes.size() < header_size + count_size)
    throw FormatError(file + ": " + format_number(bytes.size()) +
                      " bytes are no STL file; text begins with 'solid', and a binary file has 84 bytes at least");
  const std::size_t count = load(bytes, header_size), room = bytes.size() - header_size - count_size;
  if (count > room / triangle_size)
    throw FormatError(file + ": " + format_number(count) + " triangles cannot be in the " + format_number(room) +
                      " bytes that follow; each has 50, or as text the file should begin with 'solid'");
  StlTriangles triangles(name);
  for (std::size_t t = 0; t < count; ++t) {
    StlTriangles::Corners corners;
    std::size_t at = header_size + count_size + t * triangle_size + 12;  // behind the normal
    for (EqualRows::Row& corner : corners)
      for (double& x : corner) {
        x = std::bit_cast<float>(load(bytes, at));
        if (!std::isfinite(x))
          throw InvalidMesh(file + ": byte " + format_number(at) + ": a coordinate of triangle " + format_number(t) +
                            " is " + format_number(x) + "; it should be a finite number");
        at += 4;
      }
    triangles.add(corners);
  }
  if (room > count * triangle_size)
    triangles.mesh.warnings.push_back(file + ": byte " +
                                      format_number(header_size + count_size + count * triangle_size) +
                                      ": data behind the last triangle ignored");
  return triangles.finish();
}

/// solid NAME, then facets of three vertices, endsolid NAME; free of line ends but for the names.
class StlTextReader {
 public:
  StlTextReader(std::string_view text, std::string_view name)
      : scanner_(text, name, TextScanner::Continuation::none), triangles_(name) {}

  Mesh read() {
    for (std::string_view word; !(word = scanner_.token_of_any_line()).empty();) {
      if (is_word(word, "solid")) {
        read_name();
      } else if (is_word(word, "facet")) {
        read_facet();
      } else if (is_word(word, "endsolid")) {
        rest_of_line(scanner_);
      } else {
        fail("unexpected " + in_quotes(word) + "; 'facet', 'endsolid' or another 'solid' should be here");
      }
    }
    return triangles_.finish();
  }

 private:
  [[noreturn]] void fail(const std::string& what) const { throw FormatError(scanner_.place() + what); }

  void read_name() {
    std::string words = rest_of_line(scanner_);
    while (words.ends_with('\\') || words.ends_with(' ')) words.pop_back();  // no name of an OBJ ends so
    names_.set(std::move(words), triangles_.mesh.objects);
  }

  void expect(std::string_view word) {
    const std::string_view token = scanner_.token_of_any_line();
    if (is_word(token, word)) return;
    const std::string where = " where '" + std::string(word) + "' of triangle " + format_number(triangles_.count());
    if (token.empty()) fail("the file ends" + where + " should be");
    fail(in_quotes(token) + where + " should be");
  }

  void read_facet() {
    expect("normal");
    for (int i = 0; i < 3; ++i) scanner_.real(scanner_.token_of_any_line(), "number of a normal");
    expect("outer");
    expect("loop");
    StlTriangles::Corners corners;
    for (EqualRows::Row& corner : corners) {
      expect("vertex");
      constexpr const char* names[] = {"coordinate x", "coordinate y", "coordinate z"};
      for (std::size_t i = 0; i < 3; ++i) corner[i] = scanner_.finite(scanner_.token_of_any_line(), names[i]);
    }
    expect("endloop");
    expect("endfacet");
    if (!triangles_.add(corners)) return;
    names_.add_face(triangles_.mesh.face_vertices.size() / 3 - 1, triangles_.mesh.objects);
  }

  TextScanner scanner_;
  StlTriangles triangles_;
  ObjNames names_;
};

}  // namespace

bool is_binary_stl(std::string_view bytes) {
  return bytes.size() >= header_size + count_size &&
         bytes.size() == header_size + count_size + triangle_size * std::size_t{load(bytes, header_size)};
}

Mesh read_stl(const std::filesystem::path& path) { return parse_stl(read_inflated(path), path.string()); }

Mesh parse_stl(std::string_view bytes, std::string_view name) {
  if (bytes.empty()) throw FormatError(std::string(name) + ": the file is empty; an STL mesh is expected");
  TextScanner scanner(bytes, name, TextScanner::Continuation::none);
  const bool is_text =
      is_word(scanner.token_of_any_line(), "solid") && bytes.substr(0, 512).find('\0') == std::string_view::npos;
  if (is_binary_stl(bytes) || !is_text) return read_binary(bytes, name);
  require_text(bytes, name, "STL");
  return StlTextReader(bytes, name).read();
}

}  // namespace sublimit
