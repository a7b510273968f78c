// SPDX-License-Identifier: Apache-2.0
#include "sublimit/source/limit_status.h"

namespace sublimit {

const char* name(LimitStatus status) {
  switch (status) {
    case LimitStatus::regular:
      return "regular";
    case LimitStatus::extraordinary:
      return "extraordinary";
    case LimitStatus::unbounded_second:
      return "unbounded-second";
    case LimitStatus::crease:
      return "crease";
    case LimitStatus::hole:
      return "hole";
    case LimitStatus::undefined_normal:
      return "undefined-normal";
    case LimitStatus::pole:
      return "pole";
    default:
      return "outside";
  }
}

}  // namespace sublimit
