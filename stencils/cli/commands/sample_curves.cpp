// SPDX-License-Identifier: Apache-2.0
// Limits of curves anywhere, in a CSV:
//
//   in    segment,t
//   out   segment,t,status,x,y[,z],[xt,yt,zt,[xtt,ytt,ztt,]]nx,ny[,nz]
//
// or, of free-form files and recipes, curve,t[,side] in both: see patch_places.h.
#include <fmt/core.h>

#include <functional>
#include <memory>
#include <random>

#include "commands/sample.h"
#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/error.h"
#include "sublimit/curves/limit_curve.h"
#include "sublimit/curves/schemes/curve_schemes.h"
#include "sublimit/geometric/geometric_schemes.h"
#include "sublimit/stencils/files/patch_places.h"
#include "sublimit/stencils/formats/csv_rows.h"
#include "sublimit/stencils/formats/formats.h"
#include "sublimit/stencils/files/sample_files.h"
#include "support/curves.h"
#include "support/free_form.h"
#include "support/facts.h"

namespace sublimit::cli {
namespace {

constexpr size_t samples_per_batch = 65536;

/// The next places: at most so many, fewer only at the end.
using NextPlaces = std::function<std::vector<CurvePlace>(size_t most)>;
using Evaluation = std::function<CurveSamples(std::span<const CurvePlace>)>;

NextPlaces source_of(const SampleJob& job, Index segments, std::shared_ptr<CsvRows> rows) {
  if (rows)
    return [=, clamp = job.clamp](size_t most) {
      const std::string valid = fmt::format("segments are 0 to {}", segments - 1);
      std::vector<CurvePlace> batch;
      while (batch.size() < most && rows->next()) {
        const std::int64_t segment = rows->integer(0, valid);
        if (segment < 0 || segment >= segments)
          throw FormatError(rows->place() + fmt::format("segment {} does not exist; {}", segment, valid));
        double t = rows->finite(1);
        if (!(t >= 0 && t <= 1)) {
          if (!clamp)
            throw FormatError(rows->place() + "t = " + format_number(t) +
                              " is outside 0 <= t <= 1; --clamp moves such places to the ends");
          t = t < 0 ? 0 : 1;
        }
        batch.push_back({static_cast<Index>(segment), t});
      }
      return batch;
    };
  if (job.grid)
    return [N = *job.grid, count = *job.grid * segments, next = std::int64_t{0}](size_t most) mutable {
      std::vector<CurvePlace> batch;
      for (; batch.size() < most && next < count; ++next)
        batch.push_back({static_cast<Index>(next / N), double(next % N) / double(N - 1)});
      return batch;
    };
  // As random_samples.h has it: the standard's distributions differ between platforms.
  return [numbers = std::mt19937_64(job.seed), left = segments > 0 ? *job.random_count : 0,
          segments](size_t most) mutable {
    std::vector<CurvePlace> batch;
    for (; batch.size() < most && left > 0; --left) {
      const auto segment = static_cast<Index>(numbers() % std::uint64_t(segments));
      batch.push_back({segment, double(numbers() >> 11) * 0x1p-53});
    }
    return batch;
  };
}

std::string coordinate(Index i, Index dimension) {
  return dimension <= 3 ? std::string(1, "xyz"[i]) : fmt::format("x{}", i);
}

/// @param own  of each batch, filled by `source`: places as own parameters; its sides are known before
std::int64_t write(const SampleJob& job, Index dimension, const NextPlaces& source, const Evaluation& evaluate,
                   Progress& progress, const OwnCurvePlaces* own = nullptr) {
  std::string text = (own ? own->header() : "segment,t") + ",status";
  const auto names = [&](const char* before, const char* behind) {
    for (Index i = 0; i < dimension; ++i) text += fmt::format(",{}{}{}", before, coordinate(i, dimension), behind);
  };
  names("", "");
  if (job.derivatives >= 1) names("", "t");
  if (job.derivatives >= 2) names("", "tt");
  if (dimension <= 3) names("n", "");
  RowFile file(job.output, text + "\n");
  std::int64_t written = 0;
  for (;;) {
    const std::vector<CurvePlace> batch = source(samples_per_batch);
    CurveSamples found = evaluate(batch);
    if (own) own->scale(found);
    text.clear();
    for (size_t i = 0; i < batch.size(); ++i) {
      const auto row = static_cast<Eigen::Index>(i);
      if (own) {
        own->append(text, i);
      } else {
        append_number(text, batch[i].segment);
        text += ',';
        append_number(text, batch[i].t);
      }
      text += ',';
      text += name(found.status[i]);
      const auto append = [&](const Points& m, bool exists) {
        if (exists && !m.row(row).allFinite())
          throw InvalidMesh(fmt::format(
              "segment {}, t = {}: its position, a derivative or the normal there is larger than numbers are "
              "(1.8e308); give points in another unit of length",
              batch[i].segment, batch[i].t));
        for (Index k = 0; k < dimension; ++k) {
          text += ',';
          if (exists) append_number(text, m(row, k));
        }
      };
      append(found.position, found.status[i] != LimitStatus::pole);
      if (job.derivatives >= 1) append(found.first, found.order[i] >= 1);
      if (job.derivatives >= 2) append(found.second, found.order[i] >= 2);
      if (dimension <= 3) append(found.normal, !found.normal.row(row).isZero(0));
      text += '\n';
    }
    file.write(text);
    written += static_cast<std::int64_t>(batch.size());
    if (batch.size() < samples_per_batch || file.is_dropped()) break;
    progress.note(fmt::format("sampling: {} done", written));
  }
  file.commit();
  return written;
}

void check_curve_samples(const SampleJob& job) {
  if (job.curvature)
    throw InvalidOption("--curvature is for surfaces; --derivatives 2 has what the curvature of a curve is made of");
  check_output_path(job.output, all_formats().writers({contents::rows, contents::arrays}));
}

/// Places of --at, if it is given.
/// @param right  headers that would be right
std::shared_ptr<CsvRows> open_places(const SampleJob& job, const std::string& right) {
  if (job.at.empty()) return nullptr;
  return std::make_shared<CsvRows>(job.at, std::vector<std::vector<std::string>>{{"segment", "t"}}, right);
}

/// Normals in the plane take one derivative, in space two.
int order_for(const SampleJob& job, Index dimension) { return std::max(job.derivatives, dimension == 2 ? 1 : 2); }

}  // namespace

int sample_patch_curves(const SampleJob& job, const Source& source) {
  limit_threads(job.common);
  check_curve_samples(job);
  std::shared_ptr<CsvRows> rows;
  std::unique_ptr<OwnCurvePlaceReader> own_reader;
  OwnCurvePlaces own;
  if (!job.at.empty() && has_own_places(job.at, "curve")) {
    if (job.clamp) throw InvalidOption("--clamp is for places segment,t; " + job.at + " has curve,t");
    own_reader = std::make_unique<OwnCurvePlaceReader>(job.at);
    own.has_sides = own_reader->has_sides();
  } else {
    rows = open_places(job, "segment,t or curve,t or curve,t,side");
  }
  Progress progress(job.common.quiet);
  const LoadedCurves found = load_patch_curves(source);
  progress.step("sampling");
  const auto dimension =
      static_cast<Index>(found.columns.cols() - (found.coordinates == Coordinates::homogeneous ? 1 : 0));
  const int order = order_for(job, dimension);
  const auto own_source = [&](size_t most) {
    std::vector<CurvePlace> batch;
    own_reader->read(batch, own, most, found.curves);
    return batch;
  };
  const std::int64_t written = write(
      job, dimension, own_reader ? NextPlaces(own_source) : source_of(job, found.curves.num_segments(), rows),
      [&](std::span<const CurvePlace> batch) {
        return found.curves.evaluate(found.columns, batch, order, found.coordinates);
      },
      progress, own_reader ? &own : nullptr);
  progress.step("");
  Facts facts("sample");
  facts.say("{output}: {samples} samples of {segments} segments of {curves} curves\n",
            {{"output", job.output},
             {"samples", written},
             {"segments", found.curves.num_segments()},
             {"curves", found.curves.num_curves()}});
  facts.print(job.common);
  return 0;
}

int sample_curves(const SampleJob& job) {
  check_curve_samples(job);
  const std::shared_ptr<CsvRows> rows = open_places(job, "segment,t");
  Progress progress(job.common.quiet);
  const CurveJob curve_job{&job.common, 0, job.output, "", false};
  const SchemeOptions options = given_options(job.common);
  const auto geometric = find_geometric_scheme(job.common.scheme, options);
  const auto linear = geometric ? std::nullopt : find_curve_scheme(job.common.scheme, options);
  const ControlPolygon polygon =
      load_polygon(curve_job, progress, geometric.has_value() || linear->masks.unknowns() > 1);
  std::int64_t written = 0;
  naming_mesh(job.common, [&] {
    progress.step("sampling");
    const int order = order_for(job, polygon.dimension());
    if (geometric) {
      Index segments = 0;
      for (const ControlPolygon::Curve& curve : polygon.curves)
        segments += static_cast<Index>(curve.points.size()) - (curve.closed ? 0 : 1);
      written = write(
          job, polygon.dimension(), source_of(job, segments, rows),
          [&](std::span<const CurvePlace> batch) { return evaluate(*geometric, polygon, batch, order); }, progress);
      return;
    }
    const LimitCurve curve(*linear, polygon);
    const Points x = unknowns(*linear, polygon);
    written = write(
        job, polygon.dimension(), source_of(job, curve.num_segments(), rows),
        [&](std::span<const CurvePlace> batch) { return curve.evaluate(x, batch, order); }, progress);
  });
  progress.step("");
  Facts facts("sample");
  facts.say("{output}: {samples} samples\n", {{"output", job.output}, {"samples", written}});
  facts.print(job.common);
  return 0;
}

}  // namespace sublimit::cli
