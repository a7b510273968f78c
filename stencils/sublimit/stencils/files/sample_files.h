// SPDX-License-Identifier: Apache-2.0
#pragma once
// Samples of a limit surface, from and to CSV files of any length: a batch is read, evaluated and written before the
// next one.
//
//   in    face,u,v
//   out   face,u,v,status,x,y,z[,xu,yu,zu,xv,yv,zv[,xuu,yuu,zuu,xuv,yuv,zuv,xvv,yvv,zvv]],nx,ny,nz[,k1,k2,gauss,mean]
//
// An .npy has the same columns, as fields of records. Faces are numbered by `Addresses`. Numbers have the shortest form
// that reads back to the same bits; what does not exist is an empty field.
#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <vector>

#include "sublimit/stencils/files/patch_places.h"
#include "sublimit/stencils/formats/csv_rows.h"
#include "sublimit/stencils/formats/row_file.h"
#include "sublimit/surface/limit_map.h"

namespace sublimit {

/// Source of samples: sets `batch` to the next ones, at most `most`; fewer only at the end.
using SampleSource = std::function<void(std::vector<Place>& batch, size_t most)>;

/// Throws an error for a place that is not on the surface, and says what would be right.
/// @param where  start of the message
/// @param hint   end of the message
/// @throws FormatError  a face that does not exist, parameters outside its square or triangle
void check_place(FaceCount faces, std::int64_t face, double u, double v, const std::string& where,
                 const std::string& hint = "");

/// Reads samples from a file.
class SampleReader {
 public:
  /// @param clamp  move parameters outside the domain to the nearest place on its boundary
  /// @throws IoError, FormatError  as CsvRows
  explicit SampleReader(const std::filesystem::path& path, bool clamp = false);

  /// @param faces  faces of the surface
  /// @throws FormatError  rows that are not samples, with file:line: not three fields, a face that does not exist,
  ///                      parameters that are not finite or outside the domain
  void read(std::vector<Place>& batch, size_t most, FaceCount faces);

  /// Returns the number of samples that were moved.
  std::int64_t num_clamped() const { return num_clamped_; }

 private:
  CsvRows rows_;
  bool clamp_;
  std::int64_t num_clamped_ = 0;
};

/// Returns the place of the domain nearest to finite (u, v): of the square, or of the triangle u, v >= 0, u + v <= 1.
Place clamped(const Place& place, bool triangle);

/// Columns of a file of samples.
struct SampleColumns {
  int derivatives = 0;  ///< 0, 1 or 2
  bool curvature = false;

  int num_numbers() const { return 6 + (derivatives >= 1 ? 6 : 0) + (derivatives >= 2 ? 9 : 0) + (curvature ? 4 : 0); }
  /// Returns the order of derivatives to evaluate; normals need first derivatives.
  int order() const { return curvature ? 2 : std::max(derivatives, 1); }
};

/// Returns the first line of a file of samples.
/// @param places  names of the columns of places
std::string sample_header(SampleColumns columns, const std::string& places = "face,u,v");
/// Appends the results at a place to its row: from the comma after the place to the end of the line.
/// @param found  samples of order `columns.order()`, with normals
void append_found(std::string& out, const LimitSamples& found, std::int64_t row, SampleColumns columns);

/// Writes samples with their results to a file, which appears whole or not at all.
class SampleWriter {
 public:
  /// @param own  places in own parameters, if they were given so
  SampleWriter(const std::filesystem::path& path, SampleColumns columns, const OwnPlaces* own = nullptr);
  /// @param found  of order `columns.order()`, with normals
  void write(std::span<const Place> samples, const LimitSamples& found);
  void commit() { file_.commit(); }
  /// Returns true if the reader of standard output has closed it.
  bool is_dropped() const { return file_.is_dropped(); }

 private:
  RowFile file_;
  SampleColumns columns_;
  const OwnPlaces* own_;
};

struct SampleSummary {
  std::int64_t num_samples = 0;
  std::array<std::int64_t, num_limit_statuses> by_status{};  ///< in the order of LimitStatus

  /// `24 regular, 8 extraordinary`, in the order of LimitStatus.
  std::string text() const;
};

/// Evaluates all samples of a source and writes them.
/// @param points    columns of the surface's control points
/// @param progress  called with the number of samples written so far, if given
/// @param own       places of each batch in own parameters, set by `source`
/// @note  Memory does not grow with the number of samples. Any number of threads gives the same bytes.
SampleSummary write_samples(const std::filesystem::path& path, const LinearSource& surface, const Points& points,
                            const SampleSource& source, SampleColumns columns,
                            const std::function<void(std::int64_t)>& progress = {}, const OwnPlaces* own = nullptr);

/// Writes samples of a source with its points, which need not be linear.
SampleSummary write_samples(const std::filesystem::path& path, const BoundSource& surface, const SampleSource& source,
                            SampleColumns columns, const std::function<void(std::int64_t)>& progress = {});

/// Returns an estimate of the least size of a file of samples, in bytes.
double predicted_bytes(double num_samples, SampleColumns columns);

}  // namespace sublimit
