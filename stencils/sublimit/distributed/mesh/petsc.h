// SPDX-License-Identifier: Apache-2.0
#pragma once
// Owners of PETSc's objects, and its errors as exceptions of this library.
#include <petscmat.h>
#include <petscsf.h>

#include <span>
#include <string>
#include <utility>

#include "sublimit/base/error.h"

namespace sublimit {

/// Checks the result of a call of PETSc.
/// @throws ResourceError  out of memory;  AnalysisError  any other error
inline void check_petsc(PetscErrorCode error) {
  if (error == 0) return;
  const char* text = nullptr;
  PetscErrorMessage(error, &text, nullptr);
  const std::string message = std::string("PETSc: ") + (text ? text : "unknown error");
  if (error == PETSC_ERR_MEM) throw ResourceError(message);
  throw AnalysisError(message);
}

/// Owner of an object of PETSc, which its destructor destroys.
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

/// Sets y from x for a shell matrix: calls apply(from, to) with this rank's numbers of both vectors.
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
