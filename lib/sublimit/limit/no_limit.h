// SPDX-License-Identifier: Apache-2.0
#pragma once
// The error of a place that has no limit, or none that is known: to be mended in the mesh, or in a scheme that
// diverges.
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

/// How reasons begin if powers of a local matrix do not converge: the scheme diverges around all points of that type.
inline constexpr std::string_view local_divergence = "a local matrix has no limit";

/// Error of `limit` and of surfaces: names the place, the reason, and what would help.
struct NoLimit : AnalysisError {
  /// @param where  in words: "the middle of face 7"
  /// @param why    what is known of it
  NoLimit(const std::string& where, const std::string& why)
      : AnalysisError("no limit at " + where + ": " + why + advice(why)), reason(why) {}
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
