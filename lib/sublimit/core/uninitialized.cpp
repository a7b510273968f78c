// SPDX-License-Identifier: Apache-2.0
#include "sublimit/core/uninitialized.h"

#include "sublimit/base/detail/huge_pages.h"

namespace sublimit {

void advise_huge_pages(void* data, std::size_t bytes) noexcept { prefer_huge_pages(data, bytes); }

}  // namespace sublimit
