// SPDX-License-Identifier: Apache-2.0
// Any bytes as a scene of USD: an Error that names it, or a mesh whose file is read back to the same file; and the
// scene with triangles for its meshes can be read. Never a crash.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

#include "sublimit/base/detail/memory.h"
#include "sublimit/base/error.h"
#include "sublimit/io/detail/usd.h"
#include "sublimit/io/detail/usd_flat.h"

namespace sublimit {
namespace {

void require(bool holds) {
  if (!holds) std::abort();
}

/// The polygons of a mesh, cut from their first corners, as what it becomes.
UsdFlat fans_of(const UsdMesh& from) {
  UsdFlat flat{.from = &from};
  flat.mesh = mesh_of(from, [](const std::string& path) { return path; });
  const std::vector<Mesh::FaceVarying> channels = std::move(flat.mesh.face_varying);
  flat.mesh.face_varying.clear();
  for (const Mesh::FaceVarying& channel : channels)
    flat.mesh.face_varying.push_back({channel.name, channel.values, {}});
  flat.mesh.face_sizes.clear();
  flat.mesh.face_vertices.clear();
  Index first = 0;
  for (Index f = 0; f < from.mesh.num_faces(); ++f) {
    const Index size = from.mesh.face_sizes[std::size_t(f)];
    for (Index k = 1; k + 1 < size; ++k) {
      flat.faces.push_back(f);
      flat.mesh.face_sizes.push_back(3);
      for (const Index corner : {first, first + k, first + k + 1}) {
        flat.mesh.face_vertices.push_back(from.mesh.face_vertices[std::size_t(corner)]);
        for (std::size_t c = 0; c < channels.size(); ++c)
          flat.mesh.face_varying[c].indices.push_back(channels[c].indices[std::size_t(corner)]);
      }
    }
    first += size;
  }
  flat.mesh.normals = Points::Ones(1, 3);
  flat.mesh.face_normals.assign(flat.mesh.face_vertices.size(), 0);
  for (std::size_t k = 0; k < from.times.size(); ++k) {
    flat.points.push_back(flat.mesh.positions);
    flat.normals.push_back(Points::Ones(Eigen::Index(flat.mesh.face_vertices.size()), 3));
  }
  return flat;
}

void check_mesh(std::string_view bytes) {
  Mesh mesh;
  try {
    mesh = parse_usd(bytes, "fuzz.usda");
  } catch (const Error& error) {
    require(std::string_view(error.what()).starts_with("fuzz.usda"));
    return;
  }
  std::string written;
  try {
    written = format_usda(mesh);
  } catch (const InvalidParameter&) {  // more columns than USD has types for, names that no file holds
    return;
  } catch (const InvalidMesh&) {  // transforms beyond the range of numbers
    return;
  }
  const Mesh again = parse_usd(written, "again.usda");  // an Error from here on is a crash
  require(again.num_vertices() == mesh.num_vertices() && again.face_vertices.size() == mesh.face_vertices.size());
  const std::string second = format_usda(again);
  require(format_usda(parse_usd(second, "second.usda")) == second);
}

void check_flat(std::string_view bytes) {
  try {
    UsdStage stage(std::string(bytes), "fuzz.usda");
    std::vector<std::string> warnings;
    const std::vector<UsdMesh> meshes = usd_meshes(stage, warnings);
    std::vector<UsdFlat> flats;
    for (const UsdMesh& mesh : meshes) flats.push_back(fans_of(mesh));
    const std::string layer = flattened_layer(stage, flats, warnings);
    (void)flattened_package(stage, layer, "flat.usdz", warnings);
    try {
      UsdStage(layer, "flat.usda").visit([](const UsdPrim&) { return true; });
    } catch (const Error&) {
      std::abort();
    }
  } catch (const Error&) {
  }
}

}  // namespace
}  // namespace sublimit

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace sublimit;
  limit_memory(1 << 26);
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  check_mesh(bytes);
  check_flat(bytes);
  return 0;
}
