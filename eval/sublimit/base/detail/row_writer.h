// SPDX-License-Identifier: Apache-2.0
#pragma once
// Writing many rows of text: all threads format, and rows are written in order.
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "sublimit/base/detail/atomic_file.h"
#include "sublimit/base/detail/parallel_for.h"

namespace sublimit {

/// Writes to a file, or to a string by one thread: the same bytes for any number of threads.
///
/// Memory does not grow with the number of rows: while some blocks are written, as many others are formatted.
class RowWriter {
 public:
  explicit RowWriter(AtomicFile& file) : file_(&file) {}
  explicit RowWriter(std::string& text) : text_(&text) {}

  void write(std::string_view bytes) {
    if (file_) file_->write(bytes);
    if (text_) text_->append(bytes);
  }

  /// Writes rows 0 to `count`.
  /// @param append          append(out, begin, end) appends rows [begin, end) to a string. It is called by any thread,
  ///                        with begin a multiple of `rows_per_block`
  /// @param rows_per_block  how many rows make some 100 KB, which the cache of a core holds
  template <class Append>
  void rows(std::int64_t count, std::int64_t rows_per_block, const Append& append) {
    if (text_) {
      if (count > 0) append(*text_, std::int64_t{0}, count);
      return;
    }
    const std::int64_t blocks = num_blocks(count, rows_per_block);
    const std::int64_t at_once = std::min(blocks, 4 * num_threads());
    std::vector<std::string> formatted(static_cast<std::size_t>(at_once)), waiting(formatted.size());
    for (std::int64_t first = 0; first < blocks + at_once; first += at_once) {
      const std::int64_t last = std::max(first, std::min(first + at_once, blocks));
      const auto work = [&](std::int64_t task, std::int64_t, std::int64_t) {
        if (task == 0) {  // the first one, so that it begins at once
          for (std::string& text : waiting) {
            file_->write(text);
            text.clear();
          }
        } else {
          const std::int64_t begin = (first + task - 1) * rows_per_block;
          append(formatted[static_cast<std::size_t>(task - 1)], begin, std::min(count, begin + rows_per_block));
        }
      };
      parallel_for_blocks(1 + last - first, work, 1);
      formatted.swap(waiting);
    }
  }

 private:
  static std::int64_t num_threads() {
    const auto allowed = tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
    return std::min(static_cast<std::int64_t>(allowed), std::int64_t{tbb::this_task_arena::max_concurrency()});
  }

  AtomicFile* file_ = nullptr;
  std::string* text_ = nullptr;
};

}  // namespace sublimit
