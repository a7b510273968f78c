// SPDX-License-Identifier: Apache-2.0
#pragma once
// Implementation of the C interface: the table behind its handles, and exceptions turned into statuses.
#include <memory>
#include <string>
#include <utility>
#include <variant>

#include "sublimit/eval/eval.h"
#include "sublimit/eval/evaluate/pattern_evaluator.h"
#include "sublimit/eval/table/baked_table.h"

namespace sublimit::c {

/// A table with its evaluator.
template <class Real>
struct Handle {
  BakedTable<Real> baked;
  PatternEvaluator<Real> evaluator;
  Handle(BakedTable<Real> table, std::uint32_t flags)
      : baked(std::move(table)), evaluator(baked.table, {.reproducible = (flags & SUBLIMIT_REPRODUCIBLE) != 0}) {}
  Handle(const Handle&) = delete;
};

/// Returns the status of the current exception, and keeps its message for `sublimit_last_error`.
sublimit_status status_of_exception() noexcept;

/// Calls `body`, and returns the status of its exception, if any.
template <class Body>
sublimit_status guarded(const Body& body) noexcept {
  try {
    body();
    return SUBLIMIT_OK;
  } catch (...) {
    return status_of_exception();
  }
}

/// Checks a pointer.
/// @throws InvalidParameter  a null pointer
void check_pointer(const void* pointer, const char* name);
/// Checks flags.
/// @throws InvalidParameter  unknown flags
void check_flags(std::uint32_t flags);

}  // namespace sublimit::c

struct sublimit_table {
  std::variant<std::monostate, sublimit::c::Handle<float>, sublimit::c::Handle<double>> of;
};

namespace sublimit::c {

/// Makes a handle for a table, and stores it in `*table`.
template <class Real>
void hand_out(BakedTable<Real> baked, std::uint32_t flags, sublimit_table** table) {
  auto handle = std::make_unique<sublimit_table>();
  handle->of.template emplace<Handle<Real>>(std::move(baked), flags);
  *table = handle.release();
}

}  // namespace sublimit::c
