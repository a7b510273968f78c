// SPDX-License-Identifier: Apache-2.0
#include "sublimit/io/free_form.h"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/detail/memory.h"
#include "sublimit/base/detail/standard_files.h"
#include "sublimit/base/error.h"
#include "sublimit/io/detail/free_form_checks.h"
#include "sublimit/io/detail/gzip.h"
#include "sublimit/io/detail/free_form_counts.h"
#include "sublimit/io/detail/obj_indices.h"
#include "sublimit/io/detail/obj_keywords.h"
#include "sublimit/io/detail/obj_names.h"
#include "sublimit/io/detail/text_scanner.h"

namespace sublimit {
namespace {

// The statements between an element and its `end`.
bool is_body_keyword(std::string_view keyword) {
  constexpr std::array<std::string_view, 6> keywords{"parm", "trim", "hole", "scrv", "sp", "end"};
  return std::ranges::find(keywords, keyword) != keywords.end();
}

class FreeFormReader {
 public:
  FreeFormReader(std::string_view text, std::string_view name)
      : scanner_(text, name, TextScanner::Continuation::backslash) {}

  FreeForm read() {
    while (scanner_.next_line()) {
      const std::string_view keyword = scanner_.token();
      if (keyword.empty()) continue;
      if (!element_.empty()) {
        read_body(keyword);
      } else if (!read_point(keyword) && !read_state(keyword) && !read_element(keyword)) {
        read_other(keyword);
      }
    }
    finish();
    return std::move(shapes_);
  }

 private:
  // Points.

  bool read_point(std::string_view keyword) {
    if (keyword == "v") {
      read_vertex();
    } else if (keyword == "vp") {
      read_parameter_point();
    } else if (keyword == "vt") {
      double values[3] = {0, 0, 0};
      read_numbers("texture coordinate", 1, values);
      texture_.insert(texture_.end(), values, values + 3);
    } else if (keyword == "vn") {
      for (const char* const what : {"normal x", "normal y", "normal z"})
        normals_.push_back(scanner_.finite(scanner_.token(), what));
    } else {
      return false;
    }
    return true;
  }

  void read_vertex() {
    for (const char* const what : {"coordinate x", "coordinate y", "coordinate z"})
      vertices_.push_back(scanner_.finite(scanner_.token(), what));
    std::string_view last;
    int count = 0;
    for (std::string_view token; !(token = scanner_.token()).empty(); ++count) {
      scanner_.real(token, count == 0 ? "weight" : "number behind a vertex");
      last = token;
    }
    shapes_.weights.push_back(count == 1 ? scanner_.finite(last, "weight") : 1);
    if ((count == 2 || count > 3) && !odd_vertex_) {
      odd_vertex_ = true;
      warnings_.add(scanner_.place() + "vertex of " + format_number(3 + count) +
                    " numbers, whose weight is taken as 1; with a weight it should have 4, with a colour 6");
    }
  }

  void read_parameter_point() {
    double values[3] = {0, 0, 1};
    const int count = read_numbers("parameter", 1, values);
    parameters_.insert(parameters_.end(), values, values + 2);
    shapes_.parameter_weights.push_back(values[2]);
    parameter_sizes_.push_back(static_cast<char>(std::min(count, 3)));
  }

  // Up to three numbers, and what comes behind them checked for form only. Those that are absent stay.
  int read_numbers(const char* what, int least, double (&values)[3]) {
    int count = 0;
    for (std::string_view token; !(token = scanner_.token()).empty() || count < least; ++count) {
      if (count < 3) {
        values[count] = scanner_.finite(token, what);
      } else {
        scanner_.real(token, "number behind a point");
      }
    }
    return count;
  }

  // State.

  bool read_state(std::string_view keyword) {
    if (keyword == "cstype") {
      read_basis();
    } else if (keyword == "deg") {
      read_pair("degree", largest_free_form_degree, degree_);
      degree_line_ = scanner_.line();
    } else if (keyword == "step") {
      read_pair("step", std::numeric_limits<Index>::max(), step_);
    } else if (keyword == "bmat") {
      FreeFormMatrix matrix;
      Index& current = matrix_[read_letter("bmat")];
      for (std::string_view token; !(token = scanner_.token()).empty();)
        matrix.values.push_back(scanner_.finite(token, "entry of the basis matrix"));
      current = static_cast<Index>(shapes_.matrices.size());
      shapes_.matrices.push_back(std::move(matrix));
    } else if (keyword == "g" || keyword == "o") {
      (keyword == "g" ? group_ : object_) = names_.number(rest_of_line(scanner_), shapes_.names);
    } else {
      return false;
    }
    return true;
  }

