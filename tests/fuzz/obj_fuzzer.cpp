// SPDX-License-Identifier: Apache-2.0
// Any bytes as an OBJ file with tags: an error or a mesh, and from a mesh a topology with its sharpness, never a crash.
#include <cstdint>
#include <string_view>

#include "sublimit/base/error.h"
#include "sublimit/mesh/obj.h"
#include "sublimit/mesh/sharpness.h"
#include "sublimit/mesh/topology.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace sublimit;
  try {
    const ControlMesh mesh = parse_obj({reinterpret_cast<const char*>(data), size}, "fuzz.obj");
    const Topology topology(view(mesh));
    initial_sharpness(topology, mesh, mesh.boundary.value_or(Boundary::edge_and_corner), Creasing::uniform);
    initial_holes(topology, mesh, Boundary::none);
  } catch (const Error&) {
  }
  return 0;
}
