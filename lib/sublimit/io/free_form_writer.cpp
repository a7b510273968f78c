// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "sublimit/base/detail/atomic_file.h"
#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/error.h"
#include "sublimit/io/detail/free_form_counts.h"
#include "sublimit/io/detail/obj_keywords.h"
#include "sublimit/io/detail/obj_names.h"
#include "sublimit/io/free_form.h"

namespace sublimit {
namespace {

// Whether shapes can be written so that they read back as they are.
class FreeFormOutputCheck {
 public:
  explicit FreeFormOutputCheck(const FreeForm& shapes) : shapes_(shapes) {}

  void run() const {
    require(shapes_.vertices.rows() == 0 || shapes_.vertices.cols() == 3, "vertices have 3 coordinates");
    require(shapes_.parameters.rows() == 0 || shapes_.parameters.cols() == 2, "points of parameter space have 2");
    require(shapes_.texture.rows() == 0 || shapes_.texture.cols() == 3, "texture coordinates have 3 columns");
    require(shapes_.normals.rows() == 0 || shapes_.normals.cols() == 3, "normals have 3 coordinates");
    require(std::int64_t(shapes_.weights.size()) == shapes_.vertices.rows(), "each vertex has a weight");
    require(std::int64_t(shapes_.parameter_weights.size()) == shapes_.parameters.rows(),
            "each point of parameter space has a weight");
    require_finite(shapes_.vertices.allFinite() && shapes_.parameters.allFinite() && shapes_.texture.allFinite() &&
                   shapes_.normals.allFinite());
    require_finite(shapes_.weights);
    require_finite(shapes_.parameter_weights);
    for (const FreeFormMatrix& matrix : shapes_.matrices) require_finite(matrix.values);
    for (const std::string& name : shapes_.names)
      require(name.find_first_of("\r\n") == std::string::npos && !has_comment(name),
              "a name is one line without '#' behind a blank");
    for (const FreeFormCurve& curve : shapes_.curves) check(curve, shapes_.vertices.rows());
    for (const FreeFormCurve& curve : shapes_.curves_2d) check(curve, shapes_.parameters.rows());
    for (const FreeFormSurface& surface : shapes_.surfaces) check(surface);
    for (const FreeFormConnection& connection : shapes_.connections) {
      check_indices(connection.surfaces, std::int64_t(shapes_.surfaces.size()));
      check_parts(connection.parts);
    }
  }

 private:
  static void require(bool holds, const char* right) {
    if (!holds) throw InvalidParameter(std::string("free-form curves and surfaces to be written: ") + right);
  }
  static void require_finite(bool finite) {
    if (!finite) throw InvalidMesh("curves and surfaces with numbers that are not finite cannot be written");
  }
  static void require_finite(const std::vector<double>& values) {
    require_finite(std::ranges::all_of(values, [](double value) { return std::isfinite(value); }));
  }

  template <class Indices>
  static void check_indices(const Indices& indices, std::int64_t count) {
    require(std::ranges::all_of(indices, [&](Index i) { return i >= 0 && i < count; }), "indices are within range");
  }
  template <class Parts>
  void check_parts(const Parts& parts) const {
    for (const FreeFormCurvePart& part : parts) {
      check_indices(std::initializer_list<Index>{part.curve}, std::int64_t(shapes_.curves_2d.size()));
      require_finite(std::isfinite(part.first) && std::isfinite(part.last));
    }
  }

  void check_element(const FreeFormElement& element, std::int64_t num_points) const {
    check_indices(element.points, num_points);
    check_indices(element.special_points, shapes_.parameters.rows());
    for (const Index name : {element.group, element.object})
      require(name >= -1 && name < std::int64_t(shapes_.names.size()), "groups and objects are names");
  }

