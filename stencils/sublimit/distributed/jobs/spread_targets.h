// SPDX-License-Identifier: Apache-2.0
#pragma once
// Targets of a fit from a CSV in the format of `sublimit fit` (fit_targets.h), distributed to the ranks in
// batches, so that no rank has all of them.
#include <filesystem>
#include <memory>

#include "sublimit/distributed/jobs/place_routes.h"
#include "sublimit/stencils/formats/csv_rows.h"

namespace sublimit {

/// A point that the limit should have at a place.
struct SpreadTarget {
  PlaceRoutes::WidePlace place;
  std::array<double, 3> value{};
  double weight = 1;      ///< weight of the squared distance
  std::int64_t line = 0;  ///< line of the file
};

class SpreadTargets {
 public:
  /// Opens a file and reads its header: `vertex,x,y,z` or `face,u,v,x,y,z[,weight]`. Collective: all ranks
  /// call.
  /// @param ranks  must outlive this
  /// @throws FormatError, IoError  on all ranks
  SpreadTargets(const Ranks& ranks, const std::filesystem::path& path);
  SpreadTargets(const Ranks&&, const std::filesystem::path&) = delete;

  bool at_vertices() const { return at_vertices_; }
  /// Returns "NAME:LINE: ", the start of messages about a target.
  std::string where(std::int64_t line) const;

  /// Reads all rows and returns this rank's share of them, which is any of them. A target at a vertex gets the
  /// place of a face's corner there. Collective: all ranks call, once.
  /// @throws FormatError  on all ranks, naming the line: a field that is no finite number, a face, place or vertex that
  ///                      does not exist, a negative weight, two targets at a vertex, a vertex without a surface; no
  ///                      rows, or none that counts
  std::vector<SpreadTarget> read(const PlaceRoutes& routes, const Runs& vertices);

 private:
  /// Returns this rank's share of the rows. Targets at vertices have the vertex as their address.
  std::vector<SpreadTarget> deal(const PlaceRoutes& routes, std::int64_t num_vertices);
  SpreadTarget next(const PlaceRoutes& routes, std::int64_t num_vertices) const;
  void place_vertices(const PlaceRoutes& routes, const Runs& vertices, std::vector<SpreadTarget>& targets) const;

  const Ranks& ranks_;
  std::string name_;
  std::unique_ptr<CsvRows> rows_;  // first rank only
  bool at_vertices_ = false, weighted_ = false;
};

}  // namespace sublimit
