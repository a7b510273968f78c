// SPDX-License-Identifier: Apache-2.0
#include "sublimit/stencils/formats/npy.h"

#include <gtest/gtest.h>

#include <cstring>

#include "sublimit/base/detail/read_file.h"
#include "sublimit/base/error.h"
#include "support/expect_error.h"
#include "support/temporary_directory.h"

namespace sublimit::testing {
namespace {

std::span<const std::byte> bytes(const std::string& text) { return std::as_bytes(std::span(text)); }

std::string file_of(const std::string& dictionary, const std::string& data, int version = 1) {
  std::string text = std::string("\x93NUMPY") + static_cast<char>(version) + '\0';
  for (int i = 0; i < (version == 1 ? 2 : 4); ++i) text += static_cast<char>(dictionary.size() >> (8 * i) & 255);
  return text + dictionary + data;
}
std::string dictionary(const std::string& descr, const std::string& shape) {
  return "{'descr': '" + descr + "', 'fortran_order': False, 'shape': " + shape + ", }\n";
}
template <class Real>
std::string data(std::initializer_list<Real> numbers) {
  std::string text(numbers.size() * sizeof(Real), '\0');
  std::memcpy(text.data(), std::data(numbers), text.size());
  return text;
}

template <class Real>
std::vector<Real> all(const NpyArray& array) {
  std::vector<Real> numbers(size_t(array.size()));
  array.read(0, std::span(numbers));
  return numbers;
}

TEST(Npy, HeadersAreNumPys) {
  // As numpy.save(np.zeros((2, 3), 'f4')) begins.
  const std::string header = npy_header(DType::F32, std::vector<std::int64_t>{2, 3});
  EXPECT_EQ(header.size(), 128u);
  EXPECT_EQ(header.substr(0, 10), std::string("\x93NUMPY\1\0v\0", 10));
  EXPECT_EQ(header.substr(10, 60), "{'descr': '<f4', 'fortran_order': False, 'shape': (2, 3), } ");
  EXPECT_EQ(header.back(), '\n');
  EXPECT_NE(npy_header(DType::U8, std::vector<std::int64_t>{7}).find("'|u1', 'fortran_order': False, 'shape': (7,), }"),
            std::string::npos);
  EXPECT_NE(npy_header(DType::I64, {}).find("'<i8', 'fortran_order': False, 'shape': (), }"), std::string::npos);
}

TEST(Npy, IsWrittenPieceByPiece) {
  const TemporaryDirectory directory;
  const std::vector<double> numbers{1, -0.0, 1e-310, 4, 5, 6};
  {
    NpyWriter file(directory / "a.npy", DType::F64, {3, 2});
    file.write(std::span(numbers).first(2));
    file.write(std::span(numbers).subspan(2));
    EXPECT_FALSE(std::filesystem::exists(directory / "a.npy"));
    file.commit();
  }
  const NpyArray read(directory / "a.npy");
  EXPECT_EQ(read.dtype(), DType::F64);
  EXPECT_EQ(read.shape(), (std::vector<std::int64_t>{3, 2}));
  EXPECT_EQ(all<double>(read), numbers);
  std::vector<float> middle(2);
  read.read(3, std::span(middle));
  EXPECT_EQ(middle, (std::vector<float>{4, 5}));
  expect_error<InvalidParameter>([&] { read.read(5, std::span(middle)); }, {"items 5 to 7 of 6"});
  expect_error<InvalidParameter>([&] { read.read(-1, std::span(middle)); }, {"items -1"});
}

TEST(Npy, IsNotWrittenWrong) {
  const TemporaryDirectory directory;
  const std::vector<float> numbers(3);
  NpyWriter file(directory / "a.npy", DType::F32, {2});
  expect_error<InvalidParameter>([&] { file.write(std::span(numbers)); }, {"12 bytes", "8"});
  expect_error<InvalidParameter>([&] { file.write(std::span<const double>()); }, {"F64", "F32"});
  expect_error<InvalidParameter>([&] { file.commit(); }, {"8 bytes have not been written"});
  EXPECT_FALSE(std::filesystem::exists(directory / "a.npy"));
  expect_error<ResourceError>(
      [&] {
        NpyWriter full("/dev/full", DType::F32, {3});
        full.write(std::span(numbers));
        full.commit();
      },
      {"/dev/full"});
}

TEST(Npy, IsReadInAllVersionsAndShapes) {
  for (const int version : {1, 2, 3}) {
    const std::string text = file_of(dictionary("<f4", "(1, 2, 1)"), data<float>({1, 2}), version);
    EXPECT_EQ(all<double>(NpyArray(bytes(text), "x")), (std::vector<double>{1, 2}));
  }
  const auto read = [](const std::string& text) { return all<float>(NpyArray(bytes(text), "x")); };
  EXPECT_EQ(read(file_of(dictionary("<f8", "()"), data<double>({7}))), std::vector<float>{7});
  EXPECT_EQ(read(file_of(dictionary("<f8", "(1,)"), data<double>({7}))), std::vector<float>{7});
  EXPECT_EQ(read(file_of(dictionary("<f8", "(0, 3)"), "")), std::vector<float>());
  EXPECT_EQ(read(file_of("{\"shape\":(1,),\"fortran_order\":True,\"descr\":\"<f8\"}", data<double>({7}))),
            std::vector<float>{7});
}

TEST(Npy, IsRefusedWhenItIsBroken) {
  const auto expect_refused = [](const std::string& text, std::initializer_list<std::string_view> words) {
    expect_error<FormatError>([&] { NpyArray(bytes(text), "x.npy"); }, {"x.npy: "});
    expect_error<FormatError>([&] { NpyArray(bytes(text), "x.npy"); }, words);
  };
  const std::string one = data<float>({1});
  expect_refused("", {"not a .npy file"});
  expect_refused("\x93NUMPY\1", {"not a .npy file"});
  expect_refused("PK\3\4 and more", {"not a .npy file"});
  expect_refused(file_of(dictionary("<f4", "(1,)"), one, 4), {"version 4"});
  expect_refused(std::string("\x93NUMPY\1\0\377\377{}", 12), {"65535 bytes"});
  expect_refused(std::string("\x93NUMPY\2\0\377\377\377", 11), {"the file is shorter"});
  expect_refused(file_of(dictionary("<f2", "(2,)"), one), {"'<f2'", "astype"});
  expect_refused(file_of(dictionary(">f4", "(1,)"), one), {"'>f4'"});
  expect_refused(file_of(dictionary("|O", "(1,)"), one), {"'|O'"});
  expect_refused(file_of("{'descr': [('a', '<f4')], 'fortran_order': False, 'shape': (1,)}", one), {"records"});
  expect_refused(file_of("{'descr': '<f4', 'fortran_order': True, 'shape': (1, 1)}", one),
                 {"Fortran", "ascontiguousarray"});
  expect_refused(file_of("{'descr': '<f4', 'fortran_order': Maybe, 'shape': (1,)}", one), {"'False'"});
  expect_refused(file_of("{'descr': '<f4', 'shape': (1,)}", one), {"must be there"});
  expect_refused(file_of("{'descr': '<f4', 'descr': '<f4'}", one), {"'descr' is twice"});
  expect_refused(file_of("{'more': 1}", one), {"'more'"});
  expect_refused(file_of("{'descr", one), {"does not end"});
  expect_refused(file_of("{'descr' '<f4'}", one), {"':'"});
  expect_refused(file_of("{} x", one), {"after '}'"});
  expect_refused(file_of("", one), {"'{'"});
  expect_refused(file_of(dictionary("<f4", "(1"), one), {"shape"});
  expect_refused(file_of(dictionary("<f4", "(-1,)"), one), {"shape"});
  expect_refused(file_of(dictionary("<f4", "(1.5,)"), one), {"shape"});
  expect_refused(file_of(dictionary("<f4", "(99999999999999999999,)"), one), {"shape"});
  std::string many = "(";
  for (int i = 0; i < 33; ++i) many += "1,";
  expect_refused(file_of(dictionary("<f4", many + ")"), one), {"shape"});
  expect_refused(file_of(dictionary("<f4", "(2,)"), one), {"4 bytes", "8"});
  expect_refused(file_of(dictionary("<f4", "(1,)"), one + "x"), {"5 bytes", "4"});
  expect_refused(file_of(dictionary("<f4", "(4611686018427387904, 4)"), ""), {"more than any file"});
  expect_refused(file_of(dictionary("<f4", "(4611686018427387904, 4, 0)"), ""), {"more than any file"});
}

}  // namespace
}  // namespace sublimit::testing
