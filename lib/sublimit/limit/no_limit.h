// SPDX-License-Identifier: Apache-2.0
#pragma once
// A place that has no limit, or none that is known, though mesh and scheme are sound: to be mended in the mesh.
#include <string>

#include "sublimit/base/error.h"
#include "sublimit/core/types.h"

namespace sublimit {

struct NoLimit : AnalysisError {
  /// @param where  in words: "the middle of face 7"
  /// @param why    what is known of it
  NoLimit(const std::string& where, const std::string& why)
      : AnalysisError("no limit at " + where + ": " + why +
                      "; cut the mesh apart there (`sublimit info` lists its faults) or take another scheme"),
        reason(why) {}
  NoLimit(Index v, int level, const std::string& why)
      : NoLimit("vertex " + std::to_string(v) + (level == 0 ? "" : " of level " + std::to_string(level)), why) {
    vertex = v;
  }
  std::string reason;
  Index vertex = -1;  ///< of the level that limits were asked of; -1 where it is none
};

}  // namespace sublimit
