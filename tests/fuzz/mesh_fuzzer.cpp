// SPDX-License-Identifier: Apache-2.0
// Any bytes as a PLY, OFF, STL, glTF or gzip file: an Error that names it, or a mesh whose file is read back to the
// same file. Never a crash.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <string>
#include <string_view>

#include "sublimit/base/detail/memory.h"
#include "sublimit/base/error.h"
#include "sublimit/io/detail/gltf.h"
#include "sublimit/io/detail/gzip.h"
#include "sublimit/io/detail/off.h"
#include "sublimit/io/detail/ply.h"
#include "sublimit/io/detail/stl.h"
#include "sublimit/mesh/topology.h"

namespace sublimit {
namespace {

void require(bool holds) {
  if (!holds) std::abort();
}

using Parse = std::function<Mesh(std::string_view, std::string_view)>;
using Format = std::function<std::string(const Mesh&)>;

/// Numbers that floats do not hold are refused where a format has nothing else.
bool is_beyond_floats(const Error& error) {
  return std::string_view(error.what()).find(" beyond the numbers of 32 bits") != std::string_view::npos;
}

void check(std::string_view bytes, const Parse& parse, const Format& format, bool welds) {
  Mesh mesh;
  try {
    mesh = parse(bytes, "fuzz.mesh");
  } catch (const Error& error) {
    require(std::string_view(error.what()).starts_with("fuzz.mesh:"));
    return;
  }
  std::string written;
  try {
    written = format(mesh);
  } catch (const InvalidMesh& error) {
    require(is_beyond_floats(error));
    return;
  }
  if (welds) {  // corners that floats make equal make triangles of nothing
    try {
      written = format(parse(written, "floats.mesh"));
    } catch (const InvalidMesh&) {
      return;
    }
  }
  const Mesh again = parse(written, "again.mesh");  // an Error from here on is a crash
  require(format(again) == written);
  if (!welds) require(again.face_vertices == mesh.face_vertices && again.positions == mesh.positions);
  try {
    const Topology topology(view(mesh));
  } catch (const Error&) {
  }
}

/// Files of glTF give back faces and vertices, in an order of their own: what was read once comes back as it is.
void check_gltf(std::string_view bytes) {
  const auto parse = [](std::string_view text, std::string_view name) { return parse_gltf(text, name); };
  Mesh mesh;
  try {
    mesh = parse(bytes, "fuzz.mesh");
  } catch (const Error& error) {
    require(std::string_view(error.what()).starts_with("fuzz.mesh:"));
    return;
  }
  try {
    const Mesh again = parse(format_glb(mesh), "again.mesh");
    require(again.num_vertices() == mesh.num_vertices() && again.num_faces() >= mesh.num_faces());
    require(again.objects.names.size() <= mesh.objects.names.size() + 1);
    require(again.materials.names.size() == mesh.materials.names.size());
    require(again.vertex_values.size() == mesh.vertex_values.size());
  } catch (const InvalidMesh& error) {
    require(is_beyond_floats(error));
  }
}

void check_all(std::string_view bytes) {
  const auto ply = [](std::string_view text, std::string_view name) { return parse_ply(text, name); };
  check(bytes, ply, format_ply, false);
  check(bytes, parse_off, format_off, false);
  check(bytes, parse_stl, format_stl, true);
  check_gltf(bytes);
}

}  // namespace
}  // namespace sublimit

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace sublimit;
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  check_all(bytes);
  limit_memory(1 << 24);
  if (is_gzip(bytes)) try {
      check_all(inflated(bytes, "fuzz.mesh"));
    } catch (const Error& error) {
      require(std::string_view(error.what()).starts_with("fuzz.mesh: "));
    }
  return 0;
}
