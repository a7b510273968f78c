// SPDX-License-Identifier: Apache-2.0
// Any bytes as a file of a table: a FormatError that names it, or a table that can be verified, applied and asked for
// its faces; never a crash.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "sublimit/base/error.h"
#include "sublimit/eval/evaluate/pattern_evaluator.h"
#include "sublimit/eval/file/detail/verify_table.h"
#include "sublimit/eval/file/table_file.h"

namespace sublimit {
namespace {

/// Tables that make more are not applied: what they make is not what was in the file.
constexpr std::int64_t most_points = 20'000;

void require(bool holds) {
  if (!holds) std::abort();
}

/// The same bytes with the length of the header that the first object in them has, so that what is put into or cut
/// out of a header leaves a file.
std::vector<std::byte> repaired(std::vector<std::byte> bytes) {
  std::uint64_t depth = 0;
  for (size_t i = 8; i < bytes.size(); ++i) {
    const char c = static_cast<char>(bytes[i]);
    if (c == '{') ++depth;
    if (c != '}' || --depth != 0) continue;
    const std::uint64_t length = i + 1 - 8;
    for (size_t k = 0; k < 8; ++k) bytes[k] = static_cast<std::byte>(length >> (8 * k) & 255);
    break;
  }
  return bytes;
}

template <class Real>
void use(const BakedTable<Real>& baked) {
  const PatternTable<Real>& table = baked.table;
  if (table.num_points() > most_points || table.num_control_points() > most_points) return;
  const std::vector<Real> points(size_t(table.num_control_points()) * 3, Real(1));
  std::vector<Real> made(size_t(table.num_points()) * size_t(table.quantities()) * 3);
  table.apply(points, 3, made);
  PatternEvaluator<Real>(table).apply(points, 3, made);
  require(statuses_of(baked).size() <= size_t(table.num_points()));
  const std::int64_t cells =
      baked.lattices ? std::int64_t{baked.lattices->num_faces()} * baked.lattices->lattice().size() : 0;
  if (cells > most_points) return;
  const FaceList faces = faces_of(baked);
  for (const std::int32_t corner : faces.corners) require(corner >= 0 && corner < table.num_points());
  for (const FaceVaryingValues& channel : baked.channels.list) {
    require(channel.indices.size() == faces.corners.size());
    for (const std::int32_t value : channel.indices)
      require(value >= 0 && size_t(value) < channel.values.size() / size_t(channel.channels));
  }
  if (!baked.tags) return;
  require(2 * baked.tags->crease_sharpness.size() == baked.tags->creases.size());
  for (const std::int32_t point : baked.tags->creases) require(point >= 0 && point < table.num_points());
}

void load(const std::vector<std::byte>& bytes) {
  try {
    const AnyTable table = load_table(bytes, "fuzz.table", nullptr, {.checksums = true});
    std::visit([](const auto& baked) { use(baked); }, table);
    verify_table(bytes, "fuzz.table");
  } catch (const FormatError& error) {
    require(std::string_view(error.what()).starts_with("fuzz.table: "));
  }
}

}  // namespace
}  // namespace sublimit

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto* first = reinterpret_cast<const std::byte*>(data);
  const std::vector<std::byte> bytes(first, first + size);
  sublimit::load(bytes);
  sublimit::load(sublimit::repaired(bytes));
  return 0;
}
