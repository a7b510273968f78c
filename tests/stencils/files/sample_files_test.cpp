// SPDX-License-Identifier: Apache-2.0
// Samples from and to files: what is read is what was written, to the bit, and what is wrong is told with its line.
#include "sublimit/stencils/files/sample_files.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>

#include "meshes/meshes.h"
#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/detail/read_file.h"
#include "sublimit/schemes/schemes.h"
#include "sublimit/stencils/files/random_samples.h"
#include "support/expect_error.h"
#include "support/temporary_directory.h"
#include "support/tolerance.h"

namespace sublimit::testing {
namespace {

const Addresses& cube_addresses() {
  static const Topology topology(view(cube()));
  static const Addresses addresses(topology, false);
  return addresses;
}

std::vector<Place> read_all(const std::filesystem::path& path, size_t most, bool clamp = false) {
  SampleReader reader(path, clamp);
  std::vector<Place> all, batch;
  do {
    reader.read(batch, most, cube_addresses());
    all.insert(all.end(), batch.begin(), batch.end());
  } while (batch.size() == most);
  return all;
}

bool same_bits(double a, double b) { return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b); }

TEST(SampleReader, TakesLineEndsBlanksAndByteOrderMarks) {
  const TemporaryDirectory directory;
  for (const char* text :
       {"face,u,v\n5,0.25,1\n0,0,0.5\n", "face,u,v\r\n5,0.25,1\r\n0,0,0.5\r\n", "face,u,v\n5,0.25,1\n0,0,0.5",
        "\xEF\xBB\xBF"
        "face,u,v\n5,0.25,1\n0,0,0.5\n\n \r\n\n",
        "face, u, v\n 5 ,\t0.25, 1\n+0,0.0,5e-1\n"}) {
    SCOPED_TRACE(text);
    const std::vector<Place> samples = read_all(directory.write("in.csv", text), 7);
    ASSERT_EQ(samples.size(), 2u);
    EXPECT_EQ(samples[0].face, 5);
    EXPECT_EQ(samples[0].u, 0.25);
    EXPECT_EQ(samples[0].v, 1);
    EXPECT_EQ(samples[1].face, 0);
    EXPECT_EQ(samples[1].v, 0.5);
  }
  EXPECT_TRUE(read_all(directory.write("in.csv", "face,u,v\n"), 7).empty());
  EXPECT_TRUE(read_all(directory.write("in.csv", "face,u,v"), 7).empty());
}

/// Rows of a file longer than the blocks that are read, whatever the size of batches.
TEST(SampleReader, LosesNothingBetweenBlocksAndBatches) {
  const TemporaryDirectory directory;
  RandomSamples random(cube_addresses(), 60'000, 3);
  std::vector<Place> expected;
  random.read(expected, 60'000);
  std::string text = "face,u,v\n";
  for (const Place& s : expected)
    text += format_number(s.face) + "," + format_number(s.u) + "," + format_number(s.v) + "\n";
  ASSERT_GT(text.size(), size_t{2} << 20);
  const std::filesystem::path path = directory.write("in.csv", text);
  for (const size_t most : {size_t{1}, size_t{59'999}, size_t{60'000}, size_t{1'000'000}}) {
    const std::vector<Place> samples = read_all(path, most);
    ASSERT_EQ(samples.size(), expected.size());
    for (size_t i = 0; i < samples.size(); ++i)
      ASSERT_TRUE(samples[i].face == expected[i].face && same_bits(samples[i].u, expected[i].u) &&
                  same_bits(samples[i].v, expected[i].v))
          << i;
  }
}

TEST(SampleReader, NamesTheLineOfWhatIsWrong) {
  const TemporaryDirectory directory;
  const auto reading = [&](const std::string& text) {
    return [&directory, text] { read_all(directory.write("in.csv", text), 100); };
  };
  const std::string start = "face,u,v\n0,0,0\n";  // lines 1 and 2
  expect_error<FormatError>(reading(""), {"in.csv", "empty", "face,u,v"});
  expect_error<FormatError>(reading("\n0,0,0\n"), {"in.csv:1", "face,u,v"});
  expect_error<FormatError>(reading("0,0,0\n"), {"in.csv:1", "'0,0,0'", "header face,u,v"});
  expect_error<FormatError>(reading("face;u;v\n"), {"in.csv:1", "face;u;v", "header face,u,v"});
  expect_error<FormatError>(reading("segment,t\n"), {"in.csv:1", "segment,t", "header face,u,v"});
  expect_error<FormatError>(reading(start + "0,0\n"), {"in.csv:3", "2 fields, not 3", "face,u,v"});
  expect_error<FormatError>(reading(start + "0,0,0,0\n"), {"in.csv:3", "4 fields, not 3"});
  expect_error<FormatError>(reading(start + "0,,0\n"), {"in.csv:3", "u is missing"});
  expect_error<FormatError>(reading(start + ",0,0\n"), {"in.csv:3", "face is missing", "0 to 5"});
  expect_error<FormatError>(reading(start + "0,0,0x1\n"), {"in.csv:3", "v '0x1' is not a number", "decimal"});
  expect_error<FormatError>(reading(start + "0,half,0\n"), {"in.csv:3", "u 'half' is not a number"});
  for (const char* number : {"nan", "inf", "-inf", "1e999"})
    expect_error<FormatError>(reading(start + "0," + number + ",0\n"), {"in.csv:3", "u is", number, "finite"});
  expect_error<FormatError>(reading(start + "1.5,0,0\n"), {"in.csv:3", "face '1.5' is not a whole number", "0 to 5"});
  expect_error<FormatError>(reading(start + "1e0,0,0\n"), {"in.csv:3", "'1e0' is not a whole number"});
  for (const char* face : {"6", "-1", "99999999999", "99999999999999999999999"})
    expect_error<FormatError>(reading(start + face + ",0,0\n"), {"in.csv:3", face, "does not exist", "0 to 5"});
  expect_error<FormatError>(reading(start + "3,1.25,-0.5\n"), {"in.csv:3", "(1.25, -0.5)", "outside", "--clamp"});
  expect_error<FormatError>(reading(start + "\n\n0,0,0\n"), {"in.csv:3", "empty line"});
  expect_error<FormatError>(reading(start + std::string(3'000'000, '1')), {"in.csv:3", "no end of the line"});
  expect_error<IoError>([&] { read_all(directory / "none.csv", 1); }, {"none.csv", "No such file"});
  expect_error<IoError>([&] { read_all(directory.path(), 1); }, {"directory"});
}

/// Whatever the bytes, rows are read that are inside the domain, or an error says what is wrong.
TEST(SampleReader, TakesAnyBytes) {
  const TemporaryDirectory directory;
  std::mt19937 random(9);
  const std::string_view alphabet = "0123456789.,,,-+eE\r\n\n naif\x01\xff";
  int read = 0;
  for (int i = 0; i < 1000; ++i) {
    std::string text = "face,u,v\n5,0.25,1\n0,0,0.5\n3,1e-3,1\n";
    for (unsigned k = random() % 4; k > 0; --k) {
      const size_t at = random() % text.size();
      const char byte = alphabet[random() % alphabet.size()];
      switch (random() % 3) {
        case 0:
          text[at] = byte;
          break;
        case 1:
          text.insert(text.begin() + std::ptrdiff_t(at), byte);
          break;
        default:
          text.resize(at + 1);
      }
    }
    try {
      for (const Place& s : read_all(directory.write("in.csv", text), 2)) {
        ASSERT_TRUE(s.face >= 0 && s.face < 6 && s.u >= 0 && s.u <= 1 && s.v >= 0 && s.v <= 1) << text;
        ++read;
      }
    } catch (const FormatError& error) {
      EXPECT_NE(std::string_view(error.what()).find("in.csv"), std::string_view::npos);
    }
  }
  EXPECT_GT(read, 300);
}

TEST(SampleReader, ClampsToTheNearestPlaceOfTheRim) {
  std::mt19937 random(5);
  const auto coordinate = [&] { return double(random() % 4001) / 1000 - 1.5; };
  for (const bool triangle : {false, true})
    for (int i = 0; i < 2000; ++i) {
      const Place s{0, coordinate(), coordinate()}, c = clamped(s, triangle);
      const auto distance = [&](double u, double v) { return std::hypot(u - s.u, v - s.v); };
      ASSERT_TRUE(c.u >= 0 && c.v >= 0 && (triangle ? c.u + c.v <= 1 : c.u <= 1 && c.v <= 1)) << s.u << " " << s.v;
      for (int k = 0; k <= 20; ++k) {  // no place of the rim is nearer
        const double t = k / 20.0;
        for (const auto& [u, v] :
             {std::pair(t, 0.0), std::pair(0.0, t), triangle ? std::pair(t, 1 - t) : std::pair(t, 1.0),
              triangle ? std::pair(t, 1 - t) : std::pair(1.0, t)})
          ASSERT_LE(distance(c.u, c.v), distance(u, v) + rounding(4))
              << s.u << " " << s.v << " to " << c.u << " " << c.v;
      }
    }
  const TemporaryDirectory directory;
  SampleReader reader(directory.write("in.csv", "face,u,v\n1,-3,0.5\n1,0.5,0.5\n1,1e300,-1e300\n"), true);
  std::vector<Place> batch;
  reader.read(batch, 10, cube_addresses());
  ASSERT_EQ(batch.size(), 3u);
  EXPECT_EQ(batch[0].u, 0);
  EXPECT_EQ(batch[0].v, 0.5);
  EXPECT_EQ(batch[2].u, 1);
  EXPECT_EQ(batch[2].v, 0);
  EXPECT_EQ(reader.num_clamped(), 2);
}

/// The standard fixes the numbers of std::mt19937_64: with the seed 0 they begin with these.
TEST(RandomSamples, AreTheSameOnEveryPlatform) {
  const std::uint64_t numbers[] = {2947667278772165694u, 18301848765998365067u, 729919693006235833u};
  RandomSamples random(cube_addresses(), 10, 0);
  std::vector<Place> one, rest, all;
  random.read(one, 1);
  EXPECT_EQ(one[0].face, Index(numbers[0] % 6));
  EXPECT_EQ(one[0].u, double(numbers[1] >> 11) / 9007199254740992.0);
  EXPECT_EQ(one[0].v, double(numbers[2] >> 11) / 9007199254740992.0);
  random.read(rest, 100);
  EXPECT_EQ(rest.size(), 9u);
  random.read(one, 1);
  EXPECT_TRUE(one.empty());
  RandomSamples(cube_addresses(), 10, 0).read(all, 10);
  for (size_t i = 0; i < rest.size(); ++i) EXPECT_EQ(rest[i].u, all[i + 1].u);
}

TEST(RandomSamples, AreUniform) {
  const Topology topology(view(octahedron()));
  const Addresses triangles(topology, true);
  RandomSamples random(triangles, 80'000, 11);
  std::vector<Place> samples;
  random.read(samples, 80'000);
  std::vector<int> quarter(32);  // of each triangle, as one step of refinement cuts it
  for (const Place& s : samples) {
    ASSERT_TRUE(s.u >= 0 && s.v >= 0 && s.u + s.v <= 1);
    ++quarter[4 * s.face + (s.u >= 0.5 ? 0 : s.v >= 0.5 ? 1 : s.u + s.v < 0.5 ? 2 : 3)];
  }
  const double deviation = std::sqrt(80'000 * (1 / 32.0) * (31 / 32.0));  // of a binomial count
  for (const int count : quarter) EXPECT_NEAR(count, 2500, 5 * deviation);
}

/// Numbers of all sizes come back with the same bits; what is absent is empty.
TEST(SampleWriter, NumbersReadBackToTheSameBits) {
  const TemporaryDirectory directory;
  const double values[] = {0.1,   -0.0,     5e-324, 1.7976931348623157e308, 1.0 / 3, 2.2250738585072014e-308,
                           -1e22, 123456789};
  const size_t count = 5000;  // more than one block of text
  std::vector<Place> samples(count);
  LimitSamples found;
  found.position = found.normal = Points::Zero(count, 3);
  for (Points* m : {&found.du, &found.dv, &found.duu, &found.duv, &found.dvv}) *m = Points::Zero(count, 3);
  found.status.assign(count, LimitStatus::regular);
  found.order.assign(count, 0);
  for (size_t i = 0; i < count; ++i) {
    samples[i] = {Index(i), values[i % 8], values[(i + 3) % 8]};
    found.position.row(Index(i)) << values[(i + 1) % 8], values[i % 5], values[i % 7];
    found.du.row(Index(i)).setConstant(values[i % 3]);
    found.order[i] = std::int8_t(i % 3);
  }
  SampleWriter writer(directory / "out.csv", {.derivatives = 2});
  writer.write(samples, found);
  writer.commit();
  CsvRows rows(directory / "out.csv",
               {"face", "u",   "v",   "status", "x",   "y",   "z",   "xu",  "yu",  "zu", "xv", "yv", "zv",
                "xuu",  "yuu", "zuu", "xuv",    "yuv", "zuv", "xvv", "yvv", "zvv", "nx", "ny", "nz"});
  for (size_t i = 0; i < count; ++i) {
    ASSERT_TRUE(rows.next());
    ASSERT_EQ(rows.integer(0, ""), std::int64_t(i));
    ASSERT_TRUE(same_bits(rows.finite(1), samples[i].u) && same_bits(rows.finite(2), samples[i].v)) << i;
    ASSERT_TRUE(same_bits(rows.finite(4), found.position(Index(i), 0))) << i;
    ASSERT_TRUE(same_bits(rows.finite(5), found.position(Index(i), 1))) << i;
    if (i % 3 >= 1) {
      ASSERT_TRUE(same_bits(rows.finite(7), values[i % 3])) << i;
    } else {
      ASSERT_THROW(rows.finite(7), FormatError);
    }
    if (i % 3 < 2) {
      ASSERT_THROW(rows.finite(13), FormatError);
    }
    ASSERT_THROW(rows.finite(22), FormatError);  // no normal
  }
  EXPECT_FALSE(rows.next());

  found.position(7, 1) = std::numeric_limits<double>::infinity();
  SampleWriter again(directory / "out.csv", {.derivatives = 2});
  expect_error<InvalidMesh>([&] { again.write(samples, found); }, {"place 7,123456789,", "larger than numbers"});
}

TEST(WriteSamples, CountsStatusesAndLeavesNothingAfterAnError) {
  const TemporaryDirectory directory;
  const Mesh mesh = cube();
  const LimitMap surface(find_scheme("catmull-clark").value(), mesh);
  int calls = 0;
  const SampleSource corners = [&](std::vector<Place>& batch, size_t most) {
    EXPECT_GT(most, 2u);
    batch.assign(calls++ == 0 ? 2 : 0, Place{});
    if (!batch.empty()) batch[1].u = 0.5;
  };
  const SampleSummary summary = write_samples(directory / "out.csv", surface, mesh.positions, corners, {});
  EXPECT_EQ(summary.num_samples, 2);
  EXPECT_EQ(summary.text(), "1 regular, 1 extraordinary");
  EXPECT_EQ(calls, 1);  // a short batch is the last one
  const SampleSource failing = [&](std::vector<Place>& batch, size_t most) {
    if (++calls == 4) throw FormatError("row");
    batch.assign(most, Place{0, 0.5, 0.5});
  };
  EXPECT_THROW(write_samples(directory / "other.csv", surface, mesh.positions, failing, {}), FormatError);
  EXPECT_EQ(calls, 4);
  EXPECT_EQ(directory.num_files(), 1);
}

}  // namespace
}  // namespace sublimit::testing