  void check(const FreeFormDirection& direction, FreeFormBasis basis) const {
    require(direction.degree >= 1 && direction.degree <= largest_free_form_degree, "a degree is 1 to 1000");
    require(basis != FreeFormBasis::cardinal || direction.degree == 3, "cardinal has degree 3");
    if (basis == FreeFormBasis::bmatrix) {
      require(direction.step >= 1, "bmatrix has a step");
      check_indices(std::initializer_list<Index>{direction.matrix}, std::int64_t(shapes_.matrices.size()));
      const auto order = static_cast<std::size_t>(direction.degree + 1);
      require(shapes_.matrices[static_cast<std::size_t>(direction.matrix)].values.size() == order * order,
              "a matrix has (degree + 1)^2 entries");
    }
    const FreeFormCounts counts(basis, direction.degree, direction.step);
    require(
        counts.fits(direction.count) && counts.parameters(direction.count) == std::int64_t(direction.parameters.size()),
        "values of parm fit the number of control points");
    require_finite(direction.parameters);
    const auto falls = [&](double a, double b) { return basis == FreeFormBasis::bspline ? a > b : a >= b; };
    require(std::ranges::adjacent_find(direction.parameters, falls) == direction.parameters.end(),
            "knots do not fall, other values of parm rise");
    require(basis != FreeFormBasis::bspline ||
                first_excess_knot(direction.parameters, direction.degree) == direction.parameters.size(),
            "knots inside are there at most degree times");
    const auto [from, to] = free_form_domain(basis, direction);
    require(from <= direction.first && direction.first < direction.last && direction.last <= to,
            "a range rises within the domain");
  }

  void check(const FreeFormCurve& curve, std::int64_t num_points) const {
    check_element(curve, num_points);
    require(std::int64_t(curve.points.size()) == curve.u.count, "a curve has as many points as its direction");
    check(curve.u, curve.basis);
  }

  void check(const FreeFormSurface& surface) const {
    check_element(surface, shapes_.vertices.rows());
    const std::size_t count = surface.points.size();
    require(std::int64_t(count) == std::int64_t{surface.u.count} * surface.v.count,
            "a surface has the product of both directions as points");
    require(surface.texture.empty() || surface.texture.size() == count, "all or no points have texture coordinates");
    require(surface.normals.empty() || surface.normals.size() == count, "all or no points have normals");
    check_indices(surface.texture, shapes_.texture.rows());
    check_indices(surface.normals, shapes_.normals.rows());
    check(surface.u, surface.basis);
    check(surface.v, surface.basis);
    for (const FreeFormLoop& loop : surface.loops) {
      require(!loop.parts.empty(), "a loop has parts");
      check_parts(loop.parts);
    }
  }

  const FreeForm& shapes_;
};

// Statements of words, continued after 100 columns.
class ObjStatements {
 public:
  void begin(std::string_view keyword) {
    start_ = text_.size();
    text_ += keyword;
  }
  void word(std::string_view word) {
    if (text_.size() - start_ + 1 + word.size() > 98) {  // room for " \"
      text_ += " \\\n ";
      start_ = text_.size() - 1;
    } else {
      text_ += ' ';
    }
    text_ += word;
  }
  void number(double value) { word(format_number(value)); }
  void index(Index i) { word(format_number(i + 1)); }
  void end() { text_ += '\n'; }

  // The rest of a line, which may have blanks in it.
  void line(std::string_view keyword, std::string_view rest) {
    text_ += std::string(keyword) + (rest.empty() ? "" : " ") + std::string(rest);
    text_ += rest.ends_with('\\') ? " #\n" : "\n";  // a name, and no continuation
  }

  std::string take() { return std::move(text_); }

 private:
  std::string text_;
  std::size_t start_ = 0;  // of this line
};

class FreeFormWriter {
 public:
  explicit FreeFormWriter(const FreeForm& shapes) : shapes_(shapes) {}

  std::string write() {
    rows("v", shapes_.vertices, &shapes_.weights);
    rows("vp", shapes_.parameters, &shapes_.parameter_weights);
    rows("vt", shapes_.texture, nullptr);
    rows("vn", shapes_.normals, nullptr);
    for (const FreeFormCurve& curve : shapes_.curves_2d) write(curve, "curv2");
    for (const FreeFormCurve& curve : shapes_.curves) write(curve, "curv");
    for (const FreeFormSurface& surface : shapes_.surfaces) write(surface);
    for (const FreeFormConnection& connection : shapes_.connections) {
      out_.begin("con");
      for (int i = 0; i < 2; ++i) {
        out_.index(connection.surfaces[i]);
        write(connection.parts[i]);
      }
      out_.end();
    }
    return out_.take();
  }

