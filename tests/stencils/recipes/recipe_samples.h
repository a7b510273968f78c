// SPDX-License-Identifier: Apache-2.0
#pragma once
// A small recipe of each kind.
#include <string>
#include <utility>
#include <vector>

namespace sublimit::testing {

/// Returns the kinds with their fields, without the braces.
inline const std::vector<std::pair<std::string, std::string>>& sample_fields() {
  static const std::string segment = R"({"degree": 1, "knots": [0, 0, 1, 1], "points": )";
  static const std::string boundary = R"("c0": )" + segment + R"([[0, 0, 0], [1, 0, 0]]}, "c1": )" + segment +
                                      R"([[0, 1, 0], [1, 1, 1]]}, "d0": )" + segment +
                                      R"([[0, 0, 0], [0, 1, 0]]}, "d1": )" + segment + R"([[1, 0, 0], [1, 1, 1]]})";
  // Of z = u v: S_v(u,0) = (0, 1, 0), S_v(u,1) the same; twists (0, 0, 1).
  static const std::string fields = R"("xv0": )" + segment + R"([[0, 1, 0], [0, 1, 1]]}, "xv1": )" + segment +
                                    R"([[0, 1, 0], [0, 1, 1]]}, "xu0": )" + segment +
                                    R"([[1, 0, 0], [1, 0, 1]]}, "xu1": )" + segment + R"([[1, 0, 0], [1, 0, 1]]})";
  static const std::string quadratic = R"({"degree": 2, "knots": [0, 0, 0, 1, 1, 1], "points": )";
  static const std::vector<std::pair<std::string, std::string>> all{
      {"bezier_curve", R"("degree": 2, "points": [[0, 0], ["1/2", 1], [1, 0]], "domain": [0, 2])"},
      {"bmatrix_curve",
       R"("degree": 1, "step": 1, "matrix": [[1, -1], [0, 1]], "points": [[0, 0], [1, 0], [1, 1]], "parm": [0, 1, 3])"},
      {"taylor_curve", R"("points": [[0, 0, 0], [1, 0, 0], [0, 1, 0]])"},
      {"lagrange_curve", R"("nodes": [0, 1, 3], "points": [[0, 0], [1, 1], [2, 0]])"},
      {"hermite_curve", R"("points": [[0, 0], [1, 0]], "tangents": [[0, 1], [0, -1]])"},
      {"bspline_curve", R"("degree": 2, "knots": [0, 1, 2, 3], "closed": true, "points": [[0, 0], [1, 0], [0, 1]])"},
      {"nurbs_curve", R"("degree": 2, "knots": [0, 0, 0, 1, 1, 1], "homogeneous": [[1, 0, 1], [1, 1, 1], [0, 2, 2]])"},
      {"interpolate_bspline", R"("degree": 2, "parameters": [0, 1, 2, 4], "points": [[0, 0], [1, 1], [2, 0], [3, 3]])"},
      {"interpolate_cubic",
       R"("ends": "natural", "parameters": [0, 1, 2], "points": [[0, 0, 0], [1, 1, 0], [2, 0, 1]])"},
      {"bezier_surface", R"("degree": [1, 1], "points": [[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 1]])"},
      {"bezier_triangle", R"("degree": 1, "points": [[0, 0, 0], [1, 0, 0], [0, 1, 0]])"},
      {"bspline_surface",
       R"("degree": [1, 2], "knots_u": [0, 1], "knots_v": [0, 0, 1, 1], "shape": [2, 3], "points": [[0, 0, 0], [1, 0, 0], [0, 1, 1], [1, 1, 1], [0, 2, 0], [1, 2, 0]])"},
      {"nurbs_surface",
       R"("degree": [1, 1], "knots_u": [0, 0, 1, 1], "knots_v": [0, 0, 1, 1], "shape": [2, 2], "homogeneous": [[0, 0, 0, 1], [1, 0, 0, 1], [0, 2, 0, 2], [2, 2, 2, 2]])"},
      {"functional_surface",
       R"("degree": [1, 1], "knots_u": [0, 0, 1, 1], "knots_v": [0, 0, 1, 1], "values": [0, 1, 2, 3])"},
      {"lagrange_surface",
       R"("nodes_u": [0, 1], "nodes_v": [0, 2], "points": [[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 1]])"},
      {"hermite_surface",
       R"("vectors": "12", "p": [[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0]], "pu": [[1, 0, 1], [1, 0, -1], [1, 0, 1], [1, 0, -1]], "pv": [[0, 1, 0], [0, 1, 0], [0, 1, 0], [0, 1, 0]])"},
      {"coons_bilinear", boundary},
      {"coons_bicubic", boundary + R"(, "tolerance": 1e-6)"},
      {"coons_general", boundary + ", " + fields + R"(, "twists": [[0, 0, 1], [0, 0, 1], [0, 0, 1], [0, 0, 1]])"},
      {"gregory", boundary + ", " + R"("xv0": )" + quadratic + R"([[0, 1, 0], [0, 1.5, 0], [0, 1, 1]]}, )" +
                      fields.substr(fields.find("\"xv1\""))},
      {"gordon",
       R"("curves_u": [)" + segment + R"([[0, 0, 0], [1, 0, 0]]}, )" + segment +
           R"([[0, 1, 0], [1, 1, 1]]}], "curves_v": [)" + segment + R"([[0, 0, 0], [0, 1, 0]]}, )" + segment +
           R"([[1, 0, 0], [1, 1, 1]]}], "parameters_u": [0, 1], "parameters_v": [0, 1], "blending": "lagrange")"},
      {"ruled",
       R"("c0": )" + segment + R"([[0, 0], [1, 0]]}, "c1": )" + quadratic + R"([[0, 0, 1], [1, 1, 1], [1, 0, 1]]})"},
      {"extrusion", R"("curve": )" + quadratic + R"([[0, 0], [1, 1], [2, 0]]}, "direction": [0, 0, 1])"},
      {"cone", R"("curve": )" + quadratic + R"([[0, 0], [1, 1], [2, 0]]}, "apex": [1, 0, 1])"},
      {"translational", R"("c": )" + segment + R"([[0, 0], [1, 0]]}, "d": )" + quadratic +
                            R"([[0, 0, 0], [0, 1, 1], [0, 2, 0]]}, "origin": [0, 0, 0])"},
      {"revolution",
       R"("profile": {"degree": 1, "knots": [0, 0, 1, 1], "homogeneous_xzw": [[1, 0, 1], [1, 1, 1]]}, "start_degrees": 0, "sweep_degrees": 360, "axis": {"point": [0, 0, 0], "direction": [0, 0, 1]})"},
      {"screw", R"("curve": )" + segment + R"([[0, 0, 0], [1, 0, 0]]}, "pitch": 1, "u": [0, 3])"},
      {"sweep",
       R"("section": )" + segment +
           R"([[0, 0], [1, 0]]}, "degree": 1, "knots": [0, 0, 1, 1], "origins": [[0, 0, 0], [0, 0, 1]], "matrices": [[[1, 0, 0], [0, 1, 0], [0, 0, 1]], [[0, -1, 0], [1, 0, 0], [0, 0, 1]]])"},
      {"loft",
       R"("degree_u": 1, "knots_u": [0, 0, 1, 1], "sections": [[[0, 0, 0], [1, 0, 0]], [[0, 1, 1], [1, 1, 0]], [[0, 2, 0], [1, 2, 0]]], "degree_v": 2, "parameters": [0, 1, 2])"},
      {"nielson", R"("points": [[1, 0, 0], [0, 1, 0], [0, 0, 1]], "normals": [[1, 0, 0], [0, 1, 0], [0, 0, 1]])"},
      {"piper", R"("mesh": "sphere.obj")"},
      {"curve_join",
       R"("left": {"points": [[0, 0], [1, "1/3"]], "length": 2}, "right": {"points": [[1, "1/3"], [2, 0.1]], "length": "2/3"})"},
      {"surface_join",
       R"("left": {"degree": [1, 1], "points": [[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0]]}, "right": {"degree": [1, 1], "points": [[1, 0, 0], [2, 0, 0], [1, 1, 0], [2, 1, 0]]})"},
      {"implicit", R"("field": "sphere", "center": [0, 0, 0], "radius": 1)"},
  };
  return all;
}

/// Returns a recipe of a kind, with further fields before the others.
inline std::string sample_recipe(const std::string& kind, const std::string& more = "") {
  for (const auto& [name, fields] : sample_fields())
    if (name == kind) return R"({"kind": ")" + kind + "\", " + more + fields + "}";
  return "";
}

}  // namespace sublimit::testing
