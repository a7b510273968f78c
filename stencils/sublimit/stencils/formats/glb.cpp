// SPDX-License-Identifier: Apache-2.0
#include "sublimit/stencils/formats/glb.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/detail/row_writer.h"
#include "sublimit/base/error.h"

namespace sublimit {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::int64_t rows_per_block = 8192;
constexpr int array_buffer = 34962, element_array_buffer = 34963, float_type = 5126, unsigned_int_type = 5125;

/// Appends four bytes, least first.
void put(std::string& out, std::uint32_t bits) {
  for (int k = 0; k < 4; ++k) out += static_cast<char>(bits >> (8 * k) & 0xff);
}
std::string word(std::uint64_t bits) {
  std::string out;
  put(out, static_cast<std::uint32_t>(bits));
  return out;
}

void write_floats(const Points& rows, RowWriter& out) {
  out.rows(rows.rows(), rows_per_block, [&](std::string& bytes, std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i < end; ++i)
      for (Eigen::Index k = 0; k < rows.cols(); ++k) put(bytes, std::bit_cast<std::uint32_t>(float(rows(i, k))));
  });
}

/// The parts of the binary chunk, one after the other, and what describes them.
class Description {
 public:
  explicit Description(const std::string& name) {
    json_["asset"] = {{"version", "2.0"}, {"generator", "sublimit"}};
    json_["scene"] = 0;
    json_["scenes"] = {{{"nodes", {0}}}};
    json_["nodes"] = {{{"name", name}}};
  }
  /// @return  its number
  int add(std::uint64_t bytes, int target, Json accessor) {
    const int number = static_cast<int>(json_["accessors"].size());
    json_["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", size_}, {"byteLength", bytes}, {"target", target}});
    accessor["bufferView"] = number;
    json_["accessors"].push_back(std::move(accessor));
    size_ += bytes;
    return number;
  }
  int add_floats(const Points& rows) {
    return add(std::uint64_t(rows.size()) * 4, array_buffer,
               {{"componentType", float_type}, {"count", rows.rows()}, {"type", rows.cols() == 2 ? "VEC2" : "VEC3"}});
  }
  Json& json() { return json_; }
  std::uint64_t size() const { return size_; }

 private:
  Json json_;
  std::uint64_t size_ = 0;
};

/// What positions are seen from, the node's translation: of a mesh far from the origin its middle, as floats would
/// leave it few digits.
Eigen::RowVector3d origin_of(const Points& positions) {
  constexpr double far = 16;  // sizes of the mesh: four bits less
  if (positions.rows() == 0) return Eigen::RowVector3d::Zero();
  const Eigen::RowVector3d low = positions.colwise().minCoeff(), high = positions.colwise().maxCoeff();
  const Eigen::RowVector3d middle = low / 2 + high / 2;
  return middle.norm() > far * (high - low).norm() ? middle : Eigen::RowVector3d::Zero();
}

void check(const Mesh& mesh, const std::string& name) {
  check_output(mesh, name);
  if (!mesh.face_normals.empty() || !mesh.face_varying.empty())
    throw InvalidParameter(name + ": glTF has normals and texture coordinates per vertex; split the mesh");
  if (std::ranges::any_of(mesh.face_sizes, [](Index n) { return n != 3; }))
    throw InvalidParameter(name + ": glTF has triangles alone");
  constexpr double most = std::numeric_limits<float>::max();
  if (mesh.positions.size() > 0 && mesh.positions.cwiseAbs().maxCoeff() > most)
    throw InvalidMesh(name + ": a coordinate is larger than a float, which glTF has, can be");
}

}  // namespace

void write_glb(const std::filesystem::path& path, const Mesh& mesh, const std::function<void(std::int64_t)>& progress) {
  check(mesh, path.string());
  const std::string name = path.stem().string();
  Description made(name);
  const Eigen::RowVector3d origin = origin_of(mesh.positions);
  const Points positions = mesh.positions.rowwise() - origin;
  Points texture = mesh.texture;
  if (texture.rows() > 0) texture.col(1) = (1 - texture.col(1).array()).matrix().eval();
  if (!mesh.face_sizes.empty()) {
    Json attributes;
    const int number = made.add_floats(positions);
    Json& bounds = made.json()["accessors"][size_t(number)];
    for (Eigen::Index k = 0; k < 3; ++k) {
      bounds["min"].push_back(double(float(positions.col(k).minCoeff())));
      bounds["max"].push_back(double(float(positions.col(k).maxCoeff())));
    }
    if (!origin.isZero(0)) made.json()["nodes"][0]["translation"] = {origin[0], origin[1], origin[2]};
    attributes["POSITION"] = number;
    if (mesh.normals.rows() > 0) attributes["NORMAL"] = made.add_floats(mesh.normals);
    if (texture.rows() > 0) attributes["TEXCOORD_0"] = made.add_floats(texture);
    const int indices =
        made.add(mesh.face_vertices.size() * 4, element_array_buffer,
                 {{"componentType", unsigned_int_type}, {"count", mesh.face_vertices.size()}, {"type", "SCALAR"}});
    made.json()["meshes"] = {
        {{"name", name}, {"primitives", {{{"attributes", attributes}, {"indices", indices}, {"mode", 4}}}}}};
    made.json()["nodes"][0]["mesh"] = 0;
    made.json()["buffers"] = {{{"byteLength", made.size()}}};
  }
  std::string text = made.json().dump(-1, ' ', false, Json::error_handler_t::replace);
  text.resize((text.size() + 3) / 4 * 4, ' ');
  const std::uint64_t total = 12 + 8 + text.size() + (made.size() > 0 ? 8 + made.size() : 0);
  if (total > std::numeric_limits<std::uint32_t>::max())
    throw ResourceError(path.string() + ": glTF files have less than 4 GB; this one would have " +
                        format_number(total) + " bytes; write a .ply, or allow a larger distance");
  AtomicFile file(path, progress);
  RowWriter out(file);
  out.write("glTF" + word(2) + word(total) + word(text.size()) + "JSON" + text);
  if (made.size() > 0) {
    out.write(word(made.size()) + std::string("BIN\0", 4));
    write_floats(positions, out);
    write_floats(mesh.normals, out);
    write_floats(texture, out);
    out.rows(std::ssize(mesh.face_vertices), rows_per_block,
             [&](std::string& bytes, std::int64_t begin, std::int64_t end) {
               for (std::int64_t i = begin; i < end; ++i) put(bytes, std::uint32_t(mesh.face_vertices[size_t(i)]));
             });
  }
  file.commit();
}

}  // namespace sublimit
