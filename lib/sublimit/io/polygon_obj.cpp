// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "sublimit/base/detail/atomic_file.h"
#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/detail/read_file.h"
#include "sublimit/base/detail/standard_files.h"
#include "sublimit/base/error.h"
#include "sublimit/io/detail/formats.h"
#include "sublimit/io/detail/gzip.h"
#include "sublimit/io/detail/obj_indices.h"
#include "sublimit/io/detail/obj_keywords.h"
#include "sublimit/io/detail/polygon_files.h"
#include "sublimit/io/detail/text_scanner.h"

namespace sublimit {
namespace {

class ObjCurveReader {
 public:
  ObjCurveReader(std::string_view text, std::string_view name)
      : scanner_(text, name, TextScanner::Continuation::backslash) {}

  ControlPolygon read() {
    while (scanner_.next_line()) {
      const std::string_view keyword = scanner_.token();
      if (keyword == "v") {
        for (const char* const what : {"coordinate x", "coordinate y", "coordinate z"})
          coordinates_.push_back(scanner_.finite(scanner_.token(), what));
        for (std::string_view token; !(token = scanner_.token()).empty();)
          scanner_.real(token, "number behind a point");
      } else if (keyword == "l") {
        read_curve();
      } else if (!elements_.count(scanner_, keyword) &&
                 !std::ranges::all_of(keyword, [](char c) { return c >= 0x20 && c < 0x7f; })) {
        throw FormatError(scanner_.place() + "the line starts with " + in_quotes(keyword) +
                          ", so this is not a text OBJ file");
      }
    }
    const Index count = checked_index(std::int64_t(coordinates_.size() / 3), scanner_.name(), "points");
    const std::int64_t faces = elements_.faces;
    if (polygon_.curves.empty() && elements_.has_free_form())
      throw InvalidMesh(scanner_.place(elements_.first_free_form) + "the file holds " + elements_.free_form() +
                        ", which are free-form statements, and no polygons; a polygon is a line 'l 1 2 3 ...' through "
                        "vertices");
    if (polygon_.curves.empty())
      throw InvalidMesh(scanner_.name() +
                        (faces > 0 ? ": a mesh of " + counted(faces, "face") + " and no curves" : ": no curves") +
                        "; a curve is a line 'l 1 2 3 ...' through vertices" +
                        (faces > 0 ? ", and faces are for surface schemes such as catmull-clark" : ""));
    if (faces > 0)
      polygon_.warnings.push_back(scanner_.name() + ": " + format_number(faces) +
                                  " faces left out; curve schemes refine lines");
    if (elements_.has_free_form())
      polygon_.warnings.push_back(scanner_.place(elements_.first_free_form) + "the file also holds " +
                                  elements_.free_form() + " (free-form statements), which are no polygons");
    indices_.check(scanner_, count);
    polygon_.points = Eigen::Map<const Points>(coordinates_.data(), count, 3);
    return std::move(polygon_);
  }

 private:
  void read_curve() {
    ControlPolygon::Curve curve;
    for (std::string_view token; !(token = scanner_.token()).empty();) {
      const std::int64_t so_far = std::int64_t(coordinates_.size() / 3);
      curve.points.push_back(indices_.read(scanner_, token.substr(0, token.find('/')), so_far));
    }
    if (curve.points.size() < 2)
      throw FormatError(scanner_.place() + "a line of " + format_number(curve.points.size()) +
                        " points; it should have at least 2");
    const bool is_segment = curve.points.size() == 2;
    if (is_segment && in_segments_ && polygon_.curves.back().points.back() == curve.points[0]) {
      polygon_.curves.back().points.push_back(curve.points[1]);
    } else {
      polygon_.curves.push_back(std::move(curve));
    }
    ControlPolygon::Curve& last = polygon_.curves.back();
    if (last.points.size() > 3 && last.points.front() == last.points.back()) {
      last.points.pop_back();
      last.closed = true;
    }
    in_segments_ = is_segment && !last.closed;
  }

  TextScanner scanner_;
  ControlPolygon polygon_;
  std::vector<double> coordinates_;
  ObjIndices indices_{"vertices"};
  ObjElements elements_;
  bool in_segments_ = false;  // the last curve is made of lines of two points each
};

}  // namespace

ControlPolygon parse_polygon_obj(std::string_view text, std::string_view name) {
  require_text(text, name, "OBJ");
  return ObjCurveReader(text, name).read();
}

ControlPolygon read_polygon(const std::filesystem::path& path, bool tangents) {
  if (const FileFormat* const format = io_formats().reader(path, contents::polygons)) {
    if (tangents && !io_formats().reads(path, contents::tangents))
      throw FormatError(path.string() + ": points with tangents or derivatives are expected; give them as a " +
                        io_formats().readers_in_words({contents::tangents}, "or") +
                        " with columns x,y,tx,ty or x,y,z,tx,ty,tz");
    return format->parse_polygon(read_inflated(path), path.string(), tangents);
  }
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(opened_path(path), error);
  if (!std::filesystem::exists(status) || std::filesystem::is_directory(status)) read_file(path);
  throw FormatError(path.string() + ": unknown kind of polygon '" + file_extension(path) + "'; " +
                    io_formats().readers_in_words({contents::tangents, contents::polygons}, "and") + " can be read");
}

std::string format_polygon_obj(const ControlPolygon& polygon) {
  if (polygon.dimension() > 3)
    throw InvalidParameter("an OBJ has points of 3 coordinates, not " + std::to_string(polygon.dimension()) +
                           "; write a " + io_formats().writers_in_words({contents::tangents}, "or"));
  if (!polygon.points.allFinite()) throw InvalidMesh("points that are not finite cannot be written");
  std::string out;
  for (Index i = 0; i < polygon.num_points(); ++i) {
    out += 'v';
    for (int c = 0; c < 3; ++c) {
      out += ' ';
      append_number(out, c < polygon.dimension() ? polygon.points(i, c) : 0.0);
    }
    out += '\n';
  }
  for (const ControlPolygon::Curve& curve : polygon.curves) {
    out += 'l';
    for (size_t i = 0; i < curve.points.size() + (curve.closed ? 1 : 0); ++i) {
      out += ' ';
      append_number(out, curve.points[i % curve.points.size()] + 1);
    }
    out += '\n';
  }
  return out;
}

void write_polygon(const std::filesystem::path& path, const ControlPolygon& polygon) {
  const FileFormat* const format = io_formats().writer(path, contents::polygons);
  const std::string text = format ? format->format_polygon(polygon) : format_polygon_csv(polygon);
  AtomicFile file(path);
  file.write(text);
  file.commit();
}

}  // namespace sublimit
