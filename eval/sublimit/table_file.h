// SPDX-License-Identifier: Apache-2.0
#pragma once
// Tables as files, in the layout of safetensors: mapped into memory and used where they lie. `eval/table_format.md`
// says what is in one.
#include <filesystem>
#include <span>
#include <variant>
#include <vector>

#include "sublimit/baked_table.h"

namespace sublimit {

using AnyTable = std::variant<BakedTable<float>, BakedTable<double>>;

/// Appears whole or not at all; the same bytes for the same table.
/// @throws IoError  unwritable;  ResourceError  a full disk
template <class Real>
void save_table(const std::filesystem::path& path, const BakedTable<Real>& table);

struct LoadOptions {
  bool checksums = false;  ///< compare them too, which reads all of the file
};

/// Maps a file; large arrays stay in it, and pages are read when they are first touched. Everything that is used is
/// checked: layout, sizes, indices, that weights are finite.
/// @throws IoError        missing, unreadable
/// @throws FormatError    not a table, or a broken one; says what is wrong with which tensor
/// @throws ResourceError  no memory for what cannot stay in the file
[[nodiscard]] AnyTable load_table(const std::filesystem::path& path, const LoadOptions& options = {});

/// The same of bytes in memory, which must stay as long as the table.
/// @param name   of the file, for messages
/// @param owner  keeps them, if given
[[nodiscard]] AnyTable load_table(std::span<const std::byte> bytes, const std::string& name,
                                  std::shared_ptr<const void> owner = nullptr, const LoadOptions& options = {});
/// The same of bytes that the table keeps.
[[nodiscard]] AnyTable load_table(std::vector<std::byte>&& bytes, const std::string& name,
                                  const LoadOptions& options = {});

}  // namespace sublimit
