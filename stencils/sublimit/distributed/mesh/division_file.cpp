// SPDX-License-Identifier: Apache-2.0
#include "sublimit/distributed/mesh/division_file.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstring>

#include "sublimit/base/detail/mapped_file.h"
#include "sublimit/base/error.h"
#include "sublimit/distributed/mesh/shared_file.h"
#include "sublimit/eval/file/detail/safetensors.h"

namespace sublimit {

std::optional<std::vector<int>> load_division(const Ranks& ranks, const std::filesystem::path& directory,
                                              const std::string& name, const Runs& faces, int parts) {
  std::vector<int> part;
  bool is_there = false;
  try {
    const std::filesystem::path path = directory / division_name;
    std::error_code ignored;
    if (std::filesystem::exists(path, ignored)) {
      const MappedFile mapped = map_file(path);
      const Safetensors file = read_safetensors(mapped.bytes, path.string());
      const auto found = file.metadata.find("division");
      const Tensor* const tensor = file.find("part");
      is_there = found != file.metadata.end() && found->second == name && tensor && tensor->dtype == DType::I32 &&
                 tensor->shape == std::vector{faces.size()};
      if (is_there) {
        part.resize(size_t(faces.size(ranks.rank())));
        if (!part.empty())
          std::memcpy(part.data(), tensor->bytes.data() + 4 * faces.begin(ranks.rank()), 4 * part.size());
        is_there = std::ranges::all_of(part, [&](int p) { return p >= 0 && p < parts; });
      }
    }
  } catch (const Error&) {
    is_there = false;  // damaged: divided again
  }
  if (!ranks.all(is_there)) return std::nullopt;
  return part;
}

void save_division(const Ranks& ranks, const std::filesystem::path& directory, const std::string& name,
                   const Runs& faces, const std::vector<int>& part) {
  std::string header = fmt::format(
      R"({{"__metadata__":{{"division":"{}"}},"part":{{"dtype":"I32","shape":[{}],"data_offsets":[0,{}]}}}})", name,
      faces.size(), 4 * faces.size());
  header.resize((header.size() + 8 + 63) / 64 * 64 - 8, ' ');
  std::string length(8, '\0');
  for (size_t k = 0; k < 8; ++k) length[k] = static_cast<char>(header.size() >> 8 * k & 0xff);
  const std::int64_t begin = std::ssize(header) + 8;
  SharedFile file(ranks, directory / division_name, begin + 4 * faces.size());
  ranks.together([&] {
    if (ranks.is_first()) file.write(0, length + header);
    file.write(begin + 4 * faces.begin(ranks.rank()), std::as_bytes(std::span(part)));
  });
  file.commit();
}

}  // namespace sublimit
