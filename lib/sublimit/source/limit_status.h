// SPDX-License-Identifier: Apache-2.0
#pragma once
// The status of a place: which position, derivatives and normal a surface or curve has there.
//
//   const LimitSamples samples = surface.evaluate({{.face = 0, .u = 0, .v = 0}}, 1);
//   if (!has_position(samples.status[0])) std::cerr << "no point: " << name(samples.status[0]) << "\n";
//
// Where nothing can be said of the limit, as the scheme diverges or the mesh is no surface there, NoLimit is thrown:
//
//   try {
//     const Limit limit = sublimit::limit(mesh, "catmull-clark");
//   } catch (const NoLimit& error) {
//     std::cerr << error.what() << "\n";  // error.vertex, error.reason
//   }
#include <string>
#include <string_view>

#include "sublimit/base/error.h"
#include "sublimit/core/types.h"

namespace sublimit {

/// The status of a place.
enum class LimitStatus {
  regular,           ///< smooth, of the scheme's regular valence
  extraordinary,     ///< smooth otherwise, darts included: characteristic tangents instead of natural derivatives
  unbounded_second,  ///< the second derivatives are unbounded or not continuous
  crease,            ///< on a crease, boundary or corner: tangents and normal are one-sided
  hole,              ///< all faces of this side are holes
  undefined_normal,  ///< there is no tangent plane, or these control points make it degenerate
  pole,              ///< no point: the denominator of a rational surface is 0
  outside,           ///< no point: the parameters are outside the domain
};
/// Number of different statuses.
constexpr int num_limit_statuses = int(LimitStatus::outside) + 1;
/// Returns the name of a status in files and messages, as "unbounded-second".
const char* name(LimitStatus status);
/// True if a place of this status has a point.
constexpr bool has_position(LimitStatus status) {
  return status != LimitStatus::outside && status != LimitStatus::pole;
}

/// How reasons begin if powers of a local matrix do not converge: the scheme diverges around all points of that type.
inline constexpr std::string_view local_divergence = "a local matrix has no limit";

/// Error of `limit` and of surfaces: names the place, the reason, and what would help. Its code is
/// unsupported_topology, as the scheme has no limit of this mesh.
struct NoLimit : AnalysisError {
  /// @param where  in words: "the middle of face 7"
  /// @param why    what is known of it
  NoLimit(const std::string& where, const std::string& why)
      : AnalysisError(ErrorCode::unsupported_topology, "no limit at " + where + ": " + why + advice(why)),
        reason(why) {}
  NoLimit(Index v, int level, const std::string& why)
      : NoLimit("vertex " + std::to_string(v) + (level == 0 ? "" : " of level " + std::to_string(level)), why) {
    vertex = v;
  }
  std::string reason;
  Index vertex = -1;  ///< of the level that limits were asked of; -1 where it is none

 private:
  static std::string advice(const std::string& why) {
    if (why.find(local_divergence) != std::string::npos)
      return "; the scheme diverges around such a point, in any mesh that has one: `analyze` of the scheme shows the "
             "eigenvalues; take another scheme, or a mesh without such points";
    return "; cut the mesh apart there (`info` lists its faults) or take another scheme";
  }
};

}  // namespace sublimit
