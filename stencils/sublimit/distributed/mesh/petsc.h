// SPDX-License-Identifier: Apache-2.0
#pragma once
// PETSc's objects and errors in the manner of this house.
#include <petscmat.h>
#include <petscsf.h>

#include <span>
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

/// y from x by what they have on this rank, for a matrix that is a shell.
template <class Apply>
PetscErrorCode multiply(Vec x, Vec y, const Apply& apply) {
  const PetscScalar* from = nullptr;
  PetscScalar* to = nullptr;
  PetscInt num_from = 0, num_to = 0;
  PetscCall(VecGetLocalSize(x, &num_from));
  PetscCall(VecGetLocalSize(y, &num_to));
  PetscCall(VecGetArrayRead(x, &from));
  PetscCall(VecGetArrayWrite(y, &to));
  apply(std::span(from, size_t(num_from)), std::span(to, size_t(num_to)));
  PetscCall(VecRestoreArrayRead(x, &from));
  PetscCall(VecRestoreArrayWrite(y, &to));
  return 0;
}

}  // namespace sublimit
