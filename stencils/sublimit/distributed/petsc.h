// SPDX-License-Identifier: Apache-2.0
#pragma once
// PETSc's objects and errors in the manner of this house.
#include <petscmat.h>
#include <petscsf.h>

#include <string>
#include <utility>

#include "sublimit/base/error.h"

namespace sublimit {

/// @throws ResourceError  out of memory;  AnalysisError  all else
inline void check_petsc(PetscErrorCode error) {
  if (error == 0) return;
  const char* text = nullptr;
  PetscErrorMessage(error, &text, nullptr);
  const std::string message = std::string("PETSc: ") + (text ? text : "unknown error");
  if (error == PETSC_ERR_MEM) throw ResourceError(message);
  throw AnalysisError(message);
}

/// Destroyed with its owner.
template <class Object>
struct PetscObjectOf {
  Object value = nullptr;
  PetscObjectOf() = default;
  PetscObjectOf(PetscObjectOf&& other) noexcept : value(std::exchange(other.value, nullptr)) {}
  PetscObjectOf& operator=(PetscObjectOf&& other) noexcept {
    std::swap(value, other.value);
    return *this;
  }
  ~PetscObjectOf() {
    if (value) PetscObjectDestroy(reinterpret_cast<PetscObject*>(&value));
  }
  operator Object() const { return value; }
};

}  // namespace sublimit