  void read_basis() {
    constexpr FreeFormBasis bases[] = {FreeFormBasis::bmatrix, FreeFormBasis::bezier, FreeFormBasis::bspline,
                                       FreeFormBasis::cardinal, FreeFormBasis::taylor};
    std::string_view token = scanner_.token();
    rational_ = token == "rat";
    if (rational_) token = scanner_.token();
    const auto* const basis = std::ranges::find_if(bases, [&](FreeFormBasis b) { return basis_name(b) == token; });
    if (basis == std::end(bases))
      throw FormatError(scanner_.place() + "unknown cstype " + in_quotes(token) +
                        "; it should be 'bmatrix', 'bezier', 'bspline', 'cardinal' or 'taylor', perhaps behind 'rat'");
    basis_ = *basis;
    expect_line_end("cstype");
  }

  // One or two integers from 1; the second is 0 if it is absent.
  void read_pair(const char* what, std::int64_t most, Index (&values)[2]) {
    values[1] = 0;
    for (int i = 0; i < 2; ++i) {
      const std::string_view token = scanner_.token();
      if (i == 1 && token.empty()) return;
      const std::int64_t value = scanner_.integer(token, what);
      if (value < 1 || value > most)
        throw FormatError(scanner_.place() + what + " " + format_number(value) + "; it should be 1 to " +
                          format_number(most));
      values[i] = static_cast<Index>(value);
    }
    expect_line_end(what);
  }

  // 'u' or 'v', as 0 or 1.
  std::size_t read_letter(std::string_view keyword) {
    const std::string_view token = scanner_.token();
    if (token != "u" && token != "v")
      throw FormatError(scanner_.place() + "'" + std::string(keyword) + "' has " + in_quotes(token) +
                        " where its direction should be, 'u' or 'v'");
    return token == "v";
  }

  // Elements.

  bool read_element(std::string_view keyword) {
    if (keyword != "curv" && keyword != "curv2" && keyword != "surf") return false;
    surface_ = {};
    surface_.line = scanner_.line();
    start_element(keyword);
    element_ = keyword;  // lies in the text
    if (keyword == "curv") read_range(surface_.u);
    if (keyword == "surf") {
      read_range(surface_.u);
      read_range(surface_.v);
      for (std::string_view token; !(token = scanner_.token()).empty();) read_surface_point(token);
    } else {
      const bool in_space = keyword == "curv";
      for (std::string_view token; !(token = scanner_.token()).empty();)
        surface_.points.push_back(in_space ? read_vertex_index(token) : read_parameter_index(token));
    }
    return true;
  }

  // The state that it is made under.
  void start_element(std::string_view keyword) {
    const std::string start = scanner_.place() + "'" + std::string(keyword) + "' ";
    const std::size_t directions = keyword == "surf" ? 2 : 1;
    if (!basis_) throw FormatError(start + "comes before any 'cstype'; add one, such as 'cstype bspline'");
    if (degree_[0] == 0) throw FormatError(start + "comes before any 'deg'; add one, such as 'deg 3 3'");
    if (directions == 2 && degree_[1] == 0)
      throw FormatError(start + "needs two degrees; the 'deg' of line " + format_number(degree_line_) +
                        " has one, it should be 'deg " + format_number(degree_[0]) + " N'");
    surface_.basis = *basis_;
    surface_.rational = rational_;
    surface_.group = group_;
    surface_.object = object_;
    for (std::size_t i = 0; i < directions; ++i) {
      FreeFormDirection& direction = i == 0 ? surface_.u : surface_.v;
      direction.degree = degree_[i];
      if (*basis_ == FreeFormBasis::cardinal && degree_[i] != 3)
        throw FormatError(start + "is cardinal and has degree " + format_number(degree_[i]) + "; it should be 3");
      if (*basis_ != FreeFormBasis::bmatrix) continue;
      const char letter = i == 0 ? 'u' : 'v';
      const std::int64_t entries = (std::int64_t{degree_[i]} + 1) * (degree_[i] + 1);
      if (matrix_[i] < 0)
        throw FormatError(start + "has no 'bmat " + letter + "'; it should be one of " + format_number(entries) +
                          " numbers");
      const std::size_t given = shapes_.matrices[static_cast<std::size_t>(matrix_[i])].values.size();
      if (std::int64_t(given) != entries)
        throw FormatError(start + "has a 'bmat " + letter + "' of " + format_number(given) + " numbers; degree " +
                          format_number(degree_[i]) + " needs " + format_number(entries));
      if (step_[i] == 0)
        throw FormatError(start + "has no 'step' along " + letter + "; it should be 'step N" +
                          (directions == 2 ? " N'" : "'"));
      direction.matrix = matrix_[i];
      direction.step = step_[i];
    }
  }

