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

/// Tolerances across seams. Quantities whose tolerance is absent get no verdict.
struct SeamTolerance {
  std::optional<double> g0;          ///< distance, in units of the mesh; relative if `g0_of_box`
  bool g0_of_box = false;            ///< `g0` is a fraction of the diagonal of the control points' box
  std::optional<double> g1_degrees;  ///< angle between normals, degrees
  std::optional<double> g2;          ///< difference of curvatures, as a fraction of the larger one
};

/// Sets an entry of `tolerance` from text: "g0=1e-9", "g0=0.01%", "g1=0.1deg", "g1=0.002rad", "g2=5%". Without
/// a unit g0 is a length, g1 is in degrees and g2 is a fraction.
/// @throws InvalidOption  another name or unit, not a number, a negative number
void read_tolerance(const std::string& text, SeamTolerance& tolerance);

struct AssetOptions {
  SeamTolerance tolerance = {};
  std::int64_t curvature_samples = 400'000;  ///< about the most samples, but at least one per face
  Index surface_faces = 8000;                ///< most faces of the surface in pictures, but at least one per face
  int levels = 4;                            ///< levels that viewers refine to, for the warning on sharper creases
  Index listed = 20;                         ///< most entries of lists: worst seams, examples of each kind
};

/// Existence of a tangent plane at a point, according to its local matrix.
enum class PlaneVerdict { yes, slow, no, unknown };
enum class CurvatureVerdict { flat, bounded, logarithmic, divergent, unknown };
struct PointVerdict {
  PlaneVerdict plane = PlaneVerdict::unknown;
  CurvatureVerdict curvature = CurvatureVerdict::unknown;
  std::optional<double> ratio;  ///< mu/lambda^2; with two lambdas the larger if curvature diverges, else the smaller
};
const char* name(PlaneVerdict verdict);
const char* name(CurvatureVerdict verdict);

/// Points of one kind.
struct AssetKind {
  std::string kind;               ///< a phrase of report_format.md: "extraordinary vertex"
  Index n = 0;                    ///< valence, corners, or faces
  std::vector<Index> sides = {};  ///< faces of each side, at vertices on sharp edges or borders
  std::int64_t count = 0;
  std::vector<Index> examples =
      {};  ///< vertices; faces where `kind` is a face's; edges by their two vertices, in a row
  std::optional<PointVerdict> verdict = {};
  std::optional<std::array<double, 2>> sharpness = {};  ///< range of sharpness of semi-sharp edges or vertices
};

/// Largest deviations; absent if nothing could be compared.
struct SeamDeviation {
  std::optional<double> g0, g1_degrees, g2;
  std::int64_t compared = 0;  ///< pairs of samples
};
struct SeamExcess {
  enum class At { edge, patch, point } at = At::edge;
  std::array<Index, 2> edge{-1, -1};  ///< vertices of the edge; at a point its vertex, twice
  Index face = -1;                    ///< control face
  const char* what = "g0";
  double value = 0;
  Index address = 0;  ///< place in one of the faces that meet at the seam
  double u = 0, v = 0;
  Eigen::Vector3d place = Eigen::Vector3d::Zero();
};
struct AssetSeams {
  std::int64_t edges = 0, crease_edges = 0, border_edges = 0, patch_seams = 0;
  SeamDeviation inside;                    ///< across smooth edges, and across seams of patches inside faces
  SeamDeviation across_creases;            ///< across creases, where jumps are expected; g1: sharpest crease
  SeamDeviation around_points;             ///< between faces around extraordinary points, at distance 2^-10
  std::optional<bool> within_tolerance{};  ///< absent without a tolerance, or if nothing was compared
  std::vector<SeamExcess> beyond;          ///< seams beyond the tolerance, the worst of each kind, descending
  std::vector<SeamExcess> worst;           ///< worst seam for each quantity and kind of seam, whatever the tolerance
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
  std::int64_t samples = 0, without = 0;  ///< number of samples; of those without second derivatives
  double area = 0;
  std::optional<CurvatureRange> gauss, mean;
  std::optional<double> total_gauss;  ///< integral of the Gauss curvature: 2 pi chi on smooth closed surfaces
  std::int64_t unbounded_at = 0;      ///< interior points with divergent or logarithmic curvature
  std::vector<AssetPlace> worst;
};

/// A sampled limit. Points that faces share occur once.
struct AssetSurface {
  Points positions, normals;  ///< #x3; normals are zero where undefined
  std::vector<Index> face_sizes, face_vertices;
  /// Mean and Gauss curvature; absent if there are no second derivatives at the point and next to it.
  std::vector<std::optional<std::array<double, 2>>> curvature;
};

struct AssetWarning {
  enum class Severity { error, warning, hint } severity = Severity::hint;
  std::string says, advice;
  std::vector<Index> vertices = {};  ///< the first vertices concerned
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

/// Returns the report on a mesh.
/// @param progress  if given, called by one thread with the amounts of work done and in all
/// @throws InvalidMesh, UnsupportedTopology  a mesh that the scheme cannot take, or coordinates above 1e150 in size
/// @throws InvalidOption                     a negative tolerance or an option below 1
/// @note  Deterministic: same build and input, same report, for any number of threads.
AssetReport asset_report(const Scheme<double>& scheme, const Mesh& mesh, const SubdivisionOptions& subdivision = {},
                         const AssetOptions& options = {}, const std::function<void(int, int)>& progress = {});

}  // namespace sublimit
