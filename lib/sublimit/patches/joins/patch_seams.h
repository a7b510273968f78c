// SPDX-License-Identifier: Apache-2.0
#pragma once
// Where the patches of a model meet, and how: lines of inner knots, the period of closed patches, sides of patches that
// are the same curve, sides that touch parts of others, sides without a partner; and the vertices at the sides' ends.
#include <array>
#include <optional>
#include <span>
#include <vector>

#include "sublimit/patches/joins/edge_deviation.h"
#include "sublimit/patches/joins/seam_strips.h"
#include "sublimit/patches/patch_set.h"

namespace sublimit {

enum class SeamKind {
  knot,            ///< an inner knot line
  period,          ///< the start of closed knots
  sides,           ///< two sides, of one patch or of two, that are one curve in the same parameter
  reparametrised,  ///< two sides that are one curve in different parameters: measured at nearest points, no C^k
  partial,         ///< a side, or a part of it, that lies on a part of another one (T-junction): measured as those
  non_manifold,    ///< three or more sides that are one curve: not compared
  collapsed,       ///< a side that is one point: a pole
  boundary,        ///< a side without a partner
};
/// `knot`, `period`, .. as files and messages have it.
std::string_view name(SeamKind kind);

/// Where on a seam something is greatest.
struct SeamMaximum {
  double value = 0;
  double u = 0, v = 0;  ///< parameters of the left patch
  std::array<double, 3> point = {};
};

struct PatchSeam {
  SeamKind kind = SeamKind::knot;
  std::vector<PatchLine> lines{};  ///< left and right; of others one, or all of them
  double knot = 0;                 ///< of the first line, across it
  /// True for each line whose own parameter runs against that of the first one.
  std::vector<bool> reversed{};
  /// True if the patches' own normals du x dv are on the same side of the surface; false if one must be reversed.
  bool same_orientation = true;
  /// Measured orders on the whole seam; absent for kinds that are not compared.
  std::optional<JoinOrders> measured{};
  std::optional<SeamMaximum> gap{}, angle{}, curvature_jump{};
  double greatest_curvature = 0;  ///< of either patch across the seam: what a jump is a part of
  /// For `partial`: the part of the first line, in its own parameter.
  std::optional<std::array<double, 2>> part{};
  /// For `collapsed`: true if the surface has a normal there.
  bool has_plane = false;
  /// The columns' C^k as their knots' multiplicities have it; of `knot` and `period`.
  std::optional<int> columns_c{};

  bool is_compared() const { return measured.has_value(); }
};

/// A side of a patch: u = begin, u = end, v = begin, v = end.
enum class PatchSide { u_begin, u_end, v_begin, v_end };
std::string_view name(PatchSide side);
PatchLine side_line(std::span<const PatchColumns> patches, std::size_t patch, PatchSide side);

struct SeamOptions {
  /// Sides and corners as near as that, relative to the diagonal of all control points, are the same.
  double same = 1e-6;
  JoinTolerance tolerance{};
  /// Lines of inner knots whose columns are C^k with k at least this are compared only where normals vanish: elsewhere
  /// they are C^k and G^k.
  int smooth = 2;
};

struct PatchSeams {
  std::vector<PatchSeam> seams;
  Index smooth_lines = 0;  ///< lines of inner knots that were left out, see SeamOptions
  double diagonal = 0;     ///< of all control points: what tolerances are relative to
};

/// All seams, in the order of the kinds; of a kind in the order of the patches.
/// @throws InvalidParameter  columns of another size, or not finite; no patches
PatchSeams patch_seams(std::span<const PatchColumns> patches, Coordinates coordinates, const SeamOptions& options = {});

/// The patches of a set with their parts of its columns; they refer to the set.
/// @throws InvalidParameter  columns of another size
std::vector<PatchColumns> patch_columns(const PatchSet& set, const Points& columns);

/// The pairs of Bezier patches that make up a seam of kind `knot`, `period` or `sides`, in order.
/// @param visit      left patch, u = 1; right patch, u = 0; where on the seam
/// @param tolerance  knots as near as that, of a seam of length 1, are one; 0 for exact numbers
template <class T, class Visit>
void for_each_strip(const SeamNet<T>& left, const SeamNet<T>& right, const PatchSeam& seam, const T& tolerance,
                    const Visit& visit) {
  const PatchLine &l = seam.lines[0], &r = seam.lines[1];
  const Knots<T>&along_left = l.along_v ? left.v : left.u, &along_right = r.along_v ? right.v : right.u;
  for (const CommonPart<T>& part : common_parts(along_left, along_right, bool(seam.reversed[1]), tolerance))
    visit(strip(left, l, true, part.left), strip(right, r, false, part.right), part);
}

}  // namespace sublimit