 private:
  void rows(const char* keyword, const Points& points, const std::vector<double>* weights) {
    for (Eigen::Index row = 0; row < points.rows(); ++row) {
      out_.begin(keyword);
      for (Eigen::Index i = 0; i < points.cols(); ++i) out_.number(points(row, i));
      if (weights && (*weights)[static_cast<std::size_t>(row)] != 1)
        out_.number((*weights)[static_cast<std::size_t>(row)]);
      out_.end();
    }
  }

  // Groups and objects where they change, the state always.
  void state(const FreeFormElement& element, const FreeFormDirection& u, const FreeFormDirection* v) {
    const auto name = [&](const char* keyword, Index which, Index& current) {
      if (which == current) return;
      out_.line(keyword, which < 0 ? std::string_view() : shapes_.names[static_cast<std::size_t>(which)]);
      current = which;
    };
    name("o", element.object, object_);
    name("g", element.group, group_);
    out_.line("cstype", (element.rational ? "rat " : "") + std::string(basis_name(element.basis)));
    out_.begin("deg");
    out_.word(format_number(u.degree));
    if (v) out_.word(format_number(v->degree));
    out_.end();
    if (element.basis != FreeFormBasis::bmatrix) return;
    out_.begin("step");
    out_.word(format_number(u.step));
    if (v) out_.word(format_number(v->step));
    out_.end();
    if (u.matrix != matrix_[0]) values("bmat u", shapes_.matrices[static_cast<std::size_t>(u.matrix)].values);
    matrix_[0] = u.matrix;
    if (!v) return;
    if (v->matrix != matrix_[1]) values("bmat v", shapes_.matrices[static_cast<std::size_t>(v->matrix)].values);
    matrix_[1] = v->matrix;
  }

  void values(const char* statement, const std::vector<double>& values) {
    out_.begin(statement);
    for (const double value : values) out_.number(value);
    out_.end();
  }

  void write(const FreeFormCurve& curve, const char* keyword) {
    state(curve, curve.u, nullptr);
    out_.begin(keyword);
    if (std::string_view(keyword) == "curv") range(curve.u);
    for (const Index point : curve.points) out_.index(point);
    out_.end();
    values("parm u", curve.u.parameters);
    finish(curve);
  }

  void write(const FreeFormSurface& surface) {
    state(surface, surface.u, &surface.v);
    out_.begin("surf");
    range(surface.u);
    range(surface.v);
    for (std::size_t i = 0; i < surface.points.size(); ++i) {
      std::string point = format_number(surface.points[i] + 1);
      if (!surface.texture.empty()) point += "/" + format_number(surface.texture[i] + 1);
      if (!surface.normals.empty())
        point += (surface.texture.empty() ? "//" : "/") + format_number(surface.normals[i] + 1);
      out_.word(point);
    }
    out_.end();
    values("parm u", surface.u.parameters);
    values("parm v", surface.v.parameters);
    for (const FreeFormLoop& loop : surface.loops) {
      out_.begin(loop.kind == FreeFormLoop::Kind::trim   ? "trim"
                 : loop.kind == FreeFormLoop::Kind::hole ? "hole"
                                                         : "scrv");
      for (const FreeFormCurvePart& part : loop.parts) write(part);
      out_.end();
    }
    finish(surface);
  }

  void range(const FreeFormDirection& direction) {
    out_.number(direction.first);
    out_.number(direction.last);
  }

  void write(const FreeFormCurvePart& part) {
    out_.number(part.first);
    out_.number(part.last);
    out_.index(part.curve);
  }

  void finish(const FreeFormElement& element) {
    if (!element.special_points.empty()) {
      out_.begin("sp");
      for (const Index point : element.special_points) out_.index(point);
      out_.end();
    }
    out_.line("end", "");
  }

  const FreeForm& shapes_;
  ObjStatements out_;
  Index object_ = -1, group_ = -1, matrix_[2] = {-1, -1};
};

}  // namespace

std::string format_free_form(const FreeForm& shapes) {
  FreeFormOutputCheck(shapes).run();
  return FreeFormWriter(shapes).write();
}

void write_free_form(const std::filesystem::path& path, const FreeForm& shapes) {
  const std::string text = format_free_form(shapes);
  AtomicFile file(path);
  file.write(text);
  file.commit();
}

}  // namespace sublimit
