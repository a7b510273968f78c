// SPDX-License-Identifier: Apache-2.0
#pragma once
// Constant arrays with shared ownership: of numbers in memory, or in a file that is mapped. Tables consist of them:
//
//   const SharedArray<float> weights{0.5F, 0.25F, 0.25F};
//   const SharedArray<std::int32_t> columns = std::vector<std::int32_t>{0, 1, 2};  // or a std::vector
//   std::span<const float> numbers = weights.span();
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace sublimit {

/// A constant array. Copies share its numbers, and any number of threads may read them. Empty after a move.
template <class T>
class SharedArray {
 public:
  SharedArray() = default;
  /// Takes over the numbers of a vector.
  SharedArray(std::vector<T> numbers) {  // implicit: most arrays are made as vectors
    auto kept = std::make_shared<const std::vector<T>>(std::move(numbers));
    numbers_ = *kept;
    owner_ = std::move(kept);
  }
  /// Copies a list.
  SharedArray(std::initializer_list<T> numbers) : SharedArray(std::vector<T>(numbers)) {}
  /// Refers to numbers elsewhere.
  /// @param owner  keeps `numbers` alive; null: the caller does
  SharedArray(std::span<const T> numbers, std::shared_ptr<const void> owner)
      : numbers_(numbers), owner_(std::move(owner)) {}
  SharedArray(const SharedArray&) = default;
  SharedArray& operator=(const SharedArray&) = default;
  SharedArray(SharedArray&& other) noexcept
      : numbers_(std::exchange(other.numbers_, {})), owner_(std::move(other.owner_)) {}
  SharedArray& operator=(SharedArray&& other) noexcept {
    numbers_ = std::exchange(other.numbers_, {});
    owner_ = std::move(other.owner_);
    return *this;
  }

  operator std::span<const T>() const { return numbers_; }
  std::span<const T> span() const { return numbers_; }
  const T* data() const { return numbers_.data(); }
  size_t size() const { return numbers_.size(); }
  bool empty() const { return numbers_.empty(); }
  const T* begin() const { return data(); }
  const T* end() const { return data() + size(); }
  const T& front() const { return numbers_.front(); }
  const T& back() const { return numbers_.back(); }
  template <class I>
  const T& operator[](I i) const {
    return numbers_[static_cast<size_t>(i)];
  }
  /// Returns the size of the numbers in bytes.
  std::int64_t num_bytes() const { return static_cast<std::int64_t>(numbers_.size_bytes()); }

 private:
  std::span<const T> numbers_;
  std::shared_ptr<const void> owner_;
};

}  // namespace sublimit
