// SPDX-License-Identifier: Apache-2.0
#include "sublimit/distributed/mesh/points_file.h"

#include <algorithm>

#include "sublimit/base/error.h"
#include "sublimit/io/detail/ply_header.h"
#include "sublimit/stencils/formats/formats.h"

namespace sublimit {

void check_points_output(const std::filesystem::path& output) {
  const std::vector<Content> taken{contents::arrays, contents::mesh_parts};
  if (std::ranges::none_of(taken, [&](Content content) { return all_formats().writes(output, content); }))
    throw InvalidOption(output.string() + ": unknown kind of output '" + file_extension(output) + "'; " +
                        all_formats().writers_in_words(taken, "and") + " can be written");
}

std::string ply_header(std::int64_t num_points, std::optional<std::int64_t> num_faces) {
  PlyHeader header{PlyHeader::Encoding::little_endian, {{.name = "vertex", .count = num_points, .properties = {}}}};
  for (const char* const name : {"x", "y", "z"}) header.elements[0].properties.push_back({name, PlyType::float64, {}});
  if (num_faces) header.elements.push_back({"face", *num_faces, {{"vertex_indices", PlyType::int32, PlyType::uint8}}});
  return format_ply_header(header);
}

std::vector<PointRun> runs_of(std::span<const std::array<std::int64_t, 2>> items, std::int64_t isolated) {
  std::vector<PointRun> runs;
  if (isolated > 0) runs.push_back({0, isolated});
  for (const auto& [first, count] : items)
    if (!runs.empty() && runs.back().first + runs.back().count == first)
      runs.back().count += count;
    else if (count > 0)
      runs.push_back({first, count});
  return runs;
}

void write_runs(SharedFile& file, std::int64_t begin, std::int64_t item_size, std::span<const PointRun> runs,
                std::span<const std::byte> items) {
  for (const PointRun& run : runs) {
    const auto size = static_cast<size_t>(run.count * item_size);
    file.write(begin + run.first * item_size, items.first(size));
    items = items.subspan(size);
  }
}

}  // namespace sublimit
