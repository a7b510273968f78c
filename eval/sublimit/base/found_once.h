// SPDX-License-Identifier: Apache-2.0
#pragma once
// Values that are found when they are first asked for: by one thread, once, and kept.
//
// Finding often runs loops of its own. Who waits for these must not take up other work meanwhile: a block of an outer
// loop may ask for the very value that is being found below it on the same stack, and would wait for ever. So finding
// is isolated: its thread takes up nothing but tasks of its own loops. As long as no value needs itself, a thread that
// waits for a value waits for one that goes on.
#include <tbb/concurrent_map.h>
#include <tbb/concurrent_unordered_map.h>
#include <tbb/task_arena.h>

#include <atomic>
#include <exception>
#include <optional>
#include <tuple>
#include <type_traits>
#include <utility>

#include "sublimit/base/error.h"

namespace sublimit {

/// A value found once, shared between threads. It never changes, and stays as long as this.
///
/// Errors: an `AnalysisError` is an answer like any other ("there is no limit here"): it is kept, and thrown to all
/// that ask. Whatever else is thrown tells of the moment (no memory, an interruption, an error of the caller's own
/// code): it is thrown to the thread that was finding, and the next one that asks, or waits, tries again.
template <class T>
class FoundOnce {
 public:
  FoundOnce() = default;
  FoundOnce(const FoundOnce&) = delete;
  FoundOnce& operator=(const FoundOnce&) = delete;

  /// The value; find() where it is not known. Threads that ask meanwhile wait.
  /// @param find  returns a T; it must not ask for this value, nor may what it asks for
  template <class Find>
  const T& get(const Find& find) const {
    if (state_.load(std::memory_order_acquire) != State::known) find_or_wait(find);
    return *value_;
  }
  /// The value if it is known, else null. Does not wait.
  const T* known() const { return state_.load(std::memory_order_acquire) == State::known ? &*value_ : nullptr; }

 private:
  enum class State : int { unknown, being_found, known, impossible };

  template <class Find>
  void find_or_wait(const Find& find) const {
    for (State state = state_.load(std::memory_order_acquire); state != State::known;) {
      if (state == State::impossible) std::rethrow_exception(why_);
      if (state == State::being_found) {
        state_.wait(state, std::memory_order_acquire);
        state = state_.load(std::memory_order_acquire);
      } else if (state_.compare_exchange_weak(state, State::being_found, std::memory_order_acquire)) {
        return find_now(find);
      }
    }
  }

  template <class Find>
  void find_now(const Find& find) const {
    try {
      tbb::this_task_arena::isolate([&] { value_.emplace(find()); });
    } catch (const AnalysisError&) {
      why_ = std::current_exception();
      publish(State::impossible);
      throw;
    } catch (...) {
      publish(State::unknown);
      throw;
    }
    publish(State::known);
  }

  void publish(State state) const {
    state_.store(state, std::memory_order_release);
    state_.notify_all();
  }

  mutable std::atomic<State> state_{State::unknown};
  mutable std::optional<T> value_;
  mutable std::exception_ptr why_;  // it is impossible
};

/// A dictionary of such values: each is found once, by one thread, while others find others. No lock is held meanwhile.
///
/// @tparam Hash  of keys; without one they are ordered by <
template <class Key, class T, class Hash = void>
class FoundByKey {
 public:
  FoundByKey() = default;
  FoundByKey(FoundByKey&&) = default;  ///< while nobody else has it
  FoundByKey& operator=(FoundByKey&&) = default;

  /// The value of a key, by find() where it is not known. See `FoundOnce`. The reference stays valid as long as this.
  template <class Find>
  const T& get(const Key& key, const Find& find) const {
    auto at = entries_.find(key);
    if (at == entries_.end())
      at = entries_.emplace(std::piecewise_construct, std::forward_as_tuple(key), std::tuple<>()).first;
    return at->second.get(find);
  }
  /// The value if it is known, else null. Does not wait.
  const T* known(const Key& key) const {
    const auto at = entries_.find(key);
    return at == entries_.end() ? nullptr : at->second.known();
  }
  /// Adds a value; what is known already stays.
  void add(const Key& key, T value) {
    get(key, [&] { return std::move(value); });
  }
  /// Calls visit(key, value) for all that are known: by keys in ascending order, or, with a hash, in any.
  template <class Visit>
  void for_each(const Visit& visit) const {
    for (const auto& [key, entry] : entries_)
      if (const T* value = entry.known()) visit(key, *value);
  }
  /// Values that are known; counts them.
  size_t size() const {
    size_t count = 0;
    for_each([&](const Key&, const T&) { ++count; });
    return count;
  }

 private:
  using Entries = std::conditional_t<std::is_void_v<Hash>, tbb::concurrent_map<Key, FoundOnce<T>>,
                                     tbb::concurrent_unordered_map<Key, FoundOnce<T>, Hash>>;
  mutable Entries entries_;
};

}  // namespace sublimit