  void read_range(FreeFormDirection& direction) {
    direction.first = scanner_.finite(scanner_.token(), "start of the range");
    direction.last = scanner_.finite(scanner_.token(), "end of the range");
    if (direction.first < direction.last) return;
    throw FormatError(scanner_.place() + "the range of the parameter is " + format_number(direction.first) + " to " +
                      format_number(direction.last) + "; it should rise");
  }

  // A vertex, perhaps a texture coordinate and a normal: all control points have the same of them.
  void read_surface_point(std::string_view token) {
    const std::string_view whole = token;
    std::array<std::string_view, 3> parts;
    std::size_t count = 0;
    for (std::size_t slash = 0; slash != std::string_view::npos; ++count) {
      if (count == 3)
        throw FormatError(scanner_.place() + "control point " + in_quotes(whole) +
                          " has more than 3 indices; it should be 'v', 'v/vt', 'v//vn' or 'v/vt/vn'");
      slash = token.find('/');
      parts[count] = token.substr(0, slash);
      if (slash != std::string_view::npos) token.remove_prefix(slash + 1);
    }
    const std::size_t before = surface_.points.size();
    surface_.points.push_back(read_vertex_index(parts[0]));
    if (!parts[1].empty())
      surface_.texture.push_back(texture_indices_.read(scanner_, parts[1], std::int64_t(texture_.size() / 3)));
    if (!parts[2].empty())
      surface_.normals.push_back(normal_indices_.read(scanner_, parts[2], std::int64_t(normals_.size() / 3)));
    const auto some = [&](std::size_t size) { return size != 0 && size != before + 1; };
    if (some(surface_.texture.size()) || some(surface_.normals.size()))
      throw FormatError(scanner_.place() + "control point " + in_quotes(whole) + ", number " +
                        format_number(before + 1) +
                        " of its surf, has other indices than those before it; all or none "
                        "should have texture coordinates, and likewise normals");
  }

  Index read_vertex_index(std::string_view token) {
    return vertex_indices_.read(scanner_, token, std::int64_t(vertices_.size() / 3));
  }
  Index read_parameter_index(std::string_view token) {
    return parameter_indices_.read(scanner_, token, std::int64_t(parameters_.size() / 2));
  }

  // The body of an element.

  void read_body(std::string_view keyword) {
    if (keyword == "parm") {
      read_parameters();
    } else if (keyword == "sp") {
      const std::size_t count = surface_.special_points.size();
      for (std::string_view token; !(token = scanner_.token()).empty() || count == surface_.special_points.size();)
        surface_.special_points.push_back(read_parameter_index(token));
    } else if (keyword == "end") {
      expect_line_end("end");
      end_element();
    } else if (!is_body_keyword(keyword)) {
      throw FormatError(scanner_.place() + in_quotes(keyword) + " inside of the '" + std::string(element_) +
                        "' of line " + format_number(surface_.line) +
                        ", which has no 'end' yet; only 'parm', 'trim', 'hole', 'scrv' and 'sp' come before it");
    } else if (element_ != "surf") {
      throw FormatError(scanner_.place() + in_quotes(keyword) + " inside of the '" + std::string(element_) +
                        "' of line " + format_number(surface_.line) + "; only a 'surf' has such curves");
    } else {
      read_loop(keyword);
    }
  }

