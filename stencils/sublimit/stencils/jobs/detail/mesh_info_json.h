// SPDX-License-Identifier: Apache-2.0
#pragma once
// Information on a mesh as JSON.
#include <nlohmann/json.hpp>

#include <string>

#include "sublimit/stencils/jobs/mesh_info.h"

namespace sublimit {

/// Returns the entries that `sublimit info --json` and its counterpart on many processes have in common.
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

/// Returns integrals as the entry `limit` of `sublimit info --json`.
nlohmann::ordered_json to_json(const LimitIntegrals& limit);

/// Returns information as `sublimit info --json` prints it.
/// @param name  name of the mesh
nlohmann::ordered_json to_json(const MeshInfo& info, const std::string& name);

}  // namespace sublimit
