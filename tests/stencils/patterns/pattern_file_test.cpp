// SPDX-License-Identifier: Apache-2.0
// Dictionaries of patterns in files: what they have need not be made again, and it is the same.
#include "sublimit/stencils/patterns/pattern_file.h"

#include <gtest/gtest.h>

#include <fstream>
#include <set>

#include "laws/tested_schemes.h"
#include "sublimit/limit/detail/limit_masks.h"
#include "sublimit/stencils/bake/detail/bake.h"
#include "support/expect_error.h"
#include "support/temporary_directory.h"

namespace sublimit::testing {
namespace {

std::string contents(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

void expect_equal(const Baked& a, const Baked& b) {
  const auto &x = a.table.table.arrays(), &y = b.table.table.arrays();
  EXPECT_TRUE(std::equal(x.weights.begin(), x.weights.end(), y.weights.begin(), y.weights.end()));
  EXPECT_TRUE(std::equal(x.columns.begin(), x.columns.end(), y.columns.begin(), y.columns.end()));
  EXPECT_EQ(statuses_of(a.table), statuses_of(b.table));
}

/// Types of wide supports are large: only the last mesh, which has most in it.
std::vector<Mesh> few_meshes(const Scheme<double>& scheme) {
  std::vector<Mesh> meshes = hard_meshes(scheme, 3);
  if (!scheme.has_one_ring_limits()) meshes.erase(meshes.begin(), meshes.end() - 1);
  return meshes;
}

class PatternFile : public ::testing::TestWithParam<TestedScheme> {};

std::vector<BakeRequest> requests(const Scheme<double>& scheme) {
  std::vector<BakeRequest> list(3);
  list[0].level = 2;
  list[1].rows = TableRows::limit;
  list[1].level = 1;
  list[2].rows = TableRows::grid;
  list[2].grid = 3;
  list[2].derivatives = 1;
  if (!Patterns::is_possible(scheme)) list.erase(list.begin(), list.begin() + 2);
  return list;
}

TEST_P(PatternFile, KeepsWhatBakingTaught) {
  const Scheme<double> scheme = GetParam().scheme();
  const TemporaryDirectory directory;
  const auto path = directory.path() / "dictionary.safetensors", again = directory.path() / "again.safetensors";
  Patterns first(scheme);
  std::vector<Baked> fresh;
  for (const Mesh& mesh : few_meshes(scheme))
    for (const BakeRequest& request : requests(scheme)) fresh.push_back(bake(first, mesh, request));
  save_patterns(path, first);
  Patterns second(scheme);
  load_patterns(path, second);
  EXPECT_EQ(second.num_types(), first.num_types());
  size_t next = 0;
  for (const Mesh& mesh : few_meshes(scheme))
    for (const BakeRequest& request : requests(scheme)) expect_equal(bake(second, mesh, request), fresh[next++]);
  EXPECT_EQ(second.num_types(), first.num_types());
  if (scheme.face_size() == 3 || scheme.preparation.empty()) {
    EXPECT_EQ(second.types()->pieces().size(), 0u);  // nothing had to be made
  }
  save_patterns(again, second);
  EXPECT_EQ(contents(again), contents(path));
  // What a file does not have is made when it is asked for.
  BakeRequest more;
  more.rows = TableRows::grid;
  more.grid = 4;
  expect_equal(bake(second, few_meshes(scheme)[0], more), bake(first, few_meshes(scheme)[0], more));
}

std::vector<TestedScheme> schemes_in_files() {
  // One with wide supports: their types are large.
  return schemes_and_degrees_if([](const Scheme<double>& scheme) {
    return !scheme.is_dual() && (scheme.has_one_ring_limits() || scheme.name == "butterfly");
  });
}
INSTANTIATE_TEST_SUITE_P(Schemes, PatternFile, ::testing::ValuesIn(schemes_in_files()), test_name);

TEST(PatternFiles, AreRefusedForOtherMasks) {
  const TemporaryDirectory directory;
  const auto path = directory.path() / "dictionary.safetensors";
  Patterns patterns(find_scheme("butterfly").value());
  save_patterns(path, patterns);
  load_patterns(path, patterns);
  Patterns tense(find_scheme("butterfly", {{"tension", "1/2"}}).value()), loop(find_scheme("loop").value());
  expect_error<FormatError>([&] { load_patterns(path, tense); }, {"other options", "butterfly"});
  expect_error<FormatError>([&] { load_patterns(path, loop); }, {"'butterfly', not of 'loop'"});
  std::ofstream(path) << "no dictionary";
  expect_error<FormatError>([&] { load_patterns(path, loop); }, {"dictionary.safetensors"});
  expect_error<IoError>([&] { load_patterns(directory.path() / "none", loop); }, {"none"});
}

/// Every byte of a small file changed, and every truncation: an error or the same patterns, never a crash.
TEST(PatternFiles, ThatAreBrokenAreErrors) {
  const TemporaryDirectory directory;
  const auto path = directory.path() / "dictionary.safetensors";
  const Scheme<double> scheme = find_scheme("bilinear").value();
  Patterns patterns(scheme);
  bake_level(patterns, hard_meshes(scheme, 2)[0], 1);
  save_patterns(path, patterns);
  const std::string whole = contents(path);
  int errors = 0, tried = 0;
  const auto attempt = [&](const std::string& bytes) {
    std::ofstream(path, std::ios::binary) << bytes;
    Patterns other(scheme);
    ++tried;
    try {
      load_patterns(path, other);
    } catch (const Error&) {
      ++errors;
    }
  };
  const size_t step = std::max<size_t>(1, whole.size() / 200);
  for (size_t i = 0; i < whole.size(); i += step) {
    attempt(whole.substr(0, i));
    std::string flipped = whole;
    flipped[i] = static_cast<char>(flipped[i] ^ 4);
    attempt(flipped);
  }
  EXPECT_GT(errors, tried * 9 / 10);
}

/// All schemes, and options that change their masks, differ.
TEST(PatternFiles, TellMasksApart) {
  std::set<std::uint64_t> hashes;
  size_t count = 0;
  for (const Scheme<double>& scheme : all_schemes()) {
    if (scheme.knots != NewKnots::none) continue;  // of equal intervals they are another scheme's
    hashes.insert(mask_hash(scheme));
    ++count;
  }
  EXPECT_EQ(hashes.size(), count);
  EXPECT_EQ(mask_hash(find_scheme("catmull-clark-intervals").value()), mask_hash(find_scheme("catmull-clark").value()));
  EXPECT_EQ(mask_hash(find_scheme("doo-sabin-intervals").value()),
            mask_hash(find_scheme("doo-sabin-averaging").value()));
  EXPECT_NE(mask_hash(find_scheme("kobbelt").value()), mask_hash(find_scheme("kobbelt", {{"tension", "1/2"}}).value()));
}

}  // namespace
}  // namespace sublimit::testing
