// SPDX-License-Identifier: Apache-2.0
#pragma once
// Continuity reports:
//
//   analyze("loop", {.valences = {3, 5}}).save_html("loop.html");
//   analyze(read_mesh("torus.obj"), "loop", {.tolerance = {"g1=0.1deg"}}).save_json("torus.json");
//   analyze(mine<double>(), mine<Algebraic>()).save_html("mine.html");       // <sublimit/certificates/algebraic.h>
#include <filesystem>
#include <string>
#include <vector>

#include "sublimit/mesh/control_mesh.h"
#include "sublimit/scheme/any_scheme.h"

namespace sublimit {

class Algebraic;

/// A continuity report, in the format that stencils/report_format.md describes.
class Report {
 public:
  /// @param json  its text
  explicit Report(std::string json) : json_(std::move(json)) {}
  const std::string& json() const { return json_; }  ///< the text

  /// Writes the text; the file appears whole or not at all.
  /// @throws IoError  unwritable;  ResourceError  a full disk
  void save_json(const std::filesystem::path& path) const;
  /// Writes a page with pictures that needs nothing but itself; the file appears whole or not at all.
  /// @throws FormatError  a text that is no report;  IoError  unwritable;  ResourceError  a full disk
  void save_html(const std::filesystem::path& path) const;

 private:
  std::string json_;
};

struct AnalyzeOptions {
  std::vector<int> valences = {3, 4, 5, 6, 7, 8, 9, 10, 11, 12};  ///< 3 to 100
  std::vector<std::string> claims = {};  ///< to be looked at instead of the scheme's own: "extraordinary=2"
};

/// Returns what is proved, disproved or seen of a scheme: regular meshes, extraordinary vertices, its claims.
/// @throws InvalidOption     a scheme of your own, whose masks are needed in exact numbers too; no such claim
/// @throws InvalidParameter  no valences, or one outside its range
Report analyze(const AnyScheme& scheme, const AnalyzeOptions& options = {});
/// @param exact  the same masks, instantiated in exact numbers (<sublimit/certificates/algebraic.h>)
/// @throws InvalidParameter  masks that are not the same, or not complete
Report analyze(const Scheme<double>& scheme, const Scheme<Algebraic>& exact, const AnalyzeOptions& options = {});

struct AnalyzeMeshOptions {
  std::vector<std::string> tolerance =
      {};                     ///< across seams: "g0=1e-9", "g1=0.1deg", "g2=5%"; what is absent is not judged
  std::string name = "mesh";  ///< in the report
};

/// Returns how smooth the limit of a mesh is, where, and why: kinds of points, seams, curvature, warnings.
/// @throws InvalidOption                     a tolerance that cannot be read
/// @throws InvalidMesh, UnsupportedTopology  a mesh that the scheme cannot refine
Report analyze(const ControlMesh& mesh, const AnyScheme& scheme, const AnalyzeMeshOptions& options = {});

}  // namespace sublimit
