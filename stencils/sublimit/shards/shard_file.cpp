// SPDX-License-Identifier: Apache-2.0
#include "sublimit/shards/shard_file.h"

#include <fmt/core.h>

#include <charconv>
#include <cstring>

#include "sublimit/base/error.h"
#include "sublimit/base/mapped_file.h"
#include "sublimit/table_file.h"
#include "sublimit/table_tensors.h"

namespace sublimit {
namespace {

std::int64_t number_of(const Safetensors& file, const std::string& name, const std::string& path) {
  const auto at = file.metadata.find(name);
  std::int64_t value = -1;
  if (at != file.metadata.end()) {
    const std::string& text = at->second;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size()) value = -1;
  }
  if (value < 0) throw FormatError(path + ": not a shard: its metadata has no number " + name);
  return value;
}

}  // namespace

std::string shard_name(int number, int count) {
  return fmt::format("shard-{:04}-of-{:04}.safetensors", number + 1, count);
}

void save_shard(const std::filesystem::path& path, const Shard& shard, const ShardPlace& place) {
  const TableTensors tensors(shard.table);
  Safetensors file = tensors.file();
  std::vector<std::int32_t> patches;
  for (const PatchPlace& patch : shard.patches) patches.insert(patches.end(), {patch.face, patch.turn, patch.share});
  const auto add = [&](Tensor&& tensor) {
    if (!tensor.bytes.empty()) file.tensors.push_back(std::move(tensor));
  };
  add(tensor<std::int64_t>("shard.inputs", shard.inputs, {std::ssize(shard.inputs)}));
  add(tensor<std::int32_t>("shard.patches", patches, {std::ssize(shard.patches), 3}));
  file.metadata["shard.number"] = std::to_string(place.number);
  file.metadata["shard.count"] = std::to_string(place.count);
  file.metadata["shard.first_point"] = std::to_string(place.first_point);
  file.metadata["shard.points"] = std::to_string(place.num_points);
  file.metadata["shard.control_points"] = std::to_string(place.num_control_points);
  write_safetensors(path, std::move(file));
}

LoadedShard load_shard(const std::filesystem::path& path) {
  const std::string name = path.string();
  const MappedFile mapped = map_file(path);
  AnyTable any = load_table(mapped.bytes, name, mapped.owner, {.checksums = true});
  auto* const table = std::get_if<BakedTable<double>>(&any);
  if (!table) throw FormatError(name + ": shards are in double precision");
  const Safetensors file = read_safetensors(mapped.bytes, name);
  LoadedShard shard{std::move(*table), {}, {}};
  ShardPlace& place = shard.place;
  place.number = static_cast<int>(number_of(file, "shard.number", name));
  place.count = static_cast<int>(number_of(file, "shard.count", name));
  place.first_point = number_of(file, "shard.first_point", name);
  place.num_points = number_of(file, "shard.points", name);
  place.num_control_points = number_of(file, "shard.control_points", name);
  shard.inputs.resize(size_t(shard.table.table.num_control_points()));
  const Tensor* const inputs = file.find("shard.inputs");
  const size_t bytes = shard.inputs.size() * sizeof(std::int64_t);
  if (inputs ? inputs->dtype != DType::I64 || inputs->bytes.size() != bytes : bytes > 0)
    throw FormatError(name + ": 'shard.inputs' is not a number for each control point of the table");
  if (inputs && matches_checksum(file, *inputs) == false) throw FormatError(name + ": 'shard.inputs' is damaged");
  if (inputs) std::memcpy(shard.inputs.data(), inputs->bytes.data(), bytes);
  for (const std::int64_t v : shard.inputs)
    if (v < 0 || v >= place.num_control_points)
      throw FormatError(
          fmt::format("{}: 'shard.inputs' has control point {} of {}", name, v, place.num_control_points));
  if (place.number >= place.count || place.first_point + shard.table.table.num_points() > place.num_points)
    throw FormatError(name + ": its place among the shards is outside of them");
  return shard;
}

}  // namespace sublimit
