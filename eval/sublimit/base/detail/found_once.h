// SPDX-License-Identifier: Apache-2.0
#pragma once
// Values that are computed on first use, once, by one thread, and kept.
//
// The computation often runs parallel loops. A thread that waits for one of these must not execute other tasks
// meanwhile: a task of an outer loop could need the value that is being computed below it on the same stack, and would
// wait for ever. Computations are therefore isolated: their threads execute only tasks of their own loops. If no value
// depends on itself, a thread that waits for a value waits for a computation that proceeds.
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

/// A value computed once and shared between threads. It never changes while this exists.
///
/// Errors: an `AnalysisError` is a result ("there is no limit here"): it is kept, and thrown by every call. Other
/// exceptions are temporary (no memory, an interruption, an error of the caller's code): they are thrown in the thread
/// that computed, and the next call, or a waiting one, computes again.
template <class T>
class ComputedOnce {
 public:
  ComputedOnce() = default;
  ComputedOnce(const ComputedOnce&) = delete;
  ComputedOnce& operator=(const ComputedOnce&) = delete;

  /// Returns the value, computed by find() at the first call. Other threads wait for it.
  /// @param find  returns a T; must not need this value, directly or indirectly
  template <class Find>
  const T& get(const Find& find) const {
    if (state_.load(std::memory_order_acquire) != State::known) find_or_wait(find);
    return *value_;
  }
  /// Returns the value if it is computed, else null. Does not wait.
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
  mutable std::exception_ptr why_;  // the AnalysisError, if there is no value
};

/// A dictionary of values, each computed once. Threads compute different values at the same time; no lock is held.
///
/// @tparam Hash  hash of keys; void: they are ordered by <
template <class Key, class T, class Hash = void>
class FoundByKey {
 public:
  FoundByKey() = default;
  FoundByKey(FoundByKey&&) = default;  ///< not while other threads use it
  FoundByKey& operator=(FoundByKey&&) = default;

  /// Returns the value of a key, computed by find() at the first call, as `ComputedOnce::get`. The reference is valid
  /// while this exists.
  template <class Find>
  const T& get(const Key& key, const Find& find) const {
    auto at = entries_.find(key);
    if (at == entries_.end())
      at = entries_.emplace(std::piecewise_construct, std::forward_as_tuple(key), std::tuple<>()).first;
    return at->second.get(find);
  }
  /// Returns the value of a key if it is computed, else null. Does not wait.
  const T* known(const Key& key) const {
    const auto at = entries_.find(key);
    return at == entries_.end() ? nullptr : at->second.known();
  }
  /// Adds a value, unless the key has one.
  void add(const Key& key, T value) {
    get(key, [&] { return std::move(value); });
  }
  /// Calls visit(key, value) for all computed values: by ascending keys, or with a hash in any order.
  template <class Visit>
  void for_each(const Visit& visit) const {
    for (const auto& [key, entry] : entries_)
      if (const T* value = entry.known()) visit(key, *value);
  }
  /// Returns the number of computed values, by counting them.
  size_t size() const {
    size_t count = 0;
    for_each([&](const Key&, const T&) { ++count; });
    return count;
  }

 private:
  using Entries = std::conditional_t<std::is_void_v<Hash>, tbb::concurrent_map<Key, ComputedOnce<T>>,
                                     tbb::concurrent_unordered_map<Key, ComputedOnce<T>, Hash>>;
  mutable Entries entries_;
};

}  // namespace sublimit
