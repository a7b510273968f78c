// SPDX-License-Identifier: Apache-2.0
#pragma once
// Free-form curves and surfaces of Wavefront OBJ files, as the file has them: checked, and converted to nothing.
// Source: Wavefront Technologies, "Object Files (.obj)", appendix B1 of the Advanced Visualizer manual, release 3.0.
//
// Taken: `v x y z [w]`, `vp u [v [w]]`, `vt`, `vn`; the state `cstype [rat] bmatrix|bezier|bspline|cardinal|taylor`,
// `deg m [n]`, `bmat u|v ...`, `step m [n]`, `g`, `o`, which holds for all elements after it; the elements `curv`,
// `curv2` and `surf`, each with its `parm`, `trim`, `hole`, `scrv`, `sp` up to its `end`; `con`. Lines are continued by
// a backslash; indices count from 1, or backwards from -1, and may name what comes later.
//
// Points are Euclidean. Their weight is used by elements that are rational (`rat`) and ignored, with a warning, by
// others; 6 numbers behind a `v` are a point and its colour, whose weight is 1. Texture coordinates and normals of a
// surface have the basis of its points, without weights.
//
// Trimming loops are kept as they are; nothing here says which part of a surface they cut off.
#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "sublimit/core/types.h"

namespace sublimit {

/// `cstype`. What the control points of a segment multiply, and how many segments there are: free_form_counts.h.
enum class FreeFormBasis { bmatrix, bezier, bspline, cardinal, taylor };

/// What a curve is along its parameter, or a surface along one of its two.
struct FreeFormDirection {
  int degree = 0;
  Index count = 0;  ///< control points
  /// bspline: count + degree + 1 knots, not falling, inner ones at most `degree` times. Else where segments meet,
  /// rising.
  std::vector<double> parameters;
  double first = 0, last = 0;  ///< the part of the domain that is meant; first < last
  Index matrix = -1;           ///< bmatrix: in FreeForm::matrices
  Index step = 0;              ///< bmatrix: control points from the start of a segment to the start of the next
  std::int64_t line = 0;       ///< of its `parm`
};

/// `bmat`: row i has the coefficients of control point i of a segment, of t^0 first, t from 0 to 1 in a segment.
struct FreeFormMatrix {
  std::vector<double> values;  ///< (degree + 1)^2, row by row
};

/// A part of a curve in parameter space.
struct FreeFormCurvePart {
  Index curve = 0;             ///< in FreeForm::curves_2d
  double first = 0, last = 0;  ///< from and to which parameter of it
};

/// A statement that lays curves in the parameter space of a surface. The parts follow each other, the end of one at the
/// start of the next; `trim` and `hole` are closed.
struct FreeFormLoop {
  enum class Kind {
    trim,  ///< the outside of a region that is kept
    hole,  ///< the outside of a region that is cut from it
    scrv,  ///< a curve that a tessellation should follow
  };
  Kind kind = Kind::trim;
  std::vector<FreeFormCurvePart> parts;
  std::int64_t line = 0;
};

/// What all elements have.
struct FreeFormElement {
  FreeFormBasis basis = FreeFormBasis::bspline;
  bool rational = false;
  std::vector<Index> points;          ///< control points: vertices, of a `curv2` points of parameter space
  std::vector<Index> special_points;  ///< `sp`: points of parameter space (of a curve: by their u)
  Index group = -1, object = -1;      ///< in FreeForm::names; -1 none
  std::int64_t line = 0;              ///< of `curv`, `curv2` or `surf`
};

/// `curv` or `curv2`.
struct FreeFormCurve : FreeFormElement {
  FreeFormDirection u;
};

/// `surf`. Control point (i, j) is number i + j * u.count.
struct FreeFormSurface : FreeFormElement {
  FreeFormDirection u, v;
  std::vector<Index> texture, normals;  ///< of each control point; empty: none
  std::vector<FreeFormLoop> loops;
};

/// Whether loops cut parts off, or holes into it.
inline bool is_trimmed(const FreeFormSurface& surface) {
  return std::ranges::any_of(surface.loops,
                             [](const FreeFormLoop& loop) { return loop.kind != FreeFormLoop::Kind::scrv; });
}

/// `con`: two surfaces meet along these curves of theirs.
struct FreeFormConnection {
  Index surfaces[2] = {0, 0};
  FreeFormCurvePart parts[2];
  std::int64_t line = 0;
};

struct FreeForm {
  Points vertices;              ///< #v x 3
  std::vector<double> weights;  ///< of vertices, 1 where the file has none
  Points parameters;            ///< #vp x 2, points of parameter space; v is 0 where the file has none
  std::vector<double> parameter_weights;
  Points texture;  ///< #vt x 3, 0 where the file has none
  Points normals;  ///< #vn x 3

  std::vector<FreeFormCurve> curves;     ///< in space
  std::vector<FreeFormCurve> curves_2d;  ///< in parameter space
  std::vector<FreeFormSurface> surfaces;
  std::vector<FreeFormConnection> connections;

  std::vector<FreeFormMatrix> matrices;
  std::vector<std::string> names;     ///< of groups and objects
  std::int64_t num_faces = 0;         ///< of the mesh that the file has besides
  std::vector<std::string> warnings;  ///< what the reader accepted but wants known, each with file:line
};

/// The free-form curves and surfaces in a file. B-splines whose first and last knot are left out, as openNURBS has
/// them, get these doubled; ranges are cut to the domain; a warning says so.
/// @throws FormatError  what cannot be understood, with file:line and what would be right: counts that do not fit
///                      together, knots that fall, state that is missing, statements out of place
/// @throws InvalidMesh  indices out of range, numbers that are not finite, weights that are all 0, no such element
/// @throws IoError      missing, unreadable;  ResourceError  more than memory or 32-bit indices hold
FreeForm read_free_form(const std::filesystem::path& path);

/// As `read_free_form`, from text; messages start with `name`. Memory is in proportion to the text, whatever it says.
FreeForm parse_free_form(std::string_view text, std::string_view name);

/// The text of curves and surfaces. Numbers have the shortest form that reads back to the same bits; curves in
/// parameter space come first, since surfaces name them; long statements are continued after 100 columns.
/// @throws InvalidParameter  counts or indices that do not fit together;  InvalidMesh  numbers that are not finite
std::string format_free_form(const FreeForm& shapes);

/// `format_free_form` into a file, which appears whole or not at all.
void write_free_form(const std::filesystem::path& path, const FreeForm& shapes);

}  // namespace sublimit
