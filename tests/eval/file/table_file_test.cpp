// SPDX-License-Identifier: Apache-2.0
#include "sublimit/eval/file/table_file.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <functional>

#include "eval/file/table_samples.h"
#include "sublimit/base/detail/read_file.h"
#include "sublimit/base/error.h"
#include "sublimit/eval/file/detail/safetensors.h"
#include "support/expect_error.h"
#include "support/temporary_directory.h"

namespace sublimit::testing {
namespace {

std::span<const std::byte> bytes(const std::string& text) { return std::as_bytes(std::span(text)); }

template <class Real>
void expect_same_after_file(const BakedTable<Real>& table) {
  const TemporaryDirectory directory;
  save_table(directory / "a", table);
  save_table(directory / "b", table);
  const std::string text = read_file(directory / "a");
  EXPECT_EQ(text, read_file(directory / "b"));
  expect_equal(table, std::get<BakedTable<Real>>(load_table(directory / "a", {.checksums = true})));
  expect_equal(table, std::get<BakedTable<Real>>(load_table(bytes(text), "a")));
  const std::string odd = "x" + text;  // nothing lies where numbers should
  expect_equal(table, std::get<BakedTable<Real>>(load_table(bytes(odd).subspan(1), "odd")));
}

TEST(TableFile, KeepsEveryBit) {
  expect_same_after_file(two_quads<double>());
  expect_same_after_file(two_quads<float>(3));
  expect_same_after_file(everything<double>());
  expect_same_after_file(everything<float>());
  expect_same_after_file(BakedTable<float>{});
  expect_same_after_file(BakedTable<double>{});
  BakedTable<double> rows;
  PatternTable<double>::Arrays arrays;
  arrays.rest.emplace(3, std::vector<std::int64_t>{0, 2, 2, 3}, std::vector<std::int32_t>{0, 2, 1},
                      std::vector<double>{-0.0, 1, 1e-310});
  rows.table = PatternTable<double>(3, std::move(arrays));
  rows.info.rows = TableRows::samples;
  rows.info.triangles = true;
  expect_same_after_file(rows);
}

TEST(TableFile, IsUsedWhereItLies) {
  const TemporaryDirectory directory;
  save_table(directory / "t", everything<float>());
  const auto file = std::make_shared<const std::string>(read_file(directory / "t"));
  std::optional<AnyTable> table = load_table(bytes(*file), "t", file);
  const auto& t = std::get<BakedTable<float>>(*table);
  const auto lies_in_file = [&](const auto& array) {
    const auto* first = reinterpret_cast<const char*>(array.data());
    return first >= file->data() && first + array.num_bytes() <= file->data() + file->size();
  };
  const PatternTable<float>::Arrays& a = t.table.arrays();
  EXPECT_TRUE(lies_in_file(a.weights) && lies_in_file(a.rows) && lies_in_file(a.columns));
  EXPECT_TRUE(lies_in_file(a.patch_points) && lies_in_file(a.copies));
  EXPECT_TRUE(lies_in_file(a.first->offsets()) && lies_in_file(a.first->columns()) && lies_in_file(a.rest->weights()));
  const FaceLattices::Arrays& l = t.lattices->arrays();
  EXPECT_TRUE(lies_in_file(l.side_faces) && lies_in_file(l.first_points) && lies_in_file(l.holes));
  EXPECT_TRUE(lies_in_file(t.faces.corners) && lies_in_file(t.addresses.parameters) && lies_in_file(t.row_status));
  // Arrays keep the file, and nothing else does once they are gone.
  EXPECT_GT(file.use_count(), 1);
  table.reset();
  EXPECT_EQ(file.use_count(), 1);
}

TEST(TableFile, StaysMappedWhenItIsReplaced) {
  const TemporaryDirectory directory;
  save_table(directory / "t", two_quads<double>());
  const auto table = std::get<BakedTable<double>>(load_table(directory / "t"));
  save_table(directory / "t", everything<float>());
  expect_equal(table, two_quads<double>());
  std::filesystem::remove(directory / "t");
  expect_equal(table, two_quads<double>());
}

/// Loads a file: an Error that names it, or a table.
std::optional<AnyTable> load_or_error(std::span<const std::byte> file) {
  try {
    return load_table(file, "x.table");
  } catch (const FormatError& error) {
    EXPECT_TRUE(std::string_view(error.what()).starts_with("x.table: ")) << error.what();
    return std::nullopt;
  }
}

TEST(TableFile, IsNoTableWhenItIsCut) {
  const TemporaryDirectory directory;
  save_table(directory / "t", everything<float>());
  const std::string text = read_file(directory / "t");
  for (size_t size = 0; size < text.size(); ++size) {
    const std::vector<char> cut(text.begin(), text.begin() + std::ptrdiff_t(size));  // ends where memory ends
    ASSERT_FALSE(load_or_error(std::as_bytes(std::span(cut)))) << size;
  }
}

TEST(TableFile, IsNoOtherTableWhenABitOfItsHeaderFlips) {
  const TemporaryDirectory directory;
  const BakedTable<float> table = everything<float>();
  save_table(directory / "t", table);
  std::string text = read_file(directory / "t");
  const size_t data = text.size() - [&] {
    size_t size = 0;
    for (const Tensor& tensor : read_safetensors(bytes(text), "t").tensors) size += tensor.bytes.size();
    return size;
  }();
  int loaded = 0;
  for (size_t i = 0; i < data; ++i)
    for (int bit = 0; bit < 8; ++bit) {
      text[i] = static_cast<char>(text[i] ^ (1 << bit));
      if (const std::optional<AnyTable> flipped = load_or_error(bytes(text))) {
        ++loaded;
        expect_equal(table, std::get<BakedTable<float>>(*flipped));
        ASSERT_FALSE(HasFailure()) << "byte " << i << " bit " << bit;
      }
      text[i] = static_cast<char>(text[i] ^ (1 << bit));
    }
  // Spaces may become other blanks, and a checksum another key; nothing else is without meaning.
  EXPECT_GT(loaded, 0);
  EXPECT_LT(loaded, 200);
}

TEST(TableFile, ComparesChecksumsWhenAsked) {
  const TemporaryDirectory directory;
  save_table(directory / "t", two_quads<double>());
  std::string text = read_file(directory / "t");
  const Tensor weights = *read_safetensors(bytes(text), "t").find("weights");
  text[size_t(weights.bytes.data() - bytes(text).data()) + 1] ^= 1;
  EXPECT_NO_THROW(load_table(bytes(text), "t"));
  expect_error<FormatError>([&] { load_table(bytes(text), "t", nullptr, {.checksums = true}); },
                            {"t: 'weights': its checksum does not match"});
}

/// A file of `everything`, changed before it is written: what it says of itself is right for what it has.
class ChangedFile : public ::testing::Test {
 protected:
  void expect_refused(const std::function<void(Safetensors&)>& change, std::initializer_list<std::string_view> words) {
    Safetensors file = read_safetensors(bytes(text_), "t");
    for (const Tensor& tensor : file.tensors) file.metadata.erase("checksum." + tensor.name);
    change(file);
    write_safetensors(directory_ / "changed", std::move(file));
    expect_error<FormatError>([&] { load_table(directory_ / "changed"); }, {"changed: "});
    expect_error<FormatError>([&] { load_table(directory_ / "changed"); }, words);
  }
  static Tensor& find(Safetensors& file, const std::string& name) {
    return *std::find_if(file.tensors.begin(), file.tensors.end(), [&](const Tensor& t) { return t.name == name; });
  }
  static void erase(Safetensors& file, const std::string& name) {
    std::erase_if(file.tensors, [&](const Tensor& t) { return t.name == name; });
  }
  /// An array with one number changed.
  template <class T>
  void set(Safetensors& file, const std::string& name, size_t at, T value) {
    Tensor& tensor = find(file, name);
    auto& copy = copies_.emplace_back(tensor.bytes.begin(), tensor.bytes.end());
    std::copy_n(reinterpret_cast<const std::byte*>(&value), sizeof(T), copy.data() + at * sizeof(T));
    tensor.bytes = copy;
  }
  void SetUp() override {
    save_table(directory_ / "t", everything<float>());
    text_ = read_file(directory_ / "t");
  }
  TemporaryDirectory directory_;
  std::string text_;
  std::vector<std::vector<std::byte>> copies_;
};

TEST_F(ChangedFile, IsRefusedForItsMetadata) {
  const auto expect = [&](const std::string& key, const std::string& value,
                          std::initializer_list<std::string_view> words) {
    expect_refused([&](Safetensors& f) { f.metadata[key] = value; }, words);
  };
  expect("format", "other", {"format", "sublimit-table"});
  expect("schema", "3", {"its schema is 3, written by sublimit 0.1.0", "up to 2", "newer"});
  expect("schema", "one", {"schema is 'one'"});
  expect("schema", "0", {"schema is '0'"});
  expect("order", "point,quantity", {"order is 'point,quantity'"});
  expect("precision", "F16", {"precision is 'F16'"});
  expect("precision", "F64", {"'weights' is of F32, not F64"});
  expect("quantities", "x xv", {"quantities is 'x xv'"});
  expect("quantities", "x xu xv xuu xuv xvv", {"weights from 0"});
  expect("control_points", "-1", {"control_points is '-1'"});
  expect("control_points", "2147483648", {"control_points"});
  expect("control_points", "1", {"'first.*'", "control point 1 of 1"});
  expect("points", "17", {"it has 17 points", "make 16"});
  expect("rows", "columns", {"rows is 'columns'"});
  expect("rows", "grid", {"a grid of 0"});
  expect("level", "31", {"level is '31'"});
  expect("address_shape", "round", {"address_shape is 'round'"});
  expect("coordinates", "polar", {"coordinates is 'polar'", "'homogeneous'"});
  expect("topology_hash", "12", {"topology_hash is '12'"});
  expect("topology_hash", "00c0ffee1234567g", {"topology_hash"});
  expect("statuses", "regular", {"orders has 2 entries, not one for each of 1 statuses"});
  expect("statuses", "regular  crease", {"''"});
  expect("orders", "1 3", {"orders has '3'", "0, 1 and 2"});
  expect("orders", "1", {"orders has 1 entries, not one for each of 2 statuses"});
  expect("lattice", "4096", {"a lattice of 4096 is larger"});
  expect("lattice", "0", {"lattice is '0'"});
  expect("lattice", "3", {"points of face"});
  expect("lattice_shape", "triangle", {"'lattices.side_faces' must have the shape N x 3"});
  expect_refused([](Safetensors& f) { f.metadata.erase("rows"); }, {"rows is ''"});
  expect_refused([](Safetensors& f) { f.metadata.erase("format"); }, {"no format"});
}

TEST_F(ChangedFile, IsRefusedForItsArrays) {
  const auto expect_without = [&](const std::string& name, std::initializer_list<std::string_view> words) {
    expect_refused([&](Safetensors& f) { erase(f, name); }, words);
  };
  expect_without("weights", {"'blocks' has 9 rows; there are 0 weights"});
  expect_without("blocks", {"block 0 does not exist"});
  expect_without("groups", {"0 patches"});
  expect_without("columns", {"'groups' has 1 patches; there are 0 columns"});
  expect_without("first.offsets", {"'first.*'", "offsets must ascend from 0"});
  expect_without("lattices.corner_places", {"corner_places has 0 entries"});
  expect_without("faces.corners", {"faces.corners has 0 entries"});
  expect_without("addresses.faces", {"addresses.faces has 0 entries"});
  const auto expect = [&](const std::string& name, size_t at, auto value,
                          std::initializer_list<std::string_view> words) {
    expect_refused([&](Safetensors& f) { set(f, name, at, value); }, words);
  };
  const std::int64_t huge = std::numeric_limits<std::int64_t>::max();
  expect("groups", 3, huge, {"'groups' has 9223372036854775807 patches"});
  expect("groups", 3, -huge, {"a group of -9223372036854775807 patches"});
  expect("groups", 1, huge, {"'groups' has the number 9223372036854775807"});
  expect("groups", 0, std::int64_t{-1}, {"'groups' has the number -1"});
  expect("groups", 2, huge, {"rows from 9223372036854775807"});
  expect("blocks", 0, std::int64_t{2147483647}, {"'blocks' has 2147483647 rows; there are 108 weights"});
  expect("blocks", 0, std::int64_t{10}, {"weights from 0"});
  expect("blocks", 2, huge, {"weights from 9223372036854775807"});
  expect("weights", 5, std::numeric_limits<float>::quiet_NaN(), {"not finite"});
  expect("rest.weights", 0, std::numeric_limits<float>::infinity(), {"'rest.*'", "not finite"});
  expect("rest.columns", 0, std::int32_t{7}, {"control point 7 of 7"});
  expect("first.offsets", 1, huge, {"offsets must ascend"});
  expect("patch_points", 0, std::int64_t{-1}, {"points of patch 0"});
  expect("copies", 1, std::int32_t{16}, {"copies point 16"});
  expect("lattices.side_faces", 7, std::int32_t{2}, {"side 7"});
  expect("lattices.first_points", 0, huge, {"points of face 0"});
  expect("row_status", 0, std::uint8_t{2}, {"row_status has the status 2"});
  expect("faces.corners", 0, std::int32_t{16}, {"faces.corners names point 16 of 16"});
  expect("faces.sizes", 0, std::int32_t{-2147483647}, {"faces.sizes has a face of -2147483647 corners"});
  expect("addresses.faces", 0, std::int32_t{-1}, {"addresses.faces names face -1"});
  expect("addresses.parameters", 0, std::numeric_limits<double>::quiet_NaN(), {"addresses.parameters", "not finite"});
  expect_refused([&](Safetensors& f) { find(f, "copies").shape = {4}; }, {"'copies' must have the shape N x 2"});
  expect_refused([&](Safetensors& f) { find(f, "rows").shape = {15, 1}; }, {"'rows' must have the shape N"});
  expect_refused([&](Safetensors& f) { find(f, "weights").dtype = DType::I32; }, {"'weights' is of I32, not F32"});
}

TEST_F(ChangedFile, IsRefusedForItsChannelsAndTags) {
  const auto expect = [&](const std::string& name, size_t at, auto value,
                          std::initializer_list<std::string_view> words) {
    expect_refused([&](Safetensors& f) { set(f, name, at, value); }, words);
  };
  expect("face_varying.0.indices", 3, std::int32_t{3}, {"face_varying.0.indices: entry 3 names value 3 of 3"});
  expect("face_varying.1.indices", 15, std::int32_t{-1}, {"face_varying.1.indices: entry 15 names value -1 of 1"});
  expect("face_varying.0.values", 5, std::numeric_limits<double>::infinity(), {"face_varying.0.values", "finite"});
  expect("tags.creases", 1, std::int32_t{16}, {"tags.creases: entry 1 names point 16 of 16"});
  expect("tags.creases", 1, std::int32_t{6}, {"an edge from point 6 to itself"});
  expect("tags.corners", 0, std::int32_t{-1}, {"tags.corners", "point -1 of 16"});
  expect("tags.crease_sharpness", 0, std::numeric_limits<float>::quiet_NaN(), {"tags.crease_sharpness has nan"});
  expect("tags.corner_sharpness", 0, -1.0f, {"tags.corner_sharpness has -1"});
  expect("lattices.holes", 0, std::uint8_t{1}, {"face_varying.0.indices has 16 entries, not one for each of 0"});
  const auto expect_without = [&](const std::string& name, std::initializer_list<std::string_view> words) {
    expect_refused([&](Safetensors& f) { erase(f, name); }, words);
  };
  expect_without("face_varying.0.values", {"face_varying is 'corners-plus1'", "no 'face_varying.0.values'"});
  expect_without("face_varying.1.indices", {"face_varying.1.indices has 0 entries"});
  expect_without("tags.creases", {"tags.crease_sharpness has 2 entries for 0"});
  expect_without("tags.corner_sharpness", {"tags.corner_sharpness has 0 entries for 1"});
  const auto expect_words = [&](const std::string& key, const std::string& value,
                                std::initializer_list<std::string_view> words) {
    expect_refused([&](Safetensors& f) { f.metadata[key] = value; }, words);
  };
  expect_words("face_varying", "some", {"face_varying is 'some'", "corners-only"});
  expect_words("tags.boundary", "none", {"tags.boundary is 'none'", "edge-and-corner"});
  expect_words("tags.creasing", "", {"tags.creasing is ''", "chaikin"});
  expect_words("rows", "samples", {"not of samples"});
  expect_refused([&](Safetensors& f) { find(f, "tags.creases").shape = {4}; }, {"'tags.creases' must have the shape"});
  expect_refused(
      [&](Safetensors& f) {
        find(f, "face_varying.0.values").shape = {1, 2, 3};
      },
      {"'face_varying.0.values' must have the shape"});
}

TEST(TableFile, IsNotWrittenWrong) {
  const TemporaryDirectory directory;
  BakedTable<double> table = everything<double>();
  table.row_status = {1};
  expect_error<InvalidParameter>([&] { save_table(directory / "t", table); }, {"row_status has 1 entries"});
  table = everything<double>();
  table.info.statuses = {"two words", "one"};
  expect_error<InvalidParameter>([&] { save_table(directory / "t", table); }, {"'two words'"});
  table = everything<double>();
  table.info.orders = {1};
  expect_error<InvalidParameter>([&] { save_table(directory / "t", table); }, {"orders has 1 entries", "2 statuses"});
  table.info.statuses = {"regular"};
  expect_error<InvalidParameter>([&] { save_table(directory / "t", table); },
                                 {"row_status has the status 1; there are 1"});
  table = everything<double>();
  table.info.orders = {3, 0};
  expect_error<InvalidParameter>([&] { save_table(directory / "t", table); }, {"orders has 3;"});
  EXPECT_EQ(directory.num_files(), 0);
}

TEST(TableFile, IsNotThereWhenTheDiskIsFull) {
  const BakedTable<double> table = everything<double>();
  expect_error<ResourceError>([&] { save_table("/dev/full", table); }, {"/dev/full", "free some space"});
  const TemporaryDirectory directory;
  struct ::rlimit limit {};
  ::getrlimit(RLIMIT_FSIZE, &limit);
  struct ::rlimit small = limit;
  small.rlim_cur = 1000;
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  ::setrlimit(RLIMIT_FSIZE, &small);
  expect_error<ResourceError>([&] { save_table(directory / "t", table); }, {"free some space"});
  ::setrlimit(RLIMIT_FSIZE, &limit);
  std::signal(SIGXFSZ, handler);
  EXPECT_EQ(directory.num_files(), 0);
}

TEST(TableFile, SeedsOfTheFuzzerAreTables) {
  int count = 0;
  for (const auto& seed : std::filesystem::directory_iterator(SUBLIMIT_SOURCE "/tests/fuzz/corpus/table")) {
    EXPECT_NO_THROW(load_table(seed.path())) << seed.path();
    ++count;
  }
  EXPECT_GE(count, 10);
}

TEST(TableFile, IsNamedWhenItCannotBeRead) {
  const TemporaryDirectory directory;
  expect_error<IoError>([&] { load_table(directory / "none"); }, {"none", "No such file"});
  expect_error<IoError>([&] { load_table(directory.path()); }, {"directory"});
  expect_error<FormatError>([&] { load_table("/dev/null"); }, {"/dev/null: it has 0 bytes"});
  expect_error<FormatError>([&] { load_table(directory.write("text", "v 1 2 3\nv 4 5 6\n")); }, {"text: ", "header"});
}

}  // namespace
}  // namespace sublimit::testing
