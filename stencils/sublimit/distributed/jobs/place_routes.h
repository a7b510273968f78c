// SPDX-License-Identifier: Apache-2.0
#pragma once
// Sending places, given by addresses of the whole mesh, to the ranks that own their faces. A place first goes
// to the rank that has its face in its run, since that rank knows the owner.
#include <optional>

#include "sublimit/distributed/jobs/spread_job.h"
#include "sublimit/source/address.h"

namespace sublimit {

class PlaceRoutes {
 public:
  /// A place by its address in the whole mesh, as `Place` in 64 bits.
  struct WidePlace {
    std::int64_t address = 0;
    double u = 0, v = 0;
  };
  /// Places on faces that this rank owns, ordered by the rank that asked, then by their number there.
  struct Routed {
    std::vector<Place> samples;                         ///< places by addresses of the part
    std::vector<std::array<std::int64_t, 2>> asked_by;  ///< for each place: rank that asked, and number there
  };

  /// Collective: all ranks call. All arguments must outlive this.
  /// @param part  part of each face of this rank's run; rank p has part p
  /// @param own   part of this rank
  PlaceRoutes(const Ranks& ranks, const SpreadJob& job, const std::vector<int>& part, const MeshPart& own);
  PlaceRoutes(const Ranks&&, const SpreadJob&, const std::vector<int>&, const MeshPart&) = delete;
  PlaceRoutes(const Ranks&, const SpreadJob&&, const std::vector<int>&, const MeshPart&) = delete;
  PlaceRoutes(const Ranks&, const SpreadJob&, const std::vector<int>&&, const MeshPart&) = delete;
  PlaceRoutes(const Ranks&, const SpreadJob&, const std::vector<int>&, const MeshPart&&) = delete;

  std::int64_t num_addresses() const { return addresses_.size(); }  ///< addresses of the whole mesh
  bool triangles() const { return whole_ == 3; }

  /// Checks a place.
  /// @param where, hint  start and end of the message
  /// @throws FormatError  an address that does not exist, parameters outside its square or triangle
  void check(const WidePlace& place, const std::string& where, const std::string& hint = "") const;

  /// Sends places to the owners of their faces, and returns those that other ranks sent here. Collective: all
  /// ranks call.
  /// @param places  places that `check` accepts
  Routed route(std::span<const WidePlace> places) const;

  /// Returns a place at the limit of each vertex: a corner of the first of its faces that is not a hole; absent
  /// if it has no such face. Collective: all ranks call.
  /// @param vertices  existing vertices, by their numbers in the whole mesh
  std::vector<std::optional<WidePlace>> at_vertices(std::span<const std::int64_t> vertices) const;

 private:
  std::int64_t first_face() const { return job_.mesh.faces.begin(ranks_.rank()); }

  const Ranks& ranks_;
  const SpreadJob& job_;
  const std::vector<int>& part_;
  const MeshPart& own_;
  std::int32_t whole_ = 4;                 // corners of faces with one address; others have one for each corner
  Runs addresses_;                         // addresses of each rank's run of faces
  std::vector<std::int64_t> run_, local_;  // first address of each face: of the run; of the part
};

}  // namespace sublimit
