// SPDX-License-Identifier: Apache-2.0
#pragma once
// Tables in the files of others.
#include <filesystem>

#include "sublimit/table_file.h"

namespace sublimit {

/// By the extension of `path`:
///
///   .npz   rows in CSR form for scipy.sparse.load_npz: all positions first, then all derivatives along u, ...
///   .mtx   the same as Matrix Market text
///   none   a directory: NAME.npy for each array that the table has in a file (`eval/table_format.md`), and
///          metadata.json with its texts. It must not be there yet, or be empty
///
/// Whole or not at all; the same bytes for the same table. Rows take the memory of the table's expansion.
/// @throws InvalidParameter  another extension
/// @throws IoError  unwritable, a directory that has files;  ResourceError  a full disk
void export_table(const std::filesystem::path& path, const AnyTable& table);

}  // namespace sublimit
