// SPDX-License-Identifier: Apache-2.0
#pragma once
// Numbers that a table keeps: in memory of its own, or where they lie in a file that is mapped.
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace sublimit {

/// Never changes; copies share what they hold. One that was moved from is empty.
template <class T>
class SharedArray {
 public:
  SharedArray() = default;
  // Implicit: a vector is what most arrays are made as.
  SharedArray(std::vector<T> numbers) {
    auto kept = std::make_shared<const std::vector<T>>(std::move(numbers));
    numbers_ = *kept;
    owner_ = std::move(kept);
  }
  SharedArray(std::initializer_list<T> numbers) : SharedArray(std::vector<T>(numbers)) {}
  /// @param owner  keeps `numbers` where they are
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
  std::int64_t num_bytes() const { return static_cast<std::int64_t>(numbers_.size_bytes()); }

 private:
  std::span<const T> numbers_;
  std::shared_ptr<const void> owner_;
};

}  // namespace sublimit
