// SPDX-License-Identifier: Apache-2.0
#pragma once
// Reads and writes free-form curves and surfaces of Wavefront OBJ files, as the file has them: checked, not converted.
//
//   const FreeForm shapes = read_free_form("hull.obj");
//   for (const FreeFormSurface& s : shapes.surfaces) std::cout << s.u.count << " x " << s.v.count << "\n";
//   write_free_form("copy.obj", shapes);
//
// Source: Wavefront Technologies, "Object Files (.obj)", appendix B1 of the Advanced Visualizer manual, release 3.0.
//
// The reader takes `v x y z [w]`, `vp u [v [w]]`, `vt`, `vn`; the state `cstype [rat]
// bmatrix|bezier|bspline|cardinal|taylor`, `deg m [n]`, `bmat u|v ...`, `step m [n]`, `g`, `o`, which holds for all
// elements after it; the elements `curv`, `curv2` and `surf`, each with its `parm`, `trim`, `hole`, `scrv`, `sp` up to
// its `end`; `con`. Lines are continued by a backslash; indices count from 1, or backwards from -1, and may refer to
// later lines.
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

/// Basis of a curve or surface (`cstype`): the functions that its control points are multiplied with.
enum class FreeFormBasis { bmatrix, bezier, bspline, cardinal, taylor };

/// Degree, knots and range of a curve along its parameter, or of a surface along one of its two.
struct FreeFormDirection {
  int degree = 0;
  Index count = 0;  ///< number of control points
  /// bspline: count + degree + 1 knots, non-decreasing, inner ones at most `degree` times. Other bases: the parameters
  /// at which segments meet, increasing.
  std::vector<double> parameters;
  double first = 0, last = 0;  ///< range of parameters of the element, a part of the domain; first < last
  Index matrix = -1;           ///< bmatrix: number of the matrix in FreeForm::matrices
  Index step = 0;              ///< bmatrix: control points from the start of a segment to the start of the next
  std::int64_t line = 0;       ///< line of its `parm`
};

/// A basis matrix (`bmat`): row i has the coefficients of control point i of a segment, of t^0 first, t from 0 to 1 in
/// a segment.
struct FreeFormMatrix {
  std::vector<double> values;  ///< (degree + 1)^2, row by row
};

/// A part of a curve in parameter space.
struct FreeFormCurvePart {
  Index curve = 0;             ///< number of the curve in FreeForm::curves_2d
  double first = 0, last = 0;  ///< first and last parameter of the part
};

/// Curves in the parameter space of a surface (`trim`, `hole`, `scrv`). The parts follow each other, the end of one at
/// the start of the next; `trim` and `hole` are closed.
struct FreeFormLoop {
  enum class Kind {
    trim,  ///< the outer border of a region that is kept
    hole,  ///< the outer border of a region that is cut from it
    scrv,  ///< a curve that a tessellation should follow
  };
  Kind kind = Kind::trim;
  std::vector<FreeFormCurvePart> parts;
  std::int64_t line = 0;
};

/// Common part of curves and surfaces.
struct FreeFormElement {
  FreeFormBasis basis = FreeFormBasis::bspline;
  bool rational = false;              ///< control points have weights
  std::vector<Index> points;          ///< control points: vertices; for `curv2` points of parameter space
  std::vector<Index> special_points;  ///< `sp`: points of parameter space, for curves given by their u
  Index group = -1, object = -1;      ///< numbers in FreeForm::names; -1: none
  std::int64_t line = 0;              ///< line of its `curv`, `curv2` or `surf`
};

/// A curve in space (`curv`) or in parameter space (`curv2`).
struct FreeFormCurve : FreeFormElement {
  FreeFormDirection u;
};

/// A surface (`surf`). Control point (i, j) is number i + j * u.count.
struct FreeFormSurface : FreeFormElement {
  FreeFormDirection u, v;
  std::vector<Index> texture, normals;  ///< number for each control point; empty: none
  std::vector<FreeFormLoop> loops;
};

/// True if loops trim the surface or cut holes into it.
inline bool is_trimmed(const FreeFormSurface& surface) {
  return std::ranges::any_of(surface.loops,
                             [](const FreeFormLoop& loop) { return loop.kind != FreeFormLoop::Kind::scrv; });
}

/// A connection (`con`): curves along which two surfaces meet.
struct FreeFormConnection {
  Index surfaces[2] = {0, 0};
  FreeFormCurvePart parts[2];
  std::int64_t line = 0;
};

/// The free-form elements of a file. Plain data.
struct FreeForm {
  Points vertices;                        ///< #v x 3
  std::vector<double> weights;            ///< weights of vertices; 1 where the file has none
  Points parameters;                      ///< #vp x 2, points of parameter space; v is 0 where the file has none
  std::vector<double> parameter_weights;  ///< weights of points of parameter space; 1 where the file has none
  Points texture;                         ///< #vt x 3, 0 where the file has none
  Points normals;                         ///< #vn x 3

  std::vector<FreeFormCurve> curves;     ///< in space
  std::vector<FreeFormCurve> curves_2d;  ///< in parameter space
  std::vector<FreeFormSurface> surfaces;
  std::vector<FreeFormConnection> connections;

  std::vector<FreeFormMatrix> matrices;
  std::vector<std::string> names;     ///< names of groups and objects
  std::int64_t num_faces = 0;         ///< number of polygons in the file, which are not read
  std::vector<std::string> warnings;  ///< reservations of the reader, each with file:line
};

/// Reads the free-form curves and surfaces of a file. B-splines without their first and last knot, as openNURBS writes
/// them, get these knots doubled; ranges are cut to the domain; both give a warning.
/// @throws FormatError    statements that cannot be understood, with file:line and what would be right: counts that do
///                        not fit together, decreasing knots, missing state, statements out of place
/// @throws InvalidMesh    indices out of range, numbers that are not finite, weights that are all 0, a file without
///                        free-form elements
/// @throws IoError        a file that is missing or cannot be read
/// @throws ResourceError  more elements than memory or 32-bit indices hold
FreeForm read_free_form(const std::filesystem::path& path);

/// Reads free-form curves and surfaces from text. Memory is proportional to the length of the text.
/// @param name  name of the text, with which messages start
/// @throws as `read_free_form`, but for IoError
FreeForm parse_free_form(std::string_view text, std::string_view name);

/// Returns curves and surfaces as the text of a file. Numbers have the shortest form that reads back to the same bits;
/// curves in parameter space come first, since surfaces refer to them; long statements are continued after 100 columns.
/// @throws InvalidParameter  counts or indices that do not fit together
/// @throws InvalidMesh       numbers that are not finite
std::string format_free_form(const FreeForm& shapes);

/// Writes curves and surfaces to a file, which appears whole or not at all.
/// @throws InvalidParameter, InvalidMesh  as `format_free_form`
/// @throws IoError                        a file that cannot be written
void write_free_form(const std::filesystem::path& path, const FreeForm& shapes);

}  // namespace sublimit
