// SPDX-License-Identifier: Apache-2.0
#pragma once
// The report on the smoothness of the limit of one mesh: kinds of points and the scheme's behaviour there, how well
// patches meet, curvature, and changes that a modeller could make. Deviations are measured on exact limits, and
// verdicts on points come from the scheme's matrices. Both are computed in floating point: nothing here is a proof.
#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "sublimit/scheme/refine.h"

namespace sublimit {

/// Tolerances across seams. There are no verdicts on absent ones.
struct SeamTolerance {
  std::optional<double> g0;          ///< distance, in units of the mesh, or of its box
  bool g0_of_box = false;            ///< `g0` is a part of the diagonal of the control points' box
  std::optional<double> g1_degrees;  ///< angle of normals
  std::optional<double> g2;          ///< difference of the curvatures, a part of the larger one
};

/// Reads "g0=1e-9", "g0=0.01%", "g1=0.1deg", "g1=0.002rad", "g2=5%" into `tolerance`; without a unit g0 is a length, g1
/// degrees and g2 a part.
/// @throws InvalidOption  another name or unit, no number, a negative one
void read_tolerance(const std::string& text, SeamTolerance& tolerance);

struct AssetOptions {
  SeamTolerance tolerance = {};
  std::int64_t curvature_samples = 400'000;  ///< at most about so many, but one a face
  Index surface_faces = 8000;                ///< most faces of the surface in pictures, but at least one per face
  int levels = 4;     ///< levels of refinement of viewers: sharper creases are not resolved by them
  Index listed = 20;  ///< worst seams, and examples of each kind
};

/// Whether there is a tangent plane at a point, by its local matrix.
enum class PlaneVerdict { yes, slow, no, unknown };
enum class CurvatureVerdict { flat, bounded, logarithmic, divergent, unknown };
struct PointVerdict {
  PlaneVerdict plane = PlaneVerdict::unknown;
  CurvatureVerdict curvature = CurvatureVerdict::unknown;
  std::optional<double> ratio;  ///< mu/lambda^2; of two lambdas the larger one where it diverges, else the smaller
};
const char* name(PlaneVerdict verdict);
const char* name(CurvatureVerdict verdict);

/// Points of one kind.
struct AssetKind {
  std::string kind;               ///< a phrase of report_format.md: "extraordinary vertex"
  Index n = 0;                    ///< valence, corners, or faces
  std::vector<Index> sides = {};  ///< faces of each side, of vertices that sharp edges or borders cut
  std::int64_t count = 0;
  std::vector<Index> examples =
      {};  ///< vertices; faces where `kind` is a face's; edges by their two vertices, in a row
  std::optional<PointVerdict> verdict = {};
  std::optional<std::array<double, 2>> sharpness = {};  ///< least and greatest, of semi-sharp ones
};

/// Largest deviations; nothing where nothing could be compared.
struct SeamDeviation {
  std::optional<double> g0, g1_degrees, g2;
  std::int64_t compared = 0;  ///< pairs of samples
};
struct SeamExcess {
  enum class At { edge, patch, point } at = At::edge;
  std::array<Index, 2> edge{-1, -1};  ///< vertices; of a point the one, twice
  Index face = -1;                    ///< control face
  const char* what = "g0";
  double value = 0;
  Index address = 0;  ///< the place in one of the faces that meet there
  double u = 0, v = 0;
  Eigen::Vector3d place = Eigen::Vector3d::Zero();
};
struct AssetSeams {
  std::int64_t edges = 0, crease_edges = 0, border_edges = 0, patch_seams = 0;
  SeamDeviation inside;                    ///< across smooth edges, and across seams of patches inside faces
  SeamDeviation across_creases;            ///< expected; g1 is the sharpest crease
  SeamDeviation around_points;             ///< at 2^-10 from extraordinary points, between the faces around them
  std::optional<bool> within_tolerance{};  ///< nothing where none is asked for, or nothing could be compared with it
  std::vector<SeamExcess> beyond;          ///< seams beyond the tolerance, the worst of each kind, descending
  std::vector<SeamExcess> worst;           ///< for every what and kind of seam the worst one, whatever is allowed
};

struct CurvatureRange {
  double min = 0, max = 0, mean = 0;  ///< mean: weighted by area
  std::array<double, 7> quantiles{};  ///< quantiles by area: 0.01, 0.05, 0.25, 0.5, 0.75, 0.95, 0.99
};
struct AssetPlace {
  std::string what;
  double value = 0;
  Index face = 0;  ///< address
  double u = 0, v = 0;
  Eigen::Vector3d place = Eigen::Vector3d::Zero();
};
struct AssetCurvature {
  std::int64_t samples = 0, without = 0;  ///< taken; and those of them without second derivatives
  double area = 0;
  std::optional<CurvatureRange> gauss, mean;
  std::optional<double> total_gauss;  ///< integral of the Gauss curvature: 2 pi chi on smooth closed surfaces
  std::int64_t unbounded_at = 0;      ///< points where the scheme's curvature diverges
  std::vector<AssetPlace> worst;
};

/// A sampled limit, shared points once.
struct AssetSurface {
  Points positions, normals;  ///< #x3; normals zero where there is none
  std::vector<Index> face_sizes, face_vertices;
  /// Mean and Gauss; nothing where there are no second derivatives even next to the point.
  std::vector<std::optional<std::array<double, 2>>> curvature;
};

struct AssetWarning {
  enum class Severity { error, warning, hint } severity = Severity::hint;
  std::string says, advice;
  std::vector<Index> vertices = {};  ///< the first ones
  std::vector<Index> faces = {};
  std::int64_t count = 1;  ///< number of similar places
  std::optional<Eigen::Vector3d> place = {};
};

struct [[nodiscard]] AssetReport {
  std::string scheme;
  Index vertices = 0, faces = 0, edges = 0;
  Eigen::Vector3d box_min = Eigen::Vector3d::Zero(),
                  box_max = Eigen::Vector3d::Zero();  ///< bounding box of the control points
  SeamTolerance tolerance = {};
  std::vector<AssetKind> inventory;
  AssetSeams seams;
  AssetCurvature curvature;
  AssetSurface surface;
  std::vector<AssetPlace> worst;
  std::vector<AssetWarning> warnings;
};

/// @param progress  called with what is done and what there is to do, by one thread, if given
/// @throws InvalidMesh, UnsupportedTopology  a mesh that the scheme cannot take, or coordinates above 1e150 in size
/// @throws InvalidOption                     a negative tolerance or an option below 1
/// @note  Deterministic: same build and input, same report, for any number of threads.
AssetReport asset_report(const Scheme<double>& scheme, const Mesh& mesh, const SubdivisionOptions& subdivision = {},
                         const AssetOptions& options = {}, const std::function<void(int, int)>& progress = {});

}  // namespace sublimit
