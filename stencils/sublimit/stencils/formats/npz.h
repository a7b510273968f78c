// SPDX-License-Identifier: Apache-2.0
#pragma once
// Archives of arrays, as numpy.savez writes them: .npz, stored.
#include <filesystem>

#include "sublimit/eval/file/detail/safetensors.h"
#include "sublimit/eval/table/stencil_table.h"

namespace sublimit {

/// Writes arrays without copying them. The file appears whole or not at all; equal arrays give equal bytes.
/// @throws IoError  unwritable;  ResourceError  a full disk
void write_npz(const std::filesystem::path& path, std::span<const Tensor> arrays);

/// Writes rows in CSR form, as scipy.sparse.load_npz reads them.
/// @throws IoError  unwritable;  ResourceError  a full disk
template <class Real>
void write_scipy_csr(const std::filesystem::path& path, const StencilTable<Real>& table);

}  // namespace sublimit
