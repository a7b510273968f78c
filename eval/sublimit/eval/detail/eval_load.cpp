// SPDX-License-Identifier: Apache-2.0
// The part of the C interface that reads files.
#include "sublimit/eval/detail/eval_handle.h"
#include "sublimit/eval/file/table_file.h"

namespace {

using namespace sublimit;

template <class Load>
sublimit_status load(std::uint32_t flags, sublimit_table** table, const Load& load_it) {
  return c::guarded([&] {
    c::check_pointer(table, "table");
    *table = nullptr;
    c::check_flags(flags);
    std::visit([&](auto&& baked) { c::hand_out(std::forward<decltype(baked)>(baked), flags, table); },
               load_it(LoadOptions{.checksums = (flags & SUBLIMIT_CHECKSUMS) != 0}));
  });
}

}  // namespace

sublimit_status sublimit_table_load(const char* path, uint32_t flags, sublimit_table** table) {
  return load(flags, table, [&](const LoadOptions& options) {
    c::check_pointer(path, "path");
    return load_table(path, options);
  });
}

sublimit_status sublimit_table_load_memory(const void* bytes, size_t num_bytes, uint32_t flags,
                                           sublimit_table** table) {
  return load(flags, table, [&](const LoadOptions& options) {
    c::check_pointer(bytes, "bytes");
    return load_table({static_cast<const std::byte*>(bytes), num_bytes}, "memory", nullptr, options);
  });
}
