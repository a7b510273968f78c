// SPDX-License-Identifier: Apache-2.0
// Any bytes as an OBJ file. With tags: an Error that says where, or a mesh that is written and read back to the same
// bits and that has a topology with its sharpness. With free-form curves and surfaces: an Error that says where, or
// shapes whose text reads back to the same text. Never a crash.
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "sublimit/base/error.h"
#include "sublimit/io/detail/obj.h"
#include "sublimit/io/free_form.h"
#include "sublimit/io/write_mesh.h"
#include "sublimit/mesh/sharpness.h"
#include "sublimit/mesh/topology.h"

namespace sublimit {
namespace {

void require(bool holds) {
  if (!holds) std::abort();
}

void require_same(float a, float b) { require(a == b || (std::isinf(a) && b == 10)); }

void require_same(const Mesh& a, const Mesh& b) {
  require(a.positions.rows() == b.positions.rows());
  for (Eigen::Index i = 0; i < a.positions.size(); ++i) {
    require(std::bit_cast<std::uint64_t>(a.positions.data()[i]) == std::bit_cast<std::uint64_t>(b.positions.data()[i]));
  }
  require(a.face_sizes == b.face_sizes && a.face_vertices == b.face_vertices && a.holes == b.holes);
  require(a.boundary == b.boundary && a.creasing == b.creasing && a.triangles == b.triangles);
  require(a.face_varying_interpolation == b.face_varying_interpolation &&
          a.face_varying.size() == b.face_varying.size());
  for (std::size_t c = 0; c < a.face_varying.size(); ++c) {
    require(a.face_varying[c].indices == b.face_varying[c].indices);
    require(a.face_varying[c].values.rows() == b.face_varying[c].values.rows());
    require(a.face_varying[c].values == b.face_varying[c].values);
  }
  require(a.creases.size() == b.creases.size() && a.corners.size() == b.corners.size());
  for (std::size_t i = 0; i < a.creases.size(); ++i) {
    require(a.creases[i].tail == b.creases[i].tail && a.creases[i].head == b.creases[i].head);
    require_same(a.creases[i].sharpness, b.creases[i].sharpness);
  }
  for (std::size_t i = 0; i < a.corners.size(); ++i) {
    require(a.corners[i].vertex == b.corners[i].vertex);
    require_same(a.corners[i].sharpness, b.corners[i].sharpness);
  }
}

void check_mesh(std::string_view text) {
  Mesh mesh;
  try {
    mesh = parse_obj(text, "fuzz.obj");
  } catch (const Error& error) {
    require(std::string_view(error.what()).starts_with("fuzz.obj:"));
    return;
  }
  const Mesh again = parse_obj(format_obj(mesh), "again.obj");  // an Error here is a crash
  require_same(mesh, again);
  require(again.warnings.empty());

  try {
    const Topology topology(view(mesh));
    initial_sharpness(topology, mesh, mesh.boundary.value_or(Boundary::edge_and_corner), Creasing::uniform);
    initial_holes(topology, mesh, Boundary::none);
  } catch (const Error&) {
  }
}

void check_free_form(std::string_view text) {
  FreeForm shapes;
  try {
    shapes = parse_free_form(text, "fuzz.obj");
  } catch (const Error& error) {
    require(std::string_view(error.what()).starts_with("fuzz.obj:"));
    return;
  }
  const std::string written = format_free_form(shapes);  // an Error here or below is a crash
  const FreeForm again = parse_free_form(written, "again.obj");
  require(again.curves.size() == shapes.curves.size() && again.surfaces.size() == shapes.surfaces.size());
  require(again.curves_2d.size() == shapes.curves_2d.size() && again.connections.size() == shapes.connections.size());
  require(format_free_form(again) == written);
}

}  // namespace
}  // namespace sublimit

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  sublimit::check_mesh(text);
  sublimit::check_free_form(text);
  return 0;
}
