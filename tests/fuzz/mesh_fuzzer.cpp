// SPDX-License-Identifier: Apache-2.0
// Any bytes as a PLY, OFF, STL or gzip file: an Error that names it, or a mesh whose file is read back to the same
// file. Never a crash.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <string>
#include <string_view>

#include "sublimit/base/detail/memory.h"
#include "sublimit/base/error.h"
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

void check_all(std::string_view bytes) {
  const auto ply = [](std::string_view text, std::string_view name) { return parse_ply(text, name); };
  check(bytes, ply, format_ply, false);
  check(bytes, parse_off, format_off, false);
  check(bytes, parse_stl, format_stl, true);
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
