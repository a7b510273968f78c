// SPDX-License-Identifier: Apache-2.0
#include "sublimit/eval/gpu/detail/driver.h"

#include "sublimit/base/error.h"

namespace sublimit::gpu {

void fail_without_memory(const std::string& what) {
  throw ResourceError("the GPU has no memory left: " + what +
                      "; use a smaller table or fewer frames at once, or apply on the CPU");
}
void fail_lost(const std::string& what) {
  throw IoError(
      "the GPU was lost: " + what +
      "; its driver was reset or it stopped answering; open the device again, by CUDA in another process, or apply on the CPU");
}
void fail_otherwise(const std::string& what) {
  throw IoError("the GPU failed: " + what + "; apply on the CPU, or try a newer driver");
}
void fail_unprepared() {
  throw InvalidParameter("an evaluation that the GPU was not prepared for; call `prepare` with it first");
}

}  // namespace sublimit::gpu
