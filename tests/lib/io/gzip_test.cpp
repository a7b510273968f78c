// SPDX-License-Identifier: Apache-2.0
#include "sublimit/io/detail/gzip.h"

#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "sublimit/base/detail/memory.h"
#include "support/expect_error.h"
#include "support/gzip_bytes.h"

namespace sublimit::testing {
namespace {

std::string long_text() {
  std::string text;
  for (int i = 0; i < 50000; ++i)
    text += "v " + std::to_string(i) + " 0 " + std::to_string(i % 1009 * (i % 1009)) + "\n";
  return text;
}

TEST(Gzip, BytesAreThoseThatWereCompressed) {
  for (const std::string& text : {std::string(), std::string("a"), long_text(), std::string(1 << 20, '\0')}) {
    const std::string file = compressed(text);
    EXPECT_TRUE(is_gzip(file));
    EXPECT_TRUE(inflated(file, "a.gz") == text);
    EXPECT_TRUE(inflated(file + file, "a.gz") == text + text);  // as `cat a.gz a.gz` joins files
  }
  EXPECT_FALSE(is_gzip("\x1f"));
  EXPECT_FALSE(is_gzip("v 0 0 0\n"));
}

TEST(Gzip, SaysWhatIsDamaged) {
  const std::string text = long_text(), file = compressed(text);
  for (std::size_t size = 2; size < file.size(); size += size < 30 || size + 20 > file.size() ? 1 : file.size() / 7)
    expect_error<FormatError>([&] { inflated(file.substr(0, size), "a.gz"); },
                              {"a.gz: byte " + std::to_string(size) + ": the compressed file ends too early"});
  std::string wrong = file;
  wrong[wrong.size() - 6] = static_cast<char>(wrong[wrong.size() - 6] + 1);
  expect_error<FormatError>([&] { inflated(wrong, "a.gz"); }, {"compressed bytes are damaged (incorrect data check)"});
  wrong = file;
  wrong[wrong.size() - 2] = static_cast<char>(wrong[wrong.size() - 2] + 1);
  expect_error<FormatError>([&] { inflated(wrong, "a.gz"); },
                            {"compressed bytes are damaged (incorrect length check)"});
  wrong = file;
  wrong[2] = 9;  // the only method is 8
  expect_error<FormatError>([&] { inflated(wrong, "a.gz"); }, {"a.gz: byte", "compressed bytes are damaged"});
  EXPECT_TRUE(inflated(file + std::string(1000, '\0'), "a.gz") == text);  // as gzip(1): tapes have whole blocks
  expect_error<FormatError>([&] { inflated(file + std::string(10, '\0') + "more", "a.gz"); },
                            {"a.gz: byte " + std::to_string(file.size()) + ": bytes that are no gzip file"});
  expect_error<FormatError>([&] { inflated(file + "more", "a.gz"); },
                            {"a.gz: byte " + std::to_string(file.size()) + ": bytes that are no gzip file"});
}

TEST(Gzip, TakesNoMoreMemoryThanAJobMay) {
  const std::string zeros(3 << 20, '\0'), file = compressed(zeros);
  EXPECT_LT(file.size(), 10000u);
  std::string small_size = file;  // the size at the end says 1 byte
  small_size.replace(file.size() - 4, 4, std::string("\1\0\0\0", 4));
  limit_memory(1 << 20);
  for (const std::string& bytes : {file, small_size})
    expect_error<ResourceError>([&] { inflated(bytes, "a.gz"); },
                                {"a.gz: inflates to more than ", " KB; the limit is 1.0 MB"});
  limit_memory(1.5 * double(zeros.size()));  // a block besides
  EXPECT_EQ(inflated(file, "a.gz").size(), zeros.size());
  limit_memory(std::numeric_limits<double>::infinity());
}

TEST(Gzip, NamesLoseTheirLastExtension) {
  EXPECT_EQ(without_gz("folder.gz/a.obj.gz"), "folder.gz/a.obj");
  EXPECT_EQ(without_gz("A.OBJ.GZ"), "A.OBJ");
  EXPECT_EQ(without_gz("folder.gz/a.obj"), "folder.gz/a.obj");
  EXPECT_EQ(without_gz("a.gz"), "a");
}

}  // namespace
}  // namespace sublimit::testing
