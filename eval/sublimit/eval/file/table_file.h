// SPDX-License-Identifier: Apache-2.0
#pragma once
// Table files, in the layout of safetensors (eval/table_format.md). They are mapped into memory, and large arrays are
// used in place:
//
//   const AnyTable table = load_table("level3.safetensors", {.checksums = true});
//   if (const auto* baked = std::get_if<BakedTable<float>>(&table)) save_table("copy.safetensors", *baked);
//
// `load` of eval/table.h also makes a table ready to be applied.
#include <filesystem>
#include <span>
#include <variant>
#include <vector>

#include "sublimit/eval/table/baked_table.h"

namespace sublimit {

/// A table of weights in float or in double.
using AnyTable = std::variant<BakedTable<float>, BakedTable<double>>;

/// Writes a table to a file, which appears whole or not at all. The same table gives the same bytes.
/// @throws IoError  unwritable;  ResourceError  a full disk
template <class Real>
void save_table(const std::filesystem::path& path, const BakedTable<Real>& table);

/// Options for loading tables.
struct LoadOptions {
  bool checksums = false;  ///< compare the checksums of all arrays too, which reads all of the file
};

/// Loads a table by mapping its file. Large arrays stay in the file, and pages are read when they are first used; the
/// file must not change meanwhile. Layout, sizes, indices and finiteness of weights are checked.
/// @throws IoError        missing, unreadable
/// @throws FormatError    not a table, or a damaged one: the message says which array is wrong and how
/// @throws ResourceError  not enough memory for the arrays that cannot stay in the file
[[nodiscard]] AnyTable load_table(const std::filesystem::path& path, const LoadOptions& options = {});

/// Loads a table from the bytes of a file in memory, which must not change while the table exists.
/// @param bytes  the file
/// @param name   name for messages
/// @param owner  keeps the bytes alive; null: the caller does
/// @throws as above
[[nodiscard]] AnyTable load_table(std::span<const std::byte> bytes, const std::string& name,
                                  std::shared_ptr<const void> owner = nullptr, const LoadOptions& options = {});
/// Loads a table from the bytes of a file, which the table takes over.
/// @param name  name for messages
/// @throws as above
[[nodiscard]] AnyTable load_table(std::vector<std::byte>&& bytes, const std::string& name,
                                  const LoadOptions& options = {});

}  // namespace sublimit
