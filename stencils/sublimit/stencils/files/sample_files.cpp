// SPDX-License-Identifier: Apache-2.0
#include "sublimit/stencils/files/sample_files.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/error.h"
#include "sublimit/source/curvature.h"
#include "sublimit/source/detail/why_outside.h"
#include "sublimit/stencils/formats/csv_fields.h"

namespace sublimit {
namespace {

constexpr size_t samples_per_batch = 65536;
constexpr std::int64_t rows_per_text = 512;

/// Evaluates a batch; `all` if there is no other.
using Evaluation = std::function<void(std::span<const Place> batch, bool all, LimitSamples& found)>;

SampleSummary write_batches(const std::filesystem::path& path, const Evaluation& evaluate, const SampleSource& source,
                            SampleColumns columns, const std::function<void(std::int64_t)>& progress,
                            const OwnPlaces* own) {
  std::unique_ptr<SampleWriter> writer;  // once the header of own places is known
  SampleSummary summary;
  std::vector<Place> batch;
  LimitSamples found;
  do {
    source(batch, samples_per_batch);
    evaluate(batch, summary.num_samples == 0 && batch.size() < samples_per_batch, found);
    if (!writer) writer = std::make_unique<SampleWriter>(path, columns, own);
    writer->write(batch, found);
    summary.num_samples += static_cast<std::int64_t>(batch.size());
    for (const LimitStatus status : found.status) ++summary.by_status[size_t(status)];
    if (progress) progress(summary.num_samples);
  } while (batch.size() == samples_per_batch && !writer->is_dropped());
  writer->commit();
  return summary;
}

}  // namespace

Place clamped(const Place& s, bool triangle) {
  if (triangle && s.u + s.v > 1) {
    const double u = std::clamp((s.u - s.v + 1) / 2, 0.0, 1.0);
    return {s.face, u, 1 - u};
  }
  return {s.face, std::clamp(s.u, 0.0, 1.0), std::clamp(s.v, 0.0, 1.0)};
}

void check_place(FaceCount faces, std::int64_t face, double u, double v, const std::string& where,
                 const std::string& hint) {
  const std::string why = why_outside(faces, face, u, v);
  if (why.empty()) return;
  const bool on_a_face = face >= 0 && face < faces.size;
  throw FormatError(where + why + (on_a_face ? hint : ""));
}

SampleReader::SampleReader(const std::filesystem::path& path, bool clamp)
    : rows_(path, {"face", "u", "v"}), clamp_(clamp) {}

void SampleReader::read(std::vector<Place>& batch, size_t most, FaceCount faces) {
  const std::string known = faces_in_words(faces);
  batch.clear();
  while (batch.size() < most && rows_.next()) {
    const std::int64_t face = rows_.integer(0, known);
    Place sample{static_cast<Index>(face), rows_.finite(1), rows_.finite(2)};
    const bool exists = face >= 0 && face < faces.size, inside = exists && is_inside(faces, sample);
    if (!exists || (!inside && !clamp_))
      check_place(faces, face, sample.u, sample.v, rows_.place(), "; --clamp moves such places to its rim");
    if (!inside) {
      sample = clamped(sample, faces.triangles);
      ++num_clamped_;
    }
    batch.push_back(sample);
  }
}

std::string sample_header(SampleColumns columns, const std::string& places) {
  std::string header = places + ",status,x,y,z";
  if (columns.derivatives >= 1) header += ",xu,yu,zu,xv,yv,zv";
  if (columns.derivatives >= 2) header += ",xuu,yuu,zuu,xuv,yuv,zuv,xvv,yvv,zvv";
  header += ",nx,ny,nz";
  if (columns.curvature) header += ",k1,k2,gauss,mean";
  return header + "\n";
}

void append_found(std::string& out, const LimitSamples& found, std::int64_t i, SampleColumns columns) {
  const size_t place_end = out.size();
  out += ',';
  out += name(found.status[i]);
  const auto row = [&](const Points& m, bool exists) {
    if (exists && !m.row(i).allFinite()) {
      const size_t line = out.rfind('\n', place_end) + 1;  // npos + 1 is 0
      throw InvalidMesh("place " + out.substr(line, place_end - line) +
                        ": its position or a derivative there is larger than numbers are (1.8e308); give control "
                        "points in another unit of length");
    }
    append_fields(out, m.data() + 3 * i, 3, exists);
  };
  const int order = found.order[i];
  row(found.position, has_position(found.status[i]));
  if (columns.derivatives >= 1)
    for (const Points* m : {&found.du, &found.dv}) row(*m, order >= 1);
  if (columns.derivatives >= 2)
    for (const Points* m : {&found.duu, &found.duv, &found.dvv}) row(*m, order >= 2);
  append_normal(out, found.normal, i);
  if (columns.curvature) {
    const std::optional<Curvature> c = curvature(found, static_cast<Index>(i));
    const double numbers[] = {c ? c->k1 : 0, c ? c->k2 : 0, c ? c->gauss : 0, c ? c->mean : 0};
    append_fields(out, numbers, 4, c.has_value());
  }
  out += '\n';
}

SampleWriter::SampleWriter(const std::filesystem::path& path, SampleColumns columns, const OwnPlaces* own)
    : file_(path, own ? sample_header(columns, own->header()) : sample_header(columns)), columns_(columns), own_(own) {}

void SampleWriter::write(std::span<const Place> samples, const LimitSamples& found) {
  const auto append = [&](std::string& text, std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i < end; ++i) {
      if (own_)
        own_->append(text, static_cast<size_t>(i));
      else
        append_place(text, samples[i]);
      append_found(text, found, i, columns_);
    }
  };
  file_.rows(std::ssize(samples), rows_per_text, append);
}

std::string SampleSummary::text() const {
  std::string words;
  for (size_t i = 0; i < by_status.size(); ++i)
    if (by_status[i] > 0)
      words += (words.empty() ? "" : ", ") + format_number(by_status[i]) + " " + name(LimitStatus(i));
  return words;
}

SampleSummary write_samples(const std::filesystem::path& path, const LinearSource& surface, const Points& points,
                            const SampleSource& source, SampleColumns columns,
                            const std::function<void(std::int64_t)>& progress, const OwnPlaces* own) {
  std::unique_ptr<BoundSource> bound;
  const auto evaluate = [&](std::span<const Place> batch, bool all, LimitSamples& found) {
    if (all) {  // `evaluate` knows whether so few are worth a preparation of every piece
      found = surface.evaluate(points, batch, columns.order());
    } else {
      if (!bound) bound = surface.bound(points);
      bound->evaluate(batch, columns.order(), true, found);
    }
    if (own) own->scale(found);
  };
  return write_batches(path, evaluate, source, columns, progress, own);
}

SampleSummary write_samples(const std::filesystem::path& path, const BoundSource& surface, const SampleSource& source,
                            SampleColumns columns, const std::function<void(std::int64_t)>& progress) {
  const auto evaluate = [&](std::span<const Place> batch, bool, LimitSamples& found) {
    surface.evaluate(batch, columns.order(), true, found);
  };
  return write_batches(path, evaluate, source, columns, progress, nullptr);
}

double predicted_bytes(double num_samples, SampleColumns columns) {
  return num_samples * (20 + 8 * columns.num_numbers());
}

}  // namespace sublimit
