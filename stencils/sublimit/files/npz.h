// SPDX-License-Identifier: Apache-2.0
#pragma once
// Archives of arrays, as numpy.savez writes them: .npz, stored.
#include <filesystem>

#include "sublimit/safetensors.h"
#include "sublimit/stencil_table.h"

namespace sublimit {

/// Writes arrays from where they lie. The file appears whole or not at all; the same bytes for the same arrays.
/// @throws IoError  unwritable;  ResourceError  a full disk
void write_npz(const std::filesystem::path& path, std::span<const Tensor> arrays);

/// Rows as scipy.sparse.load_npz reads them, in CSR form.
/// @throws IoError  unwritable;  ResourceError  a full disk
template <class Real>
void write_scipy_csr(const std::filesystem::path& path, const StencilTable<Real>& table);

}  // namespace sublimit
