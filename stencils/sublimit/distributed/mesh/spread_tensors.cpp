// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <cstring>

#include "sublimit/base/error.h"
#include "sublimit/distributed/mesh/spread_readers.h"
#include "sublimit/eval/file/detail/safetensors.h"

namespace sublimit {
namespace {

/// Numbers of a tensor, in any of its types that are integers or numbers.
template <class T>
std::vector<T> items(const Tensor& tensor, std::int64_t first, std::int64_t count, const std::string& name) {
  const auto convert = [&]<class From>(From) {
    std::vector<T> result(static_cast<size_t>(count));
    for (std::int64_t i = 0; i < count; ++i) {
      From value;
      std::memcpy(&value, tensor.bytes.data() + size_t(first + i) * sizeof(From), sizeof(From));
      result[size_t(i)] = static_cast<T>(value);
    }
    return result;
  };
  if constexpr (std::is_floating_point_v<T>) {
    if (tensor.dtype == DType::F64) return convert(double{});
    if (tensor.dtype == DType::F32) return convert(float{});
  } else {
    if (tensor.dtype == DType::I64) return convert(std::int64_t{});
    if (tensor.dtype == DType::I32) return convert(std::int32_t{});
  }
  throw FormatError(name + ": '" + tensor.name + "' has the type " + sublimit::name(tensor.dtype) +
                    (std::is_floating_point_v<T> ? "; F64 or F32 would do" : "; I64 or I32 would do"));
}

std::int64_t rows_of(const Tensor& tensor, std::int64_t columns, const std::string& name) {
  if (tensor.shape.size() == (columns == 1 ? 1u : 2u) && (columns == 1 || tensor.shape[1] == columns))
    return tensor.shape[0];
  throw FormatError(fmt::format("{}: '{}' should have the shape N{}", name, tensor.name,
                                columns == 1 ? std::string() : fmt::format(" x {}", columns)));
}

const Tensor& require(const Safetensors& file, const char* tensor, const std::string& name) {
  const Tensor* const found = file.find(tensor);
  if (found) return *found;
  throw FormatError(
      fmt::format("{}: no tensor '{}'; a mesh has 'positions', 'face_vertices' and, unless all faces have "
                  "as many corners, 'face_sizes'",
                  name, tensor));
}

}  // namespace

SpreadMesh read_tensor_parts(const Ranks& ranks, std::span<const std::byte> bytes, const std::string& name) {
  SpreadMesh mesh;
  Safetensors file;
  std::int64_t own_corners = 0;
  const Tensor *corners = nullptr, *sizes = nullptr;
  ranks.together([&] {
    file = read_safetensors(bytes, name);
    const Tensor& positions = require(file, "positions", name);
    mesh.vertices = Runs::equal(rows_of(positions, 3, name), ranks.size());
    const std::int64_t first = mesh.vertices.begin(ranks.rank()), count = mesh.vertices.size(ranks.rank());
    const std::vector<double> x = items<double>(positions, 3 * first, 3 * count, name);
    mesh.positions = Eigen::Map<const Points>(x.data(), count, 3);
    if (!mesh.positions.allFinite()) throw InvalidMesh(name + ": 'positions' are not all finite numbers");
    corners = &require(file, "face_vertices", name);
    sizes = file.find("face_sizes");
    if (!sizes && corners->shape.size() != 2)
      throw FormatError(name +
                        ": 'face_vertices' has one dimension; then 'face_sizes' says how many corners each face has");
    mesh.faces = Runs::equal(sizes ? rows_of(*sizes, 1, name) : corners->shape[0], ranks.size());
    check_room(ranks, double(mesh.faces.size()), name);
    const std::int64_t faces = mesh.faces.size(ranks.rank());
    mesh.face_sizes = sizes ? items<std::int32_t>(*sizes, mesh.faces.begin(ranks.rank()), faces, name)
                            : std::vector<std::int32_t>(size_t(faces), static_cast<std::int32_t>(corners->shape[1]));
    for (const std::int32_t size : mesh.face_sizes) {
      if (size < 3) throw InvalidMesh(fmt::format("{}: a face has {} corners; it should have at least 3", name, size));
      own_corners += size;
    }
  });
  const std::int64_t before = ranks.sum_before(own_corners), all = ranks.sum(own_corners);
  ranks.together([&] {
    std::int64_t there = 1;
    for (const std::int64_t n : corners->shape) there *= n;
    if (there != all)
      throw FormatError(fmt::format("{}: 'face_vertices' has {} corners; 'face_sizes' says {}", name, there, all));
    mesh.face_vertices = items<std::int64_t>(*corners, before, own_corners, name);
    if (!ranks.is_first()) return;
    const auto sharp = [&](const char* tensor, const char* sharpness, std::int64_t columns, const auto& add) {
      const Tensor* const found = file.find(tensor);
      if (!found) return;
      const std::int64_t count = rows_of(*found, columns, name);
      const std::vector<std::int64_t> ids = items<std::int64_t>(*found, 0, count * columns, name);
      const Tensor& values = require(file, sharpness, name);
      if (rows_of(values, 1, name) != count)
        throw FormatError(fmt::format("{}: '{}' should have a number for each of '{}'", name, sharpness, tensor));
      const std::vector<float> s = items<float>(values, 0, count, name);
      for (std::int64_t i = 0; i < count; ++i) {
        if (!(s[size_t(i)] >= 0))
          throw FormatError(
              fmt::format("{}: '{}' has {}; a sharpness should be 0 or more", name, sharpness, s[size_t(i)]));
        add(&ids[size_t(i * columns)], s[size_t(i)], i);
      }
    };
    sharp("creases", "crease_sharpness", 2, [&](const std::int64_t* v, float s, std::int64_t i) {
      mesh.creases.push_back({v[0], v[1], s, i});
    });
    sharp("corners", "corner_sharpness", 1, [&](const std::int64_t* v, float s, std::int64_t i) {
      mesh.corners.push_back({v[0], s, i});
    });
    if (const Tensor* const holes = file.find("holes"))
      mesh.holes = items<std::int64_t>(*holes, 0, rows_of(*holes, 1, name), name);
  });
  return mesh;
}

}  // namespace sublimit
