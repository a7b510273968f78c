// SPDX-License-Identifier: Apache-2.0
#pragma once
// The report on the smoothness of the free-form curves and surfaces of a file: how patches and pieces meet, measured
// and, if numbers are those of the file, decided without rounding; vertices; degeneracies.
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
  /// Sides and ends that no other one meets, and that are as near as that, relative to the diagonal of all control
  /// points: a gap, measured.
  double near = 1e-3;
};

/// Joins that are asked for, whether the pieces meet or not: of each the left piece with the right one.
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

/// Nets of `shapes` without rounding, where they are known: by surface, and by curve as its pieces.
struct ExactShapes {
  std::vector<std::optional<SeamNet<Rational>>> surfaces;
  std::vector<std::optional<std::vector<BezierPiece<Rational>>>> curves;
};

struct ReportedSeam {
  PatchSeam seam;
  std::optional<JoinOrders> exact{};
  /// The sides are farther apart than sides that are one: found as near ones.
  bool is_gap = false;
  std::vector<Eigen::Vector3d> line{};  ///< points of the first line, or of its part
  std::string recipe{};                 ///< recipe that requires this join; empty: none
};

/// Largest deviations of all that was compared.
struct JoinDeviation {
  std::optional<double> gap, angle_degrees, curvature;  ///< curvature: the jump as a part of the curvature
  std::size_t compared = 0;
};

struct JoinExcess {
  bool is_joint = false;  ///< true: a joint of curves; false: a seam of patches
  std::size_t number = 0;
  const char* what = "g0";
  double value = 0;
  Eigen::Vector3d place = Eigen::Vector3d::Zero();
};

/// "G^1 everywhere but 4 seams: ..."
struct JoinVerdict {
  int g = -1;  ///< continuity of most seams or joints; undefined if none was compared
  std::size_t compared = 0, exceptions = 0;
  std::string says;
};

struct FreeFormWarning {
  AssetWarning::Severity severity = AssetWarning::Severity::hint;
  std::string says, advice;
  std::vector<std::size_t> patches = {}, curves = {};  ///< the first ones
  std::int64_t count = 1;
  std::optional<Eigen::Vector3d> place = {};
  std::string recipe = {};  ///< the first one, if it is of such that are neither
};

/// Points of a curve's pieces with their curvature vectors, for a comb.
struct CurvePicture {
  std::vector<std::vector<Eigen::Vector3d>> points;
  std::vector<std::vector<std::optional<Eigen::Vector3d>>> curvature;
};

struct FreeFormPicture {
  AssetSurface surface;                        ///< without curvature; empty where it would be huge
  std::vector<std::vector<Index>> isolines{};  ///< vertices of `surface`
  Points net;                                  ///< control points, those of weight 0 left out
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

  std::vector<ReportedSeam> seams;  ///< compared ones first, the worst first; then by kinds
  Index smooth_lines = 0;           ///< knot lines that are C^2 by their knots: not looked at
  std::size_t boundary_loops = 0;   ///< loops of sides without a partner
  std::vector<SeamVertex> vertices;
  FreeFormJoints joints;  ///< the worst first
  JoinDeviation seam_deviation, joint_deviation;
  std::optional<JoinVerdict> seam_verdict, joint_verdict;  ///< nothing without surfaces, without curves
  std::optional<bool> within_tolerance{};  ///< nothing where none is asked for, or nothing could be compared with it
  std::vector<JoinExcess> beyond;          ///< joins beyond the tolerance, the worst of each kind, descending
  std::vector<FreeFormWarning> warnings;
  FreeFormPicture picture;

  double diagonal() const { return (box_max - box_min).norm(); }
};

/// @param name   of the file, for messages
/// @param joins  the last surfaces and curves of `shapes`, two for each, in their order; no other joins of these are
///               looked for
/// @param exact  of the first surfaces and curves of `shapes`, whose numbers are then not those that exact verdicts are
///               about; of these nothing is decided exactly where no net is known. Null: the numbers are the file's own
/// @throws UnsupportedTopology  neither curves in space nor surfaces
/// @throws InvalidParameter     knots that make no B-spline, with the line
/// @note  Deterministic: same build and input, same report.
FreeFormReport free_form_report(FreeForm shapes, const std::string& name, const FreeFormReportOptions& options = {},
                                const GivenJoins& joins = {}, const ExactShapes* exact = nullptr);

namespace free_form_detail {

/// A seam's or joint's jump of curvature as a part of the greater curvature, or of that of a sphere in the box.
double part_of_curvature(double jump, double greatest, double diagonal);

/// "between patch 3 and patch 7", "inside patch 3 at u = 1".
std::string words_of(const PatchSeam& seam, const SplinePatches& patches);
std::string words_of(const FreeFormJoint& joint);

/// The parameter of a line across it.
double line_parameter(const SplinePatches& patches, const PatchLine& line);

JoinVerdict seam_verdict(const FreeFormReport& report);
JoinVerdict joint_verdict(const FreeFormReport& report);

/// Loops and chains that boundary sides make up.
std::size_t count_boundary_loops(const FreeFormReport& report, double same);

std::vector<FreeFormWarning> warnings(const FreeFormReport& report, const FreeFormReportOptions& options);

FreeFormPicture picture(const FreeFormReport& report, const FreeFormReportOptions& options);

}  // namespace free_form_detail
}  // namespace sublimit
