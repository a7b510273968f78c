// SPDX-License-Identifier: Apache-2.0
#pragma once
// What there is to know of a mesh before it is refined: counts, valences, borders, tags, faults, and whether a scheme
// takes it.
#include <nlohmann/json.hpp>

#include <map>
#include <string>
#include <vector>

#include "sublimit/jobs/mesh_job.h"
#include "sublimit/limit/limit_integrals.h"

namespace sublimit {

struct [[nodiscard]] MeshInfo {
  /// How many there are of each.
  using Histogram = std::map<Index, Index>;

  Index vertices = 0, edges = 0, faces = 0;
  Index euler_characteristic = 0, components = 0, boundary_loops = 0;
  Histogram face_sizes, interior_valences, boundary_valences;
  bool triangles = false;  ///< addresses are triangles
  Index addresses = 0;     ///< faces that places may be on
  Index creases = 0, corners = 0, holes = 0;
  std::string boundary, creasing, smooth_triangles, face_varying;  ///< rules in force, in words
  struct Channel {
    std::string name;
    Index values = 0, numbers = 0;  ///< how many values, of how many numbers each
  };
  std::vector<Channel> channels;
  std::vector<std::string> warnings, faults;

  std::string scheme;                   ///< if one was asked about
  std::string why_not;                  ///< what keeps it from taking the mesh; empty: it does
  std::vector<double> predicted_bytes;  ///< of levels 1 to 6
  std::optional<LimitIntegrals> limit;  ///< if they were asked for
};

/// @param triangles  addresses are triangles, whatever the scheme
MeshInfo mesh_info(const MeshJob& job, bool triangles = false);

/// Integrals over the limit of a mesh.
/// @throws InvalidOption  no scheme; else as `LimitSurface` and `limit_integrals`
LimitIntegrals limit_integrals(const MeshJob& job);

/// What `sublimit info --json` and that of many processes say alike, of whatever counts a mesh.
template <class Info>
nlohmann::ordered_json json_of_counts(const Info& info, const std::string& name) {
  using Json = nlohmann::ordered_json;
  const auto counts = [](const typename Info::Histogram& histogram) {
    Json json = Json::object();
    for (const auto& [key, count] : histogram) json[std::to_string(key)] = count;
    return json;
  };
  return {{"mesh", name},
          {"vertices", info.vertices},
          {"edges", info.edges},
          {"faces", info.faces},
          {"euler_characteristic", info.euler_characteristic},
          {"components", info.components},
          {"boundary_loops", info.boundary_loops},
          {"face_sizes", counts(info.face_sizes)},
          {"addresses", info.why_not.empty() ? Json(info.addresses) : Json()},
          {"interior_valences", counts(info.interior_valences)},
          {"boundary_valences", counts(info.boundary_valences)},
          {"creases", info.creases},
          {"corners", info.corners},
          {"holes", info.holes},
          {"boundary", info.boundary},
          {"creasing", info.creasing},
          {"triangles", info.smooth_triangles}};
}

/// As `sublimit info --json` prints it.
/// @param name  of the mesh
nlohmann::ordered_json to_json(const MeshInfo& info, const std::string& name);

}  // namespace sublimit
