// SPDX-License-Identifier: Apache-2.0
#pragma once
// Export of tables to file formats of other programs.
#include <filesystem>

#include "sublimit/eval/file/table_file.h"

namespace sublimit {

/// Writes a table in the format of the extension of `path`:
///
///   .npz   rows in CSR form for scipy.sparse.load_npz: all positions first, then all derivatives along u, ...
///   .mtx   these rows as Matrix Market text
///   none   a directory, which must not exist or be empty: NAME.npy for each array of the table's file
///          (`eval/table_format.md`), and metadata.json with its texts
///
/// Output appears whole or not at all; the same table gives the same bytes. Rows take the memory of the table's
/// expansion.
/// @throws InvalidParameter  another extension
/// @throws IoError  unwritable, a directory that has files;  ResourceError  a full disk
void export_table(const std::filesystem::path& path, const AnyTable& table);

}  // namespace sublimit
