// SPDX-License-Identifier: Apache-2.0
#pragma once
// Vectors whose new elements are not set to zero. Large arrays that a parallel loop fills are then touched once, by the
// thread that fills them; they lie in huge pages if the system has some.
//
//   UninitializedVector<Index> twins(num_half_edges);  // no element has a value yet
//   for (Index h = 0; h < num_half_edges; ++h) twins[size_t(h)] = -1;
#include <cstddef>
#include <cstdint>
#include <memory>
#include <new>
#include <utility>
#include <vector>

namespace sublimit {

/// Asks the system for huge pages for an array of 2 MB or more that has not been written yet.
void advise_huge_pages(void* data, std::size_t bytes) noexcept;

/// Allocator of `UninitializedVector`: elements without arguments are default-initialised, numbers left as they are.
template <class T>
struct UninitializedAllocator : std::allocator<T> {
  template <class U>
  struct rebind {
    using other = UninitializedAllocator<U>;
  };
  UninitializedAllocator() = default;
  template <class U>
  UninitializedAllocator(const UninitializedAllocator<U>&) {}

  T* allocate(std::size_t count) {
    T* const data = std::allocator<T>::allocate(count);
    advise_huge_pages(data, count * sizeof(T));
    return data;
  }

  template <class U>
  void construct(U* at) noexcept {
    ::new (static_cast<void*>(at)) U;  // default-initialised: left as it is
  }
  template <class U, class First, class... Rest>
  void construct(U* at, First&& first, Rest&&... rest) {
    ::new (static_cast<void*>(at)) U(std::forward<First>(first), std::forward<Rest>(rest)...);
  }
};

/// A vector whose new elements have no value until they are assigned.
template <class T>
using UninitializedVector = std::vector<T, UninitializedAllocator<T>>;

/// Makes room for `count` entries of a sparse matrix, whose columns and values the caller fills in.
template <class Matrix>
void resize_nonzeros(Matrix& matrix, std::int64_t count) {
  matrix.resizeNonZeros(count);
  advise_huge_pages(matrix.innerIndexPtr(), count * sizeof(*matrix.innerIndexPtr()));
  advise_huge_pages(matrix.valuePtr(), count * sizeof(*matrix.valuePtr()));
}

}  // namespace sublimit
