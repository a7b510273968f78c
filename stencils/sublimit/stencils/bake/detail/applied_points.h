// SPDX-License-Identifier: Apache-2.0
#pragma once
// The results of a table for one frame, as a mesh or as rows of a CSV.
#include "sublimit/eval/table/baked_table.h"
#include "sublimit/io/write_mesh.h"

namespace sublimit {

/// Places, statuses and faces of a table's points, for writing results.
class AppliedPoints {
 public:
  template <class Real>
  explicit AppliedPoints(const BakedTable<Real>& table);

  /// Sets which points of a rational table do not exist: one entry for each point, 1 at a pole.
  void set_poles(std::vector<std::uint8_t> poles) { poles_ = std::move(poles); }

  /// Returns unit normals from first derivatives, oriented by the winding of faces. They are zero where there
  /// is no tangent plane, where the derivatives are parallel within rounding, and everywhere if the table has
  /// no derivatives.
  /// @param values  quantities x points x 3, as the table's `apply` gives them
  template <class Real>
  Points normals(std::span<const Real> values) const;

  /// Returns the mesh of points and faces, with normals if the table has derivatives.
  template <class Real>
  Mesh mesh(const FaceList& faces, std::span<const Real> values) const;

  /// Writes a CSV, which appears whole or not at all:
  ///
  ///     [face,u,v,][status,]x,y,z[,xu,yu,zu,xv,yv,zv[,xuu,...]][,nx,ny,nz]
  ///
  /// with addresses if the table has them, statuses for points of the limit, and normals for three channels with
  /// derivatives; where a normal is zero, the status is `undefined-normal`. Numbers have the shortest form that reads
  /// back to the same bits; fields of quantities that do not exist are empty.
  /// @param channels  names of the channels: `x,y,z`
  /// @param values    quantities x points x channels
  /// @param progress  called with the number of bytes written so far, if given
  template <class Real>
  void write_csv(const std::filesystem::path& path, const std::vector<std::string>& channels,
                 std::span<const Real> values, const std::function<void(std::int64_t)>& progress = {}) const;

 private:
  template <class Real>
  void append_row(std::string& out, std::int64_t point, const SampleAddresses& addresses, size_t channels,
                  std::span<const Real> values, const Points& normals) const;
  std::int64_t num_points_ = 0;
  int quantities_ = 1;
  bool has_status_ = false;
  std::function<SampleAddresses()> addresses_;  // only for a CSV
  std::vector<std::string> status_names_;
  std::vector<std::int8_t> orders_;   // by status
  std::vector<std::uint8_t> status_;  // status of each point; empty: all have the first one
  std::vector<bool> has_plane_;       // by status
  std::vector<std::uint8_t> poles_;   // empty: all points exist
};

}  // namespace sublimit