  void read_parameters() {
    const std::size_t letter = read_letter("parm");
    const std::string parm = letter == 0 ? "parm u" : "parm v";
    if (letter == 1 && element_ != "surf")
      throw FormatError(scanner_.place() + "'parm v' inside of the '" + std::string(element_) + "' of line " +
                        format_number(surface_.line) + ", which has one parameter, u");
    FreeFormDirection& direction = letter == 0 ? surface_.u : surface_.v;
    if (!direction.parameters.empty())
      throw FormatError(scanner_.place() + "a second '" + parm + "' for the '" + std::string(element_) + "' of line " +
                        format_number(surface_.line) + "; the first is in line " + format_number(direction.line));
    direction.line = scanner_.line();
    std::vector<double>& values = direction.parameters;
    const bool knots = surface_.basis == FreeFormBasis::bspline;
    for (std::string_view token; !(token = scanner_.token()).empty() || values.empty();) {
      const double value = scanner_.finite(token, parm);
      if (!values.empty() && !(values.back() < value || (knots && values.back() == value)))
        throw FormatError(scanner_.place() + parm + ": value " + format_number(values.size() + 1) + " is " +
                          format_number(value) + " after " + format_number(values.back()) +
                          (knots ? "; knots should not fall"
                                 : "; values of a " + std::string(basis_name(surface_.basis)) + " should rise"));
      values.push_back(value);
    }
  }

  void read_loop(std::string_view keyword) {
    FreeFormLoop loop;
    loop.kind = keyword == "trim"   ? FreeFormLoop::Kind::trim
                : keyword == "hole" ? FreeFormLoop::Kind::hole
                                    : FreeFormLoop::Kind::scrv;
    loop.line = scanner_.line();
    for (std::string_view token; !(token = scanner_.token()).empty() || loop.parts.empty();)
      loop.parts.push_back(read_part(token));
    surface_.loops.push_back(std::move(loop));
  }

  // From, to, curve; `token` is the first of them.
  FreeFormCurvePart read_part(std::string_view token) {
    FreeFormCurvePart part;
    part.first = scanner_.finite(token, "start of the curve");
    part.last = scanner_.finite(scanner_.token(), "end of the curve");
    part.curve = curve_indices_.read(scanner_, scanner_.token(), std::int64_t(shapes_.curves_2d.size()));
    return part;
  }

  void end_element() {
    if (element_ == "surf") {
      check_surface(surface_, scanner_, warnings_);
      shapes_.surfaces.push_back(std::move(surface_));
    } else {
      FreeFormCurve curve{std::move(static_cast<FreeFormElement&>(surface_)), std::move(surface_.u)};
      check_curve(curve, element_, scanner_, warnings_);
      (element_ == "curv" ? shapes_.curves : shapes_.curves_2d).push_back(std::move(curve));
    }
    element_ = {};
  }

  // All else.

  void read_other(std::string_view keyword) {
    if (keyword == "con") {
      FreeFormConnection connection;
      connection.line = scanner_.line();
      for (int i = 0; i < 2; ++i) {
        connection.surfaces[i] =
            surface_indices_.read(scanner_, scanner_.token(), std::int64_t(shapes_.surfaces.size()));
        connection.parts[i] = read_part(scanner_.token());
      }
      expect_line_end("con");
      shapes_.connections.push_back(connection);
    } else if (is_body_keyword(keyword)) {
      throw FormatError(scanner_.place() + in_quotes(keyword) +
                        " belongs to no element; it should come between a 'curv', 'curv2' or 'surf' and its 'end'");
    } else if (!elements_.count(scanner_, keyword) && !is_attribute_keyword(keyword) && keyword != "t") {
      unknown_.warn(scanner_, keyword, shapes_.warnings);
    }
  }

  void expect_line_end(std::string_view keyword) {
    const std::string_view token = scanner_.token();
    if (!token.empty())
      throw FormatError(scanner_.place() + in_quotes(token) + " behind '" + std::string(keyword) +
                        "' and what belongs to it; the line should end there");
  }

