// SPDX-License-Identifier: Apache-2.0
#include "sublimit/stencils/shards/shard_file.h"

#include <fmt/core.h>

#include <charconv>
#include <cstring>
#include <nlohmann/json.hpp>

#include "sublimit/base/detail/atomic_file.h"
#include "sublimit/base/detail/mapped_file.h"
#include "sublimit/base/detail/read_file.h"
#include "sublimit/base/error.h"
#include "sublimit/eval/file/detail/table_tensors.h"
#include "sublimit/eval/file/table_file.h"

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

ShardPlace place_of(const Safetensors& file, const std::string& path) {
  ShardPlace place;
  const auto bake = file.metadata.find("shard.bake");
  if (bake == file.metadata.end()) throw FormatError(path + ": not a shard: its metadata has no shard.bake");
  place.bake = bake->second;
  const std::int64_t count = number_of(file, "shard.count", path), number = number_of(file, "shard.number", path);
  place.num_points = number_of(file, "shard.points", path);
  place.num_control_points = number_of(file, "shard.control_points", path);
  if (number >= count || count > std::numeric_limits<int>::max())
    throw FormatError(fmt::format("{}: shard {} of {}", path, number, count));
  place.number = static_cast<int>(number), place.count = static_cast<int>(count);
  return place;
}

/// 64-bit integers of a tensor, which is left out where it is empty.
std::vector<std::int64_t> integers(const Safetensors& file, const char* tensor, const std::string& path) {
  const Tensor* const found = file.find(tensor);
  std::vector<std::int64_t> numbers;
  if (!found) return numbers;
  if (found->dtype != DType::I64) throw FormatError(fmt::format("{}: '{}' is not of type I64", path, tensor));
  if (matches_checksum(file, *found) == false) throw FormatError(fmt::format("{}: '{}' is damaged", path, tensor));
  numbers.resize(found->bytes.size() / sizeof(std::int64_t));
  if (!numbers.empty()) std::memcpy(numbers.data(), found->bytes.data(), found->bytes.size());
  return numbers;
}

void check(const LoadedShard& shard, const std::string& path) {
  if (std::ssize(shard.inputs) != shard.table.table.num_control_points())
    throw FormatError(path + ": 'shard.inputs' is not a number for each control point of the table");
  for (const std::int64_t v : shard.inputs)
    if (v < 0 || v >= shard.place.num_control_points)
      throw FormatError(
          fmt::format("{}: 'shard.inputs' has control point {} of {}", path, v, shard.place.num_control_points));
  std::int64_t count = 0;
  for (const PointRun& run : shard.runs) {
    if (run.first < 0 || run.count < 0 || run.count > shard.place.num_points ||
        run.first > shard.place.num_points - run.count)
      throw FormatError(fmt::format("{}: 'shard.runs' has {} points from {} on, of {}", path, run.count, run.first,
                                    shard.place.num_points));
    count += run.count;
  }
  if (count != shard.table.table.num_points())
    throw FormatError(
        fmt::format("{}: 'shard.runs' are {} points; the table has {}", path, count, shard.table.table.num_points()));
}

}  // namespace

std::string shard_name(int number, int count) {
  return fmt::format("shard-{:04}-of-{:04}.safetensors", number + 1, count);
}

void save_shard(const std::filesystem::path& path, const Shard& shard, const ShardPlace& place) {
  const TableTensors tensors(shard.table);
  Safetensors file = tensors.file();
  std::vector<std::int64_t> runs;
  for (const PointRun& run : shard.runs) runs.insert(runs.end(), {run.first, run.count});
  const auto add = [&](Tensor&& tensor) {
    if (!tensor.bytes.empty()) file.tensors.push_back(std::move(tensor));
  };
  add(tensor<std::int64_t>("shard.inputs", shard.inputs, {std::ssize(shard.inputs)}));
  add(tensor<std::int64_t>("shard.runs", runs, {std::ssize(shard.runs), 2}));
  file.metadata["shard.bake"] = place.bake;
  file.metadata["shard.number"] = std::to_string(place.number);
  file.metadata["shard.count"] = std::to_string(place.count);
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
  LoadedShard shard{std::move(*table), integers(file, "shard.inputs", name), {}, place_of(file, name)};
  const std::vector<std::int64_t> runs = integers(file, "shard.runs", name);
  for (size_t i = 0; i + 1 < runs.size(); i += 2) shard.runs.push_back({runs[i], runs[i + 1]});
  check(shard, name);
  return shard;
}

LoadedShard load_shard(const std::filesystem::path& directory, const ShardManifest& manifest, int number) {
  const std::filesystem::path path = directory / shard_name(number, manifest.all.count);
  LoadedShard shard = load_shard(path);
  const ShardPlace &place = shard.place, &all = manifest.all;
  if (place.bake != all.bake || place.number != number || place.count != all.count ||
      place.num_points != all.num_points || place.num_control_points != all.num_control_points)
    throw FormatError(fmt::format("{}: of another bake than {} says; bake again", path.string(), shard_manifest_name));
  return shard;
}

std::optional<ShardPlace> find_shard(const std::filesystem::path& path) {
  const std::string name = path.filename().string();
  std::error_code error;
  if (!name.starts_with("shard-") || !name.ends_with(".safetensors") || !std::filesystem::is_regular_file(path, error))
    return std::nullopt;
  try {
    const MappedFile mapped = map_file(path);
    return place_of(read_safetensors(mapped.bytes, path.string()), path.string());
  } catch (const Error&) {
    return std::nullopt;  // damaged: to be made again
  }
}

void save_manifest(const std::filesystem::path& directory, const ShardManifest& manifest) {
  const nlohmann::ordered_json json{{"format", "sublimit-shards"},
                                    {"bake", manifest.all.bake},
                                    {"shards", manifest.all.count},
                                    {"points", manifest.all.num_points},
                                    {"control_points", manifest.all.num_control_points},
                                    {"faces", manifest.faces},
                                    {"scheme", manifest.scheme},
                                    {"rows", manifest.limit ? "limit" : "level"},
                                    {"level", manifest.level}};
  AtomicFile file(directory / shard_manifest_name);
  file.write(json.dump(2) + "\n");
  file.commit();
}

ShardManifest load_manifest(const std::filesystem::path& directory) {
  const std::filesystem::path path = directory / shard_manifest_name;
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored))
    throw IoError(path.string() + ": missing; it is written when all shards are there, so bake them first");
  const nlohmann::json json = nlohmann::json::parse(read_file(path), nullptr, false);
  try {
    ShardManifest manifest;
    if (json.at("format") != "sublimit-shards") throw FormatError(path.string() + ": no manifest of shards");
    manifest.all.bake = json.at("bake");
    manifest.all.count = json.at("shards");
    manifest.all.num_points = json.at("points");
    manifest.all.num_control_points = json.at("control_points");
    manifest.faces = json.at("faces");
    manifest.scheme = json.at("scheme");
    manifest.limit = json.at("rows") == "limit";
    manifest.level = json.at("level");
    if (manifest.all.count < 1 || manifest.all.num_points < 0 || manifest.all.num_control_points < 0)
      throw FormatError(path.string() + ": no manifest of shards: numbers below zero");
    return manifest;
  } catch (const nlohmann::json::exception&) {
    throw FormatError(path.string() + ": no manifest of shards");
  }
}

}  // namespace sublimit
