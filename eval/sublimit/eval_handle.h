// SPDX-License-Identifier: Apache-2.0
#pragma once
// What the C interface hands out, and how exceptions end at its door. No part of the interface.
#include <memory>
#include <string>
#include <utility>
#include <variant>

#include "sublimit/baked_table.h"
#include "sublimit/eval.h"
#include "sublimit/pattern_evaluator.h"

namespace sublimit::c {

template <class Real>
struct Handle {
  BakedTable<Real> baked;
  PatternEvaluator<Real> evaluator;
  Handle(BakedTable<Real> table, std::uint32_t flags)
      : baked(std::move(table)), evaluator(baked.table, {.reproducible = (flags & SUBLIMIT_REPRODUCIBLE) != 0}) {}
  Handle(const Handle&) = delete;
};

/// For the exception in flight; keeps its message for `sublimit_last_error`.
sublimit_status status_of_exception() noexcept;

/// Runs `body`; what it throws becomes a status.
template <class Body>
sublimit_status guarded(const Body& body) noexcept {
  try {
    body();
    return SUBLIMIT_OK;
  } catch (...) {
    return status_of_exception();
  }
}

/// @throws InvalidParameter  a null pointer
void check_pointer(const void* pointer, const char* name);
/// @throws InvalidParameter  unknown ones
void check_flags(std::uint32_t flags);

}  // namespace sublimit::c

struct sublimit_table {
  std::variant<std::monostate, sublimit::c::Handle<float>, sublimit::c::Handle<double>> of;
};

namespace sublimit::c {

/// A handle for a table, put where the caller wants it.
template <class Real>
void hand_out(BakedTable<Real> baked, std::uint32_t flags, sublimit_table** table) {
  auto handle = std::make_unique<sublimit_table>();
  handle->of.template emplace<Handle<Real>>(std::move(baked), flags);
  *table = handle.release();
}

}  // namespace sublimit::c
