// SPDX-License-Identifier: Apache-2.0
#include "sublimit/eval/file/detail/safetensors.h"

#include <gtest/gtest.h>

#include <cstring>
#include <string>

#include "sublimit/base/detail/read_file.h"
#include "sublimit/base/error.h"
#include "support/expect_error.h"
#include "support/temporary_directory.h"

namespace sublimit::testing {
namespace {

std::span<const std::byte> bytes(const std::string& text) { return std::as_bytes(std::span(text)); }

std::string file_of(const std::string& header, const std::string& data) {
  std::string length(8, '\0');
  for (size_t i = 0; i < 8; ++i) length[i] = static_cast<char>(header.size() >> (8 * i) & 255);
  return length + header + data;
}

std::string item(const std::string& name, const std::string& type, const std::string& shape, const std::string& where) {
  return "\"" + name + "\":{\"dtype\":\"" + type + "\",\"shape\":[" + shape + "],\"data_offsets\":[" + where + "]}";
}

void expect_refused(const std::string& file, std::initializer_list<std::string_view> words) {
  expect_error<FormatError>([&] { read_safetensors(bytes(file), "x.bin"); }, {"x.bin: "});
  expect_error<FormatError>([&] { read_safetensors(bytes(file), "x.bin"); }, words);
}

TEST(Safetensors, AreWrittenWithLargerItemsFirst) {
  const TemporaryDirectory directory;
  const std::vector<std::uint8_t> small{1, 2, 3};
  const std::vector<double> large{0.5, -0.0};
  const std::vector<std::int32_t> middle{7, 8, 9, 10, 11, 12};
  const Safetensors file{{tensor("small", std::span<const std::uint8_t>(small), {3}),
                          tensor("middle", std::span<const std::int32_t>(middle), {2, 3}),
                          tensor("large", std::span<const double>(large), {2})},
                         {{"why", "\"quotes\"\n"}}};
  write_safetensors(directory / "a", file);
  write_safetensors(directory / "b", file);
  const std::string text = read_file(directory / "a");
  EXPECT_EQ(text, read_file(directory / "b"));
  const Safetensors read = read_safetensors(bytes(text), "a");
  ASSERT_EQ(read.tensors.size(), 3u);
  EXPECT_EQ(read.tensors[0].name, "large");
  EXPECT_EQ(read.tensors[1].name, "middle");
  EXPECT_EQ(read.tensors[2].name, "small");
  EXPECT_EQ((read.tensors[0].bytes.data() - bytes(text).data()) % 64, 0);
  EXPECT_EQ(text.size() - 64 * ((text.size() - 43) / 64), 43u);  // 16 + 24 + 3 bytes of data
  EXPECT_EQ(read.find("middle")->shape, (std::vector<std::int64_t>{2, 3}));
  EXPECT_EQ(std::memcmp(read.find("large")->bytes.data(), large.data(), 16), 0);
  EXPECT_EQ(read.metadata.at("why"), "\"quotes\"\n");
  EXPECT_EQ(read.find("none"), nullptr);
  EXPECT_EQ(directory.num_files(), 2);
}

TEST(Safetensors, HaveChecksums) {
  const TemporaryDirectory directory;
  const std::vector<std::uint8_t> data{1, 2, 3};
  write_safetensors(directory / "a", {{tensor("data", std::span<const std::uint8_t>(data), {3})}, {}});
  std::string text = read_file(directory / "a");
  Safetensors read = read_safetensors(bytes(text), "a");
  EXPECT_EQ(matches_checksum(read, read.tensors[0]), true);
  EXPECT_EQ(checksum({}), "2d06800538d394c2");  // what xxHash has for no bytes
  text.back() ^= 1;
  EXPECT_EQ(matches_checksum(read, read.tensors[0]), false);
  read.metadata.erase("checksum.data");
  EXPECT_EQ(matches_checksum(read, read.tensors[0]), std::nullopt);
}

TEST(Safetensors, AreReadAsOthersWriteThem) {
  const std::string data(20, '\1');
  const std::string text =
      file_of("{" + item("b", "F32", "2,1", "12,20") + "," + item("a", "U8", "12", "0,12") + "}  ", data);
  const Safetensors read = read_safetensors(bytes(text), "x");
  ASSERT_EQ(read.tensors.size(), 2u);
  EXPECT_EQ(read.tensors[0].name, "a");
  EXPECT_EQ(read.tensors[1].bytes.size(), 8u);
  EXPECT_EQ(read_safetensors(bytes(file_of("{}", "")), "x").tensors.size(), 0u);
  // No dimension is one item; an array without items lies anywhere.
  EXPECT_EQ(
      read_safetensors(bytes(file_of("{" + item("a", "I64", "", "0,8") + "," + item("b", "I64", "0,5", "8,8") + "}",
                                     std::string(8, 'x'))),
                       "x")
          .tensors.size(),
      2u);
}

TEST(Safetensors, RefuseHeadersThatAreNone) {
  expect_refused("", {"0 bytes"});
  expect_refused("1234567", {"7 bytes"});
  expect_refused(std::string(8, '\377') + "{}", {"first eight bytes are not the length of a header"});
  expect_refused(std::string("\3\0\0\0\0\0\0\0{}", 10), {"3 bytes", "there are 2"});
  expect_refused(file_of("", ""), {"does not begin with '{'"});
  expect_refused(file_of(" {}", ""), {"does not begin with '{'"});
  expect_refused(file_of("{", ""), {"not JSON"});
  expect_refused(file_of("{} x", ""), {"not JSON"});
  expect_refused(file_of("{\"a\":1}", ""), {"a number where none should be"});
  expect_refused(file_of("{\"a\":[" + std::string(100'000, '[') + "}", ""), {"a list where none should be"});
  std::string deep;
  for (int i = 0; i < 100'000; ++i) deep += "{\"a\":";
  expect_refused(file_of(deep, ""), {"an object where none should be"});
  expect_refused(file_of("{\"__metadata__\":{\"a\":1}}", ""), {"a number"});
  expect_refused(file_of("{\"__metadata__\":{\"a\":{}}}", ""), {"an object"});
  expect_refused(file_of("{\"__metadata__\":{\"a\":\"1\",\"a\":\"1\"}}", ""), {"'a' is there twice in __metadata__"});
  expect_refused(file_of("{\"__metadata__\":{},\"__metadata__\":{}}", ""), {"'__metadata__' is there twice"});
  expect_refused(file_of("{\"a\":{}}", ""), {"'a'", "must be there"});
  expect_refused(file_of("{\"a\":{\"dtype\":\"U8\",\"shape\":[1]}}", "x"), {"must be there"});
  expect_refused(file_of("{\"a\":{\"dtype\":\"U8\",\"dtype\":\"U8\"}}", ""), {"two dtypes"});
  expect_refused(file_of("{\"a\":{\"shape\":[],\"shape\":[]}}", ""), {"twice"});
  expect_refused(file_of("{\"a\":{\"data_offsets\":[0,0],\"data_offsets\":[0,0]}}", ""), {"twice"});
  expect_refused(file_of("{\"a\":{\"data_offsets\":[0]}}", ""), {"two numbers"});
  expect_refused(file_of("{\"a\":{\"data_offsets\":[0,1,2]}}", ""), {"too many numbers"});
  expect_refused(file_of("{\"a\":{\"more\":\"U8\"}}", ""), {"a text"});
  expect_refused(file_of("{" + item("a", "BF16", "1", "0,2") + "}", "xx"), {"'BF16'"});
  expect_refused(file_of("{" + item("a", "U8", "null", "0,2") + "}", "xx"), {"null"});
  expect_refused(file_of("{" + item("a", "U8", "true", "0,2") + "}", "xx"), {"true"});
  expect_refused(file_of("{" + item("a", "U8", "-1", "0,2") + "}", "xx"), {"negative"});
  expect_refused(file_of("{" + item("a", "U8", "1.5", "0,2") + "}", "xx"), {"not whole"});
  expect_refused(file_of("{" + item("a", "U8", "1e3", "0,2") + "}", "xx"), {"not whole"});
  expect_refused(file_of("{" + item("a", "U8", "1,1,1,1,1,1,1,1,1", "0,1") + "}", "x"), {"too many numbers"});
}

TEST(Safetensors, RefuseDataThatDoesNotFit) {
  const auto two = [](const std::string& a, const std::string& b) {
    return file_of("{" + item("a", "U8", "4", a) + "," + item("b", "U8", "4", b) + "}", std::string(8, 'x'));
  };
  EXPECT_NO_THROW(read_safetensors(bytes(two("0,4", "4,8")), "x"));
  EXPECT_NO_THROW(read_safetensors(bytes(two("4,8", "0,4")), "x"));
  expect_refused(two("0,4", "0,4"), {"'b' lies at 0 to 4, over the array before it"});
  expect_refused(two("0,4", "3,7"), {"over the array before it"});
  expect_refused(two("0,4", "5,9"), {"outside the 8 bytes"});
  expect_refused(two("1,5", "5,9"), {"after a hole"});
  expect_refused(two("4,0", "4,8"), {"outside"});
  expect_refused(two("0,5", "5,8"), {"'a' lies at 0 to 5", "U8 of shape 4"});
  expect_refused(two("0,4", "4,9223372036854775807"), {"outside"});
  expect_refused(two("0,4", "4,9223372036854775808"), {"larger than any file"});
  expect_refused(two("0,4", "4,99999999999999999999"), {"not whole, or larger"});
  const auto one = [](const std::string& type, const std::string& shape) {
    return file_of("{" + item("a", type, shape, "0,8") + "}", std::string(8, 'x'));
  };
  EXPECT_NO_THROW(read_safetensors(bytes(one("F64", "1,1")), "x"));
  expect_refused(one("U8", "7"), {"shape 7"});
  expect_refused(one("I64", "2"), {"I64 of shape 2"});
  // 2^62 * 4 = 0, 8 * (2^61 + 1) = 8 modulo 2^64
  expect_refused(one("U8", "4611686018427387904,4"), {"shape"});
  expect_refused(one("I64", "2305843009213693953"), {"shape"});
  expect_refused(file_of("{" + item("a", "U8", "4", "0,4") + "}", std::string(5, 'x')),
                 {"end at byte 4", "there are 5"});
  expect_refused(file_of("{" + item("a", "U8", "1", "0,1") + "," + item("a", "U8", "1", "1,2") + "}", "xx"),
                 {"'a' is there twice"});
  expect_refused(file_of("{\"__metadata__\":{\"header_checksum\":\"0\"}}", ""), {"checksum does not match"});
}

TEST(Safetensors, AreNotWrittenWrong) {
  const TemporaryDirectory directory;
  const std::vector<std::uint8_t> data{1, 2, 3};
  const Tensor a = tensor("a", std::span<const std::uint8_t>(data), {3});
  const auto write = [&](Safetensors file) { write_safetensors(directory / "x", std::move(file)); };
  expect_error<InvalidParameter>([&] { write({{a, a}, {}}); }, {"two arrays with the name 'a'"});
  expect_error<InvalidParameter>(
      [&] {
        write({{tensor("a", std::span<const std::uint8_t>(data), {2})}, {}});
      },
      {"'a' has 3 bytes"});
  expect_error<InvalidParameter>([&] { write({{}, {{"a", "\377"}}}); }, {"not UTF-8"});
  EXPECT_EQ(directory.num_files(), 0);
  expect_error<IoError>([&] { write_safetensors(directory / "no/x", {{a}, {}}); }, {"no/x"});
}

}  // namespace
}  // namespace sublimit::testing
