// SPDX-License-Identifier: Apache-2.0
#pragma once
// Samples of a limit surface, from and to CSV files of any length: a batch is read, evaluated and written before the
// next one.
//
//   in    face,u,v
//   out   face,u,v,status,x,y,z[,xu,yu,zu,xv,yv,zv[,xuu,yuu,zuu,xuv,yuv,zuv,xvv,yvv,zvv]],nx,ny,nz[,k1,k2,gauss,mean]
//
// Faces are numbered by `Addresses`. Numbers have the shortest form that reads back to the same bits; what does not
// exist is an empty field.
#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <vector>

#include "sublimit/base/atomic_file.h"
#include "sublimit/files/csv_rows.h"
#include "sublimit/files/patch_places.h"
#include "sublimit/limit/limit_map.h"

namespace sublimit {

/// The next samples: `batch` becomes at most `most` long, shorter only at the end.
using SampleSource = std::function<void(std::vector<Sample>& batch, size_t most)>;

/// A place that is not on the surface, with what would be right.
/// @param where  what the message begins with
/// @param hint   what it ends with
/// @throws FormatError  a face that does not exist, parameters outside its square or triangle
void check_place(FaceCount faces, std::int64_t face, double u, double v, const std::string& where,
                 const std::string& hint = "");

/// Samples from a file.
class SampleReader {
 public:
  /// @param clamp  parameters outside the domain are moved to the nearest place on its rim
  /// @throws IoError, FormatError  as CsvRows
  explicit SampleReader(const std::filesystem::path& path, bool clamp = false);

  /// @param faces  that the file is about
  /// @throws FormatError  rows that are no samples, with file:line: not three fields, a face that does not exist,
  ///                      parameters that are not finite or outside the domain
  void read(std::vector<Sample>& batch, size_t most, FaceCount faces);

  /// Samples that were moved.
  std::int64_t num_clamped() const { return num_clamped_; }

 private:
  CsvRows rows_;
  bool clamp_;
  std::int64_t num_clamped_ = 0;
};

/// The place of the domain nearest to finite (u, v): of the square, or of the triangle u, v >= 0, u + v <= 1.
Sample clamped(const Sample& sample, bool triangle);

/// Which columns a file of samples has.
struct SampleColumns {
  int derivatives = 0;  ///< 0, 1 or 2
  bool curvature = false;

  int num_numbers() const { return 6 + (derivatives >= 1 ? 6 : 0) + (derivatives >= 2 ? 9 : 0) + (curvature ? 4 : 0); }
  /// What has to be evaluated: normals take first derivatives.
  int order() const { return curvature ? 2 : std::max(derivatives, 1); }
};

/// The first line of a file of samples.
/// @param places  names of the columns that say where
std::string sample_header(SampleColumns columns, const std::string& places = "face,u,v");
/// What was found at a place, as it stands behind that place: with the comma before and the end of the line.
/// @param found  of order `columns.order()`, with normals
void append_found(std::string& out, const LimitSamples& found, std::int64_t row, SampleColumns columns);

/// Samples and what was found there, into a file that appears whole or not at all.
class SampleWriter {
 public:
  /// @param own  places as own parameters, if that is how they were asked for
  SampleWriter(const std::filesystem::path& path, SampleColumns columns, const OwnPlaces* own = nullptr);
  /// @param found  of order `columns.order()`, with normals
  void write(std::span<const Sample> samples, const LimitSamples& found);
  void commit() { file_.commit(); }

 private:
  AtomicFile file_;
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
/// @param own       of each batch, filled by `source`: places as own parameters
/// @note  Memory does not grow with the number of samples. The same bytes for any number of threads.
SampleSummary write_samples(const std::filesystem::path& path, const LinearSource& surface, const Points& points,
                            const SampleSource& source, SampleColumns columns,
                            const std::function<void(std::int64_t)>& progress = {}, const OwnPlaces* own = nullptr);

/// The same of a source that has its points already, which may be one that is not linear.
SampleSummary write_samples(const std::filesystem::path& path, const BoundSource& surface, const SampleSource& source,
                            SampleColumns columns, const std::function<void(std::int64_t)>& progress = {});

/// Bytes that a file of so many samples has at least, about.
double predicted_bytes(double num_samples, SampleColumns columns);

}  // namespace sublimit
