// SPDX-License-Identifier: Apache-2.0
#pragma once
// Continuity reports: how smooth the limits of a scheme are, with proofs, or the limit of a mesh. `mine` is a scheme of
// your own, a function of the number type (sublimit.h):
//
//   analyze("loop", {.valences = {3, 5}}).save_html("loop.html");
//   analyze(read_mesh("torus.obj"), "loop", {.tolerance = {"g1=0.1deg"}}).save_json("torus.json");
//   analyze(mine<double>(), mine<Algebraic>()).save_html("mine.html");  // <sublimit/certificates/numbers/algebraic.h>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "sublimit/mesh/mesh.h"
#include "sublimit/scheme/any_scheme.h"

namespace sublimit {

class Algebraic;

/// A continuity report, in the format of stencils/report_format.md. It never changes: threads may share it.
class Report {
 public:
  /// Makes a report of its text.
  explicit Report(std::string json) : json_(std::move(json)) {}
  const std::string& json() const& { return json_; }  ///< text of the report, JSON
  std::string json() && { return std::move(json_); }  ///< a copy, from temporaries

  /// Writes the text; the file appears whole or not at all.
  /// @throws IoError  unwritable;  ResourceError  a full disk
  void save_json(const std::filesystem::path& path) const;
  /// Writes a page with pictures, in one file that refers to no other; it appears whole or not at all.
  /// @throws FormatError  the text is not a report;  IoError  unwritable;  ResourceError  a full disk
  void save_html(const std::filesystem::path& path) const;

 private:
  std::string json_;
};

/// Options for reports on schemes.
struct AnalyzeOptions {
  std::vector<int> valences = {3, 4, 5, 6, 7, 8, 9, 10, 11, 12};  ///< valences of vertices to analyse, 3 to 100
  std::vector<std::string> claims = {};  ///< claims to check instead of the scheme's own: "extraordinary=2"
};

/// Returns a report on a scheme: smoothness on regular meshes and at extraordinary vertices, and whether its claims are
/// proved, disproved or observed.
/// @throws InvalidOption     a scheme of your own, which needs masks in exact numbers too (see below); an unknown claim
/// @throws InvalidParameter  no valences, or one outside its range
Report analyze(const AnyScheme& scheme, const AnalyzeOptions& options = {});
/// Returns a report on a scheme of your own.
/// @param exact  the scheme's masks in exact numbers (<sublimit/certificates/numbers/algebraic.h>)
/// @throws InvalidParameter  masks that differ between both, or are incomplete; and as above
Report analyze(const Scheme<double>& scheme, const Scheme<Algebraic>& exact, const AnalyzeOptions& options = {});

/// Options for reports on meshes.
struct AnalyzeMeshOptions {
  /// Largest gaps, angles and differences of curvature across seams: "g0=1e-9", "g1=0.1deg", "g2=5%". The report has no
  /// verdict on those that are absent.
  std::vector<std::string> tolerance = {};
  std::string name = "mesh";  ///< name of the mesh in the report
};

/// Returns a report on the limit of a mesh: how smooth it is at which points and why, with seams, curvature, warnings.
/// @throws InvalidOption                     a tolerance that cannot be parsed
/// @throws InvalidMesh, UnsupportedTopology  the scheme cannot refine the mesh
Report analyze(const Mesh& mesh, const AnyScheme& scheme, const AnalyzeMeshOptions& options = {});

}  // namespace sublimit
