// SPDX-License-Identifier: Apache-2.0
#pragma once
// Seams of the patches of a model and their continuity: lines of inner knots, periods of closed patches, sides
// that are the same curve, sides that lie on parts of others, and sides without a partner.
#include <array>
#include <optional>
#include <span>
#include <vector>

#include "sublimit/patches/joins/edge_deviation.h"
#include "sublimit/patches/joins/seam_strips.h"
#include "sublimit/patches/patch_set.h"

namespace sublimit {

/// Kind of a seam.
enum class SeamKind {
  knot,            ///< an inner knot line
  period,          ///< the start of closed knots
  sides,           ///< two sides, of one patch or of two, that are the same curve in the same parameter
  reparametrised,  ///< two sides, the same curve in different parameters: measured at nearest points, without C^k
  partial,         ///< a side, or a part of it, on a part of another one (T-junction): measured likewise
  non_manifold,    ///< three or more sides that are the same curve: not compared
  collapsed,       ///< a side that is one point: a pole
  boundary,        ///< a side without a partner
};
/// Returns the name in files and messages: `knot`, `period`, ..
std::string_view name(SeamKind kind);

/// A maximum on a seam.
struct SeamMaximum {
  double value = 0;
  double u = 0, v = 0;  ///< its parameters in the left patch
  std::array<double, 3> point = {};
};

/// A seam.
struct PatchSeam {
  SeamKind kind = SeamKind::knot;
  std::vector<PatchLine> lines{};  ///< left and right line; for `collapsed` and `boundary` one, `non_manifold` all
  double knot = 0;                 ///< knot of the first line, in the parameter across it
  /// Per line: true if its parameter runs against that of the first one.
  std::vector<bool> reversed{};
  /// True if the patches' own normals du x dv are on the same side of the surface; false if one must be reversed.
  bool same_orientation = true;
  /// Measured orders on the whole seam; absent for kinds that are not compared.
  std::optional<JoinOrders> measured{};
  std::optional<SeamMaximum> gap{}, angle{}, curvature_jump{};
  double greatest_curvature = 0;  ///< largest curvature of either patch across the seam, to compare jumps with
  /// For `partial`: the part of the first line, in its parameter.
  std::optional<std::array<double, 2>> part{};
  /// For `collapsed`: true if the surface has a normal there.
  bool has_plane = false;
  /// For `knot` and `period`: k of C^k of the columns, from the multiplicity of the knot.
  std::optional<int> columns_c{};

  bool is_compared() const { return measured.has_value(); }
};

/// A side of a patch: u = begin, u = end, v = begin, v = end.
enum class PatchSide { u_begin, u_end, v_begin, v_end };
std::string_view name(PatchSide side);
/// Returns a side of a patch as a line.
PatchLine side_line(std::span<const PatchColumns> patches, std::size_t patch, PatchSide side);

struct SeamOptions {
  /// Distance up to which sides and corners count as the same, relative to the diagonal of all control points.
  double same = 1e-6;
  JoinTolerance tolerance{};
  /// Lines of inner knots whose columns are C^k for this k are compared only if normals vanish; otherwise they
  /// are C^k and G^k.
  int smooth = 2;
};

struct PatchSeams {
  std::vector<PatchSeam> seams;
  Index smooth_lines = 0;  ///< number of lines of inner knots that were left out, see SeamOptions
  double diagonal = 0;     ///< diagonal of all control points, which tolerances are relative to
};

/// Returns all seams, ordered by kind, then by patch.
/// @throws InvalidParameter  columns of another size, or not finite; no patches
PatchSeams patch_seams(std::span<const PatchColumns> patches, Coordinates coordinates, const SeamOptions& options = {});

/// Returns the patches of a set, which must outlive them, with their parts of its columns.
/// @throws InvalidParameter  columns of another size
std::vector<PatchColumns> patch_columns(const PatchSet& set, const Points& columns);

/// Calls visit(left, right, part) for the pairs of Bezier patches along a seam of kind `knot`, `period` or
/// `sides`.
/// @param visit      receives the left patch (seam at u = 1), the right patch (u = 0), and their part of the
///                   seam
/// @param tolerance  distance of knots that count as equal, on a seam of length 1; 0 for exact numbers
template <class T, class Visit>
void for_each_strip(const SeamNet<T>& left, const SeamNet<T>& right, const PatchSeam& seam, const T& tolerance,
                    const Visit& visit) {
  const PatchLine &l = seam.lines[0], &r = seam.lines[1];
  const Knots<T>&along_left = l.along_v ? left.v : left.u, &along_right = r.along_v ? right.v : right.u;
  for (const CommonPart<T>& part : common_parts(along_left, along_right, bool(seam.reversed[1]), tolerance))
    visit(strip(left, l, true, part.left), strip(right, r, false, part.right), part);
}

}  // namespace sublimit
