// SPDX-License-Identifier: Apache-2.0
#include "sublimit/io/detail/obj_normals.h"

#include <vector>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/error.h"
#include "sublimit/io/detail/gzip.h"
#include "sublimit/io/detail/obj_indices.h"
#include "sublimit/io/detail/text_scanner.h"

namespace sublimit {
namespace {

class ObjNormals {
 public:
  ObjNormals(std::string_view text, std::string_view name)
      : scanner_(text, name, TextScanner::Continuation::backslash) {}

  Points read() {
    while (scanner_.next_line()) {
      const std::string_view keyword = scanner_.token();
      if (keyword == "v") {
        ++num_vertices_;
      } else if (keyword == "vn") {
        for (const char* const what : {"normal x", "normal y", "normal z"})
          values_.push_back(scanner_.finite(scanner_.token(), what));
      } else if (keyword == "f") {
        for (std::string_view token; !(token = scanner_.token()).empty();) read_corner(token);
      }
    }
    return normals();
  }

 private:
  struct Corner {
    Index vertex, normal;  ///< normal -1: none
    std::int64_t line;
  };

  std::int64_t count() const { return std::int64_t(values_.size() / 3); }

  void read_corner(std::string_view token) {
    const std::size_t first = token.find('/'),
                      second = first == std::string_view::npos ? first : token.find('/', first + 1);
    Corner corner{vertices_.read(scanner_, token.substr(0, first), num_vertices_), -1, scanner_.line()};
    if (second != std::string_view::npos && second + 1 < token.size()) {
      corner.normal = normals_.read(scanner_, token.substr(second + 1), count());
      has_normals_ = true;
    }
    corners_.push_back(corner);
  }

  Points normals() const {
    if (count() == 0 && !has_normals_) return Points(0, 3);
    if (!has_normals_)
      throw InvalidMesh(scanner_.name() + ": " + format_number(count()) +
                        " normals (vn) that no face names; corners name them as a//c or a/b/c");
    const Index size = checked_index(num_vertices_, scanner_.name(), "vertices");
    vertices_.check(scanner_, size);
    normals_.check(scanner_, count());
    const Eigen::Map<const Points> values(values_.data(), count(), 3);
    Points result = Points::Zero(size, 3);
    std::vector<const Corner*> named(static_cast<std::size_t>(size), nullptr);
    for (const Corner& corner : corners_) {
      const std::string vertex = "vertex " + format_number(corner.vertex);
      if (corner.normal < 0)
        throw InvalidMesh(scanner_.place(corner.line) + "a corner at " + vertex +
                          " without a normal, which others have; corners name them as a//c or a/b/c");
      const Corner*& before = named[static_cast<std::size_t>(corner.vertex)];
      if (before && values.row(before->normal) != values.row(corner.normal))
        throw InvalidMesh(scanner_.place(corner.line) + vertex + " has another normal here, vn " +
                          format_number(corner.normal + 1) + ", than in line " + format_number(before->line) + ", vn " +
                          format_number(before->normal + 1) + "; one for each vertex is needed");
      if (before) continue;
      before = &corner;
      result.row(corner.vertex) = values.row(corner.normal);
    }
    return result;
  }

  TextScanner scanner_;
  std::int64_t num_vertices_ = 0;
  std::vector<double> values_;
  std::vector<Corner> corners_;
  ObjIndices vertices_{"vertices"}, normals_{"normals"};
  bool has_normals_ = false;
};

}  // namespace

Points read_obj_normals(const std::filesystem::path& path) {
  return parse_obj_normals(read_inflated(path), path.string());
}

Points parse_obj_normals(std::string_view text, std::string_view name) {
  require_text(text, name, "OBJ");
  return ObjNormals(text, name).read();
}

}  // namespace sublimit
