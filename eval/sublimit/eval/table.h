// SPDX-License-Identifier: Apache-2.0
#pragma once
// A table loaded from a file, and applied to the control points of every frame:
//
//   const Table table = load("torus.safetensors");
//   std::vector<float> result(table.num_results(3));
//   table.apply(points, 3, result);  // all positions; then derivatives, if the table has them
//
// `apply` uses all threads of oneTBB. A program with threads of its own divides a frame into parts:
//
//   const TableFrame<float> frame(table, points, 3, result);
//   frame.apply_part(i, n);  // for i = 0 ... n - 1, on any thread
//   frame.finish();          // on one thread, after all parts
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "sublimit/eval/evaluate/pattern_evaluator.h"
#include "sublimit/eval/file/table_file.h"

namespace sublimit {

/// A table: points of a level, of its limit, or of places on the limit, as weighted sums of the control points of one
/// connectivity. It never changes: any number of threads may share it, and copies share all its data.
class Table {
 public:
  /// Makes a table ready to be applied.
  explicit Table(AnyTable table);
  // Moving copies: a moved-from object stays valid.
  Table(const Table&) = default;
  Table& operator=(const Table&) = default;

  std::int32_t num_control_points() const;  ///< number of points that it is applied to
  std::int64_t num_points() const;          ///< number of points that it makes
  /// Returns 1: positions; 3: du, dv too; or 6: duu, duv, dvv too.
  int quantities() const;
  /// Returns the number of results that `apply` makes of points with so many channels.
  /// @throws InvalidParameter  channels below 1, for a rational table below 2
  size_t num_results(int channels) const;
  const TableInfo& info() const&;                              ///< description: scheme, kind of points, statuses
  TableInfo info() && { return std::as_const(*this).info(); }  ///< a copy, from temporaries
  bool is_double() const;                                      ///< true if weights are double, false if they are float
  /// Returns the faces between the points, without those of holes.
  /// @throws ResourceError  more points than 32-bit indices count
  FaceList faces() const;

  /// Returns the point of each vertex of the refined mesh, in the order of refinement; -1 of vertices that no face has.
  /// Empty unless the table was baked with it (`BakeOptions::order`): files do not have it.
  std::span<const std::int64_t> refined_points() const;

  /// Makes all points of one frame, on all threads of oneTBB; the same bits for any number of them. Numbers of another
  /// precision than the table's are converted, which takes memory.
  /// @param points    num_control_points x channels, interleaved; for a rational table the last channel is the weight,
  ///                  and the others are multiplied by it
  /// @param result    quantities x num_points x channels, interleaved: all positions first. A rational table divides
  ///                  by the weight, which is left out: one channel less
  /// @throws InvalidParameter  spans of the wrong length, channels below 1
  void apply(std::span<const float> points, int channels, std::span<float> result) const;
  /// Makes all points of one frame in double; see the overload above.
  void apply(std::span<const double> points, int channels, std::span<double> result) const;

  /// Applies the transpose: makes gradients with respect to the control points from gradients with respect to the
  /// results. Homogeneous columns of a rational table are not divided.
  /// @param values  quantities x num_points x channels, interleaved; or the first quantities alone
  /// @param result  num_control_points x channels; overwritten
  /// @throws InvalidParameter  spans of the wrong length, channels below 1
  void apply_transpose(std::span<const float> values, int channels, std::span<float> result) const;
  /// Applies the transpose in double; see the overload above.
  void apply_transpose(std::span<const double> values, int channels, std::span<double> result) const;

  /// Returns the evaluator, which takes several frames and other layouts, makes tangent frames, and works in parts. The
  /// reference is valid while this table or a copy of it exists.
  /// @throws InvalidParameter  the table's weights are of the other precision
  template <class Real>
  const PatternEvaluator<Real>& evaluator() const;

  /// Returns the data of the table, as it was baked or read. Valid while this table or a copy of it exists.
  const AnyTable& baked() const;

  /// Writes a file, which appears whole or not at all (eval/table_format.md).
  /// @throws IoError  unwritable;  ResourceError  a full disk
  void save(const std::filesystem::path& path) const;

 private:
  struct Prepared;
  std::shared_ptr<const Prepared> prepared_;
};

/// One frame in parts, for a program with threads of its own. Threads may apply different parts at the same time; after
/// all parts, one thread finishes the frame.
template <class Real>
class TableFrame {
 public:
  /// Prepares a frame: makes what all parts need.
  /// @param points, channels, result  as for `Table::apply`; both spans must stay valid until the frame is finished
  /// @throws InvalidParameter  as `Table::apply`; a table of the other precision
  TableFrame(const Table& table, std::span<const Real> points, int channels, std::span<Real> result);

  /// Makes the points of one of `parts` parts of about the same size.
  /// @throws InvalidParameter  not 0 <= part < parts
  void apply_part(int part, int parts) const;
  /// Makes the points that belong to no part. To be called once, after all parts.
  void finish() const;

 private:
  Table table_;
  Evaluation<Real> frame_;
  std::vector<Real> inputs_;
};

extern template class TableFrame<float>;
extern template class TableFrame<double>;

/// Loads a table by mapping its file into memory: pages are read when they are first used.
/// @throws IoError      missing, unreadable
/// @throws FormatError  not a table, or a damaged one: the message says what is wrong with it
[[nodiscard]] Table load(const std::filesystem::path& path, const LoadOptions& options = {});

}  // namespace sublimit
