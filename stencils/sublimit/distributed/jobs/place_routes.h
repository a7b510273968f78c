// SPDX-License-Identifier: Apache-2.0
#pragma once
// Places by addresses of the whole mesh, to the ranks that own their faces: first to the rank that has the face in its
// run, which knows whose it is.
#include <optional>

#include "sublimit/distributed/jobs/spread_job.h"
#include "sublimit/source/address.h"

namespace sublimit {

class PlaceRoutes {
 public:
  /// As `Place`, of the whole.
  struct WidePlace {
    std::int64_t address = 0;
    double u = 0, v = 0;
  };
  /// Places on faces of this rank, those of the first rank first, in its order.
  struct Routed {
    std::vector<Place> samples;                         ///< by addresses of the part
    std::vector<std::array<std::int64_t, 2>> asked_by;  ///< of each: the rank, and its number there
  };

  /// All ranks call. All must stay.
  /// @param part  of each face of the own run; part p is of rank p
  /// @param own   this rank's part
  PlaceRoutes(const Ranks& ranks, const SpreadJob& job, const std::vector<int>& part, const MeshPart& own);
  PlaceRoutes(const Ranks&&, const SpreadJob&, const std::vector<int>&, const MeshPart&) = delete;
  PlaceRoutes(const Ranks&, const SpreadJob&&, const std::vector<int>&, const MeshPart&) = delete;
  PlaceRoutes(const Ranks&, const SpreadJob&, const std::vector<int>&&, const MeshPart&) = delete;
  PlaceRoutes(const Ranks&, const SpreadJob&, const std::vector<int>&, const MeshPart&&) = delete;

  std::int64_t num_addresses() const { return addresses_.size(); }  ///< of the whole
  bool triangles() const { return whole_ == 3; }

  /// @param where, hint  what the message begins and ends with
  /// @throws FormatError  an address that does not exist, parameters outside its square or triangle
  void check(const WidePlace& place, const std::string& where, const std::string& hint = "") const;

  /// All ranks call.
  /// @param places  that `check` accepts
  Routed route(std::span<const WidePlace> places) const;

  /// Where the limits of vertices are: at a corner of the first face there that is no hole; none: no surface is there.
  /// All ranks call.
  /// @param vertices  of the whole, that there are
  std::vector<std::optional<WidePlace>> at_vertices(std::span<const std::int64_t> vertices) const;

 private:
  std::int64_t first_face() const { return job_.mesh.faces.begin(ranks_.rank()); }

  const Ranks& ranks_;
  const SpreadJob& job_;
  const std::vector<int>& part_;
  const MeshPart& own_;
  std::int32_t whole_ = 4;                 // corners of faces that are one address
  Runs addresses_;                         // of the runs of faces
  std::vector<std::int64_t> run_, local_;  // first address of each face of the own run, and of the part
};

}  // namespace sublimit