  void finish() {
    if (!element_.empty())
      throw FormatError(scanner_.place(surface_.line) + "'" + std::string(element_) +
                        "' has no 'end'; add one behind its 'parm'");
    const std::string& name = scanner_.name();
    if (shapes_.curves.empty() && shapes_.curves_2d.empty() && shapes_.surfaces.empty())
      throw InvalidMesh(name + ": no curves and no surfaces" +
                        (elements_.faces > 0 ? ", but a mesh of " + counted(elements_.faces, "face") : "") +
                        "; they are 'curv' and 'surf', each with 'parm' and 'end'");
    const auto rows = [&](const std::vector<double>& values, Eigen::Index columns, const char* what) -> Points {
      const Index count = checked_index(std::int64_t(values.size()) / columns, name, what);
      return Eigen::Map<const Points>(values.data(), count, columns);
    };
    shapes_.vertices = rows(vertices_, 3, "vertices");
    shapes_.parameters = rows(parameters_, 2, "points of parameter space");
    shapes_.texture = rows(texture_, 3, "texture coordinates");
    shapes_.normals = rows(normals_, 3, "normals");
    vertex_indices_.check(scanner_, shapes_.vertices.rows());
    parameter_indices_.check(scanner_, shapes_.parameters.rows());
    texture_indices_.check(scanner_, shapes_.texture.rows());
    normal_indices_.check(scanner_, shapes_.normals.rows());
    curve_indices_.check(scanner_, std::int64_t(shapes_.curves_2d.size()));
    surface_indices_.check(scanner_, std::int64_t(shapes_.surfaces.size()));
    for (const FreeFormCurve& curve : shapes_.curves_2d) {
      for (const Index point : curve.points) {
        if (parameter_sizes_[static_cast<std::size_t>(point)] < 2)
          throw FormatError(scanner_.place(curve.line) + "curv2: control point " + format_number(point + 1) +
                            " has one coordinate; it should have two, 'vp u v'");
      }
      check_weights(curve, shapes_.parameter_weights, "curv2", scanner_, warnings_);
    }
    for (const FreeFormCurve& curve : shapes_.curves)
      check_weights(curve, shapes_.weights, "curv", scanner_, warnings_);
    for (const FreeFormSurface& surface : shapes_.surfaces)
      check_weights(surface, shapes_.weights, "surf", scanner_, warnings_);
    shapes_.num_faces = elements_.faces;
  }

  TextScanner scanner_;
  FreeForm shapes_;
  FreeFormWarnings warnings_{shapes_.warnings};
  std::vector<double> vertices_, parameters_, texture_, normals_;
  std::vector<char> parameter_sizes_;  // how many coordinates a `vp` has
  bool odd_vertex_ = false;            // warned about

  std::optional<FreeFormBasis> basis_;
  bool rational_ = false;
  Index degree_[2] = {0, 0}, step_[2] = {0, 0}, matrix_[2] = {-1, -1};
  std::int64_t degree_line_ = 0;
  Index group_ = -1, object_ = -1;
  ObjNames names_;

  std::string_view element_;  // the keyword of the one that has no end yet; empty: none
  FreeFormSurface surface_;   // that element; a curve has its u

  ObjIndices vertex_indices_{"vertices"}, parameter_indices_{"points 'vp'"}, texture_indices_{"texture coordinates"},
      normal_indices_{"normals"}, curve_indices_{"curves 'curv2'"}, surface_indices_{"surfaces"};
  ObjElements elements_;
  UnknownKeywords unknown_;
};

}  // namespace

FreeForm read_free_form(const std::filesystem::path& path) {
  std::error_code ignored;  // of a pipe, or no file at all: its reader says what is wrong
  const std::filesystem::path opened = opened_path(path);
  if (std::filesystem::is_regular_file(opened, ignored)) {
    // The text, and of a control point, which is two characters at least, an index in a list that doubles.
    const auto size = static_cast<double>(std::filesystem::file_size(opened, ignored));
    check_memory(path.string() + ": " + bytes_in_words(size) + " of curves and surfaces", 7 * size,
                 "put them into several files");
  }
  return parse_free_form(read_inflated(path), path.string());
}

FreeForm parse_free_form(std::string_view text, std::string_view name) {
  require_text(text, name, "OBJ");
  return FreeFormReader(text, name).read();
}

}  // namespace sublimit
