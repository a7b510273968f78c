// SPDX-License-Identifier: Apache-2.0
#include "sublimit/base/detail/row_writer.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <string>

#include "meshes/random_doubles.h"
#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/detail/read_file.h"
#include "support/expect_error.h"
#include "support/temporary_directory.h"

namespace sublimit::testing {
namespace {

/// One number a line, with its row.
struct Lines {
  const std::vector<double>& numbers;
  void operator()(std::string& out, std::int64_t begin, std::int64_t end) const {
    for (std::int64_t i = begin; i < end; ++i) {
      append_number(out, i);
      out += ':';
      append_number(out, numbers[static_cast<std::size_t>(i)]);
      out += '\n';
    }
  }
};

TEST(RowWriter, BytesAreThoseOfOneThreadForAnyThreadsAndBlocks) {
  const TemporaryDirectory directory;
  const std::vector<double> numbers = random_doubles(1, 3000, true);
  for (const std::int64_t block : {1, 7, 64, 5000})
    for (const std::int64_t count : {std::int64_t{0}, std::int64_t{1}, block - 1, block, block + 1, 8 * block, 3000L}) {
      if (count > 3000) continue;
      std::string plain = "head\n";
      Lines{numbers}(plain, 0, count);
      plain += "tail\n";
      for (const int threads : {1, 2, 3, 8}) {
        SCOPED_TRACE(std::to_string(count) + " rows in blocks of " + std::to_string(block) + ", " +
                     std::to_string(threads) + " threads");
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                        static_cast<std::size_t>(threads));
        std::string text;
        AtomicFile file(directory / "out");
        for (RowWriter out : {RowWriter(text), RowWriter(file)}) {
          out.write("head\n");
          out.rows(count, block, Lines{numbers});
          out.write("tail\n");
        }
        file.commit();
        EXPECT_TRUE(text == plain);  // not shown: they are long
        EXPECT_TRUE(read_file(directory / "out") == plain);
      }
    }
  EXPECT_EQ(directory.num_files(), 1);
}

TEST(RowWriter, BlocksBeginAtMultiplesOfTheirSize) {
  const TemporaryDirectory directory;
  AtomicFile file(directory / "out");
  std::atomic<int> rows = 0;
  RowWriter(file).rows(1000, 64, [&](std::string&, std::int64_t begin, std::int64_t end) {
    EXPECT_EQ(begin % 64, 0);
    EXPECT_EQ(end, std::min<std::int64_t>(begin + 64, 1000));
    rows += static_cast<int>(end - begin);
  });
  EXPECT_EQ(rows, 1000);
}

TEST(RowWriter, HoldsFewBlocksAtOnce) {
  // What is formatted and not written yet: at any time less than a tenth of the file.
  const TemporaryDirectory directory;
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 2);
  std::atomic<std::int64_t> formatted = 0, most = 0, written = 0;
  AtomicFile file(directory / "out", [&](std::int64_t bytes) { written = bytes; });
  RowWriter(file).rows(1000, 1, [&](std::string& out, std::int64_t, std::int64_t) {
    out.append(100000, 'x');
    const std::int64_t waiting = (formatted += 100000) - written;
    for (std::int64_t seen = most; waiting > seen && !most.compare_exchange_weak(seen, waiting);) continue;
  });
  file.commit();
  EXPECT_EQ(formatted, 100000000);
  EXPECT_LT(most, 10000000);
}

TEST(RowWriter, WhatARowThrowsLeavesNoFile) {
  const TemporaryDirectory directory;
  const auto write = [&] {
    AtomicFile file(directory / "out");
    RowWriter(file).rows(1000, 10, [](std::string& out, std::int64_t begin, std::int64_t) {
      if (begin == 700) throw InvalidMesh("row 700");
      out.append(1000, 'x');
    });
    file.commit();
  };
  expect_error<InvalidMesh>(write, {"row 700"});
  EXPECT_EQ(directory.num_files(), 0);
}

TEST(RowWriter, FullDeviceIsALackOfResources) {
  const auto write = [] {
    AtomicFile file("/dev/full");
    RowWriter(file).rows(1000, 10, [](std::string& out, std::int64_t, std::int64_t) { out.append(100000, 'x'); });
    file.commit();
  };
  expect_error<ResourceError>(write, {"/dev/full: cannot write", "No space left on device"});
}

}  // namespace
}  // namespace sublimit::testing
