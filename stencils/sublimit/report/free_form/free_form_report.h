// SPDX-License-Identifier: Apache-2.0
#pragma once
// The report on the smoothness of the free-form curves and surfaces of a file: how patches and pieces meet,
// measured, and decided without rounding if the control points are numbers of the file; vertices; degeneracies.
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sublimit/patches/joins/seam_vertices.h"
#include "sublimit/patches/joins/surface_join.h"
#include "sublimit/report/asset/asset_report.h"
#include "sublimit/report/free_form/free_form_joints.h"
#include "sublimit/report/free_form/spline_patches.h"

namespace sublimit {

struct FreeFormReportOptions {
  /// Tolerances of gaps, angles of normals or tangents, and jumps of curvature. g2 is relative to the largest curvature
  /// of both sides, or of a sphere in the bounding box if that is larger.
  SeamTolerance tolerance = {};
  std::size_t exact_seams = 2000;  ///< most seams with exact verdicts
  Index surface_faces = 12'000;    ///< most faces of the surface in pictures
  Index listed = 20;               ///< most entries of lists: beyond the tolerance, examples in warnings
  /// Distance up to which sides or ends without a partner are compared as a gap, relative to the diagonal of
  /// the bounding box of all control points.
  double near = 1e-3;
};

/// Joins that are required between a left and a right piece, whether these meet or not.
struct GivenJoins {
  struct Curves {
    BezierPiece<double> left, right;
    BezierPiece<Rational> exact_left, exact_right;
    std::string recipe;
  };
  struct Surfaces {
    SurfaceJoin found;
    std::string recipe;
  };
  std::vector<Curves> curves;
  std::vector<Surfaces> surfaces;
};

/// Nets of surfaces and pieces of curves without rounding; absent where they are not known.
struct ExactShapes {
  std::vector<std::optional<SeamNet<Rational>>> surfaces;
  std::vector<std::optional<std::vector<BezierPiece<Rational>>>> curves;
};

struct ReportedSeam {
  PatchSeam seam;
  std::optional<JoinOrders> exact{};
  /// True if the sides do not coincide, but are near each other.
  bool is_gap = false;
  std::vector<Eigen::Vector3d> line{};  ///< points of the first line, or of the part that is joined
  std::string recipe{};                 ///< recipe that requires this join; empty: none
};

/// Largest deviations of all comparisons.
struct JoinDeviation {
  std::optional<double> gap, angle_degrees, curvature;  ///< curvature: jump relative to the curvature
  std::size_t compared = 0;
};

struct JoinExcess {
  bool is_joint = false;  ///< true: a joint of curves; false: a seam of patches
  std::size_t number = 0;
  const char* what = "g0";
  double value = 0;
  Eigen::Vector3d place = Eigen::Vector3d::Zero();
};

/// A verdict on all seams or joints: "G^1 everywhere but 4 seams: ..."
struct JoinVerdict {
  int g = -1;  ///< continuity of most seams or joints; undefined if none was compared
  std::size_t compared = 0, exceptions = 0;
  std::string says;
};

struct FreeFormWarning {
  AssetWarning::Severity severity = AssetWarning::Severity::hint;
  std::string says, advice;
  std::vector<std::size_t> patches = {}, curves = {};  ///< the first ones concerned
  std::int64_t count = 1;
  std::optional<Eigen::Vector3d> place = {};
  std::string recipe = {};  ///< the first recipe concerned, if it is neither patch nor curve
};

/// Points of a curve's pieces with their curvature vectors, for a comb.
struct CurvePicture {
  std::vector<std::vector<Eigen::Vector3d>> points;
  std::vector<std::vector<std::optional<Eigen::Vector3d>>> curvature;
};

struct FreeFormPicture {
  AssetSurface surface;                        ///< without curvature; empty if it would be huge
  std::vector<std::vector<Index>> isolines{};  ///< vertices of `surface`
  Points net;                                  ///< control points, except those of weight 0
  std::vector<std::array<Index, 2>> net_edges{};
  std::vector<CurvePicture> curves{};
};

struct [[nodiscard]] FreeFormReport {
  FreeForm shapes;  ///< curves and surfaces of the report
  SplinePatches patches;
  std::vector<CurveBezier> curves;
  std::vector<std::string> surface_recipes, curve_recipes;  ///< recipe of each; empty if the file has lines instead
  Eigen::Vector3d box_min = Eigen::Vector3d::Zero(),
                  box_max = Eigen::Vector3d::Zero();  ///< bounding box of the control points
  SeamTolerance tolerance = {};

  std::vector<ReportedSeam> seams;  ///< compared ones first, the worst ones first; then by kind
  Index smooth_lines = 0;           ///< knot lines that are C^2 by their knots, and not compared
  std::size_t boundary_loops = 0;   ///< loops of sides without a partner
  std::vector<SeamVertex> vertices;
  FreeFormJoints joints;  ///< the worst first
  JoinDeviation seam_deviation, joint_deviation;
  std::optional<JoinVerdict> seam_verdict, joint_verdict;  ///< absent without surfaces, or without curves
  std::optional<bool> within_tolerance{};                  ///< absent without a tolerance, or if nothing was compared
  std::vector<JoinExcess> beyond;  ///< joins beyond the tolerance, the worst of each kind, descending
  std::vector<FreeFormWarning> warnings;
  FreeFormPicture picture;

  double diagonal() const { return (box_max - box_min).norm(); }
};

/// Returns the report on free-form shapes.
/// @param name   name of the file, for messages
/// @param joins  required joins, for the last surfaces and curves of `shapes`, two for each join, in their
///               order. Other joins of these are not searched
/// @param exact  exact nets of the first surfaces and curves of `shapes`, whose control points are then rounded
///               ones: if a net is absent, nothing is decided exactly. Null: the control points of `shapes` are
///               exact
/// @throws UnsupportedTopology  neither curves in space nor surfaces
/// @throws InvalidParameter     knots that do not make a B-spline; the message has the line
/// @note  Deterministic: same build and input, same report.
FreeFormReport free_form_report(FreeForm shapes, const std::string& name, const FreeFormReportOptions& options = {},
                                const GivenJoins& joins = {}, const ExactShapes* exact = nullptr);

namespace free_form_detail {

/// Returns a jump of curvature relative to the greater curvature of both sides, or to that of a sphere in the
/// bounding box if that is larger.
double part_of_curvature(double jump, double greatest, double diagonal);

/// Returns words for a seam: "between patch 3 and patch 7", "inside patch 3 at u = 1".
std::string words_of(const PatchSeam& seam, const SplinePatches& patches);
std::string words_of(const FreeFormJoint& joint);

/// Returns the constant parameter of a line.
double line_parameter(const SplinePatches& patches, const PatchLine& line);

JoinVerdict seam_verdict(const FreeFormReport& report);
JoinVerdict joint_verdict(const FreeFormReport& report);

/// Returns the number of loops and chains of boundary sides.
std::size_t count_boundary_loops(const FreeFormReport& report, double same);

std::vector<FreeFormWarning> warnings(const FreeFormReport& report, const FreeFormReportOptions& options);

FreeFormPicture picture(const FreeFormReport& report, const FreeFormReportOptions& options);

}  // namespace free_form_detail
}  // namespace sublimit
