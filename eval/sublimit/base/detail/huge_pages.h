// SPDX-License-Identifier: Apache-2.0
#pragma once
// Large arrays in huge pages of 2 MB. In pages of 4 KB the kernel takes longer to provide memory than a program takes
// to fill it. Ask before an array is first written:
//
//   const std::unique_ptr<float[]> points(new float[count]);  // not yet written
//   prefer_huge_pages(points.get(), count * sizeof(float));
#include <sys/mman.h>
#include <unistd.h>

#include <cstddef>
#include <cstdint>

namespace sublimit {

/// Asks the system to use huge pages for the parts of an array that have not been written yet. Does nothing for arrays
/// below 2 MB and on systems without huge pages. May be called by any thread.
/// @param data   start of the array
/// @param bytes  its size
inline void prefer_huge_pages([[maybe_unused]] void* data, [[maybe_unused]] std::size_t bytes) noexcept {
#ifdef MADV_HUGEPAGE
  constexpr std::size_t huge_page = std::size_t{1} << 21;
  if (bytes < huge_page) return;
  const auto page = static_cast<std::uintptr_t>(sysconf(_SC_PAGESIZE));
  const std::uintptr_t begin = (reinterpret_cast<std::uintptr_t>(data) + page - 1) / page * page;
  const std::uintptr_t end = (reinterpret_cast<std::uintptr_t>(data) + bytes) / page * page;
  madvise(reinterpret_cast<void*>(begin), end - begin, MADV_HUGEPAGE);  // advice: a refusal changes nothing
#endif
}

}  // namespace sublimit
