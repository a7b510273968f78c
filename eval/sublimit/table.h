// SPDX-License-Identifier: Apache-2.0
#pragma once
// A table that is ready to be applied, every frame:
//
//   const Table table = load("torus.safetensors");
//   std::vector<float> result(table.num_results(3));
//   table.apply(points, 3, result);                      // positions; then derivatives, if the table has them
//
//   const TableFrame<float> frame(table, points, 3, result);   // the same by threads of one's own:
//   frame.apply_part(i, n);                                    // by any of them, for i = 0 ... n - 1
//   frame.finish();                                            // when all are done
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <vector>

#include "sublimit/pattern_evaluator.h"
#include "sublimit/table_file.h"

namespace sublimit {

/// A table: points of a level, of its limit, or of places on the limit, as weighted sums of the control points of one
/// connectivity. It never changes: threads may share it, and copies share all that it consists of.
class Table {
 public:
  explicit Table(AnyTable table);
  // Moving copies: a moved-from object stays valid.
  Table(const Table&) = default;
  Table& operator=(const Table&) = default;

  std::int32_t num_control_points() const;  ///< points that it is applied to
  std::int64_t num_points() const;          ///< points that it makes
  /// 1: positions; 3: du, dv too; 6: duu, duv, dvv too.
  int quantities() const;
  /// Returns how many numbers `apply` makes of points of so many channels.
  size_t num_results(int channels) const;
  const TableInfo& info() const;  ///< what it was made of
  /// Whether its weights are double; else float.
  bool is_double() const;
  /// Returns the faces between the points, without those of holes.
  /// @throws ResourceError  more points than 32-bit numbers
  FaceList faces() const;

  /// Makes all points of one frame, by all threads of oneTBB: the same bits for any number of them. Numbers of another
  /// precision than the table's are converted, which takes memory.
  /// @param points    num_control_points x channels, interleaved; of a rational table the last channel is the weight
  /// @param result    quantities x num_points x channels, interleaved: all positions first; of a rational table divided
  ///                  by the weight, which is left out
  /// @throws InvalidParameter  spans of the wrong length, channels below 1
  void apply(std::span<const float> points, int channels, std::span<float> result) const;
  /// Takes and makes doubles; else as above.
  void apply(std::span<const double> points, int channels, std::span<double> result) const;

  /// Applies the transpose: gradients with regard to the control points, of those with regard to the results.
  /// @param values  quantities x num_points x channels, as `apply` makes; or the first quantities alone
  /// @param result  num_control_points x channels; overwritten
  /// @throws InvalidParameter  spans of the wrong length, channels below 1
  void apply_transpose(std::span<const float> values, int channels, std::span<float> result) const;
  /// Takes and makes doubles; else as above.
  void apply_transpose(std::span<const double> values, int channels, std::span<double> result) const;

  /// Returns what applies it: to several frames, other layouts, tangent frames, in parts for a pool of one's own.
  /// @throws InvalidParameter  the table's weights are of the other precision
  template <class Real>
  const PatternEvaluator<Real>& evaluator() const;

  /// Returns the table as it was baked or read.
  const AnyTable& baked() const;

  /// Writes a file, which appears whole or not at all.
  /// @throws IoError  unwritable;  ResourceError  a full disk
  void save(const std::filesystem::path& path) const;

 private:
  struct Prepared;
  std::shared_ptr<const Prepared> prepared_;
};

/// One frame in parts, for threads of one's own: any thread may apply any part; when all are done, one of them
/// finishes.
template <class Real>
class TableFrame {
 public:
  /// Makes what all parts need.
  /// @param points, channels, result  as of `Table::apply`; both spans must stay
  /// @throws InvalidParameter  as `Table::apply`; a table of the other precision
  TableFrame(const Table& table, std::span<const Real> points, int channels, std::span<Real> result);

  /// Makes the points of one of so many parts of about the same size.
  /// @throws InvalidParameter  not 0 <= part < parts
  void apply_part(int part, int parts) const;
  /// Makes the points that belong to no part, after the parts.
  void finish() const;

 private:
  Table table_;
  Evaluation<Real> frame_;
  std::vector<Real> inputs_;
};

extern template class TableFrame<float>;
extern template class TableFrame<double>;

/// Maps a table's file into memory: pages are read when they are first used.
/// @throws IoError      missing, unreadable
/// @throws FormatError  not a table, or a broken one: says what is wrong with it
[[nodiscard]] Table load(const std::filesystem::path& path, const LoadOptions& options = {});

}  // namespace sublimit
