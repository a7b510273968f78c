// SPDX-License-Identifier: Apache-2.0
#pragma once
// Targets of a fit from a CSV, as `sublimit fit` takes them (fit_targets.h), dealt out to ranks in batches: no rank has
// all of them.
#include <filesystem>
#include <memory>

#include "sublimit/distributed/jobs/place_routes.h"
#include "sublimit/stencils/files/csv_rows.h"

namespace sublimit {

/// Where the limit should be at a place.
struct SpreadTarget {
  PlaceRoutes::WidePlace place;
  std::array<double, 3> value{};
  double weight = 1;      ///< of the squared distance
  std::int64_t line = 0;  ///< of the file
};

class SpreadTargets {
 public:
  /// Reads the header: `vertex,x,y,z` or `face,u,v,x,y,z[,weight]`.
  /// @param ranks  which must stay
  /// @throws FormatError, IoError  on all ranks
  SpreadTargets(const Ranks& ranks, const std::filesystem::path& path);
  SpreadTargets(const Ranks&&, const std::filesystem::path&) = delete;

  bool at_vertices() const { return at_vertices_; }
  /// "NAME:LINE: ", what messages about a target begin with.
  std::string where(std::int64_t line) const;

  /// This rank's share of the rows, any of them; a vertex is the place of a corner there. All ranks call, once.
  /// @throws FormatError  on all ranks, naming the line: a field that is no finite number, a face, place or vertex that
  ///                      does not exist, a negative weight, two targets at a vertex, a vertex without a surface; no
  ///                      rows, or none that counts
  std::vector<SpreadTarget> read(const PlaceRoutes& routes, const Runs& vertices);

 private:
  /// @return  vertices: their numbers as addresses
  std::vector<SpreadTarget> deal(const PlaceRoutes& routes, std::int64_t num_vertices);
  SpreadTarget next(const PlaceRoutes& routes, std::int64_t num_vertices) const;
  void place_vertices(const PlaceRoutes& routes, const Runs& vertices, std::vector<SpreadTarget>& targets) const;

  const Ranks& ranks_;
  std::string name_;
  std::unique_ptr<CsvRows> rows_;  // of the first rank
  bool at_vertices_ = false, weighted_ = false;
};

}  // namespace sublimit
