// SPDX-License-Identifier: Apache-2.0
#include "sublimit/distributed/jobs/sample_job.h"

#include <fmt/core.h>

#include <algorithm>
#include <limits>
#include <string_view>

#include "sublimit/base/detail/memory.h"
#include "sublimit/base/error.h"
#include "sublimit/distributed/jobs/place_routes.h"
#include "sublimit/distributed/mesh/shared_file.h"
#include "sublimit/stencils/files/random_samples.h"
#include "sublimit/stencils/formats/csv_fields.h"

namespace sublimit {
namespace {

/// As in `write_samples` of one process, which evaluates fewer than these in another way, with other rounding.
constexpr std::int64_t samples_per_batch = 65536;

/// Places of a request, in their order.
/// @param reader  of the first rank, the only one that reads
SampleSource places_of(const SampleRequest& request, FaceCount faces, SampleReader* reader) {
  const auto check_size = [&](double count) {  // before any is made
    std::error_code failed;
    const std::filesystem::path directory = request.output.parent_path();
    const auto room = double(std::filesystem::space(directory.empty() ? "." : directory, failed).available);
    const double bytes = predicted_bytes(count, request.columns);
    if (!failed && bytes > room)
      throw ResourceError(fmt::format("{} samples take about {} of disk; {} has room for {}; use fewer", count,
                                      bytes_in_words(bytes), request.output.string(), bytes_in_words(room)));
  };
  if (request.num_random) {
    check_size(double(*request.num_random));
    return [samples = RandomSamples(faces, *request.num_random, request.seed)](
               std::vector<Place>& batch, size_t most) mutable { samples.read(batch, most); };
  }
  if (!request.grid) return [=](std::vector<Place>& batch, size_t most) { reader->read(batch, most, faces); };
  std::vector<Place> one = grid_places({1, faces.triangles}, *request.grid);
  const std::int64_t count = std::ssize(one) * faces.size;
  check_size(double(count));
  return [one = std::move(one), count, next = std::int64_t{0}](std::vector<Place>& batch, size_t most) mutable {
    batch.clear();
    for (; batch.size() < most && next < count; ++next) {
      batch.push_back(one[size_t(next % std::ssize(one))]);
      batch.back().face = static_cast<Index>(next / std::ssize(one));
    }
  };
}

/// Pieces that the limit of the whole has (`LimitMap::Parts::num_pieces`): a few samples a piece pay for its patch.
std::int64_t num_pieces(const Ranks& ranks, const SpreadJob& job, std::int64_t num_addresses) {
  return job.scheme.is_dual() ? ranks.sum(std::ssize(job.mesh.face_vertices)) : num_addresses;
}

/// The limit of a part, at places on its own faces.
class OwnSurface {
 public:
  /// @param by_patches  whether one process would make patches for so many samples
  OwnSurface(const SpreadJob& job, const MeshPart& part, SampleColumns columns, bool by_patches)
      : points_(part.mesh.positions), columns_(columns) {
    if (part.mesh.num_faces() == 0) return;
    surface_.emplace(job.scheme, part.mesh, job.rules);
    if (by_patches) bound_ = surface_->bound(points_);
  }

  /// @param each  called with what was found, row by row: (text, status)
  template <class Each>
  void evaluate(std::span<const Place> samples, const Each& each) {
    // So few that the surface does not make patches for them by itself.
    const size_t most = bound_ || !surface_ ? samples.size() : size_t(surface_->faces().size);
    std::string text;
    for (; !samples.empty(); samples = samples.subspan(std::min(most, samples.size()))) {
      const std::span<const Place> some = samples.first(std::min(most, samples.size()));
      if (bound_)
        bound_->evaluate(some, columns_.order(), true, found_);
      else
        found_ = surface_->evaluate(points_, some, columns_.order());
      for (std::int64_t i = 0; i < std::ssize(some); ++i) {
        text.clear();
        append_found(text, found_, i, columns_);
        each(text, found_.status[size_t(i)]);
      }
    }
  }

 private:
  const Points& points_;
  SampleColumns columns_;
  std::optional<LimitMap> surface_;
  std::unique_ptr<BoundSource> bound_;
  LimitSamples found_;
};

/// The first rank deals out what it has, in order.
std::vector<PlaceRoutes::WidePlace> dealt(const Ranks& ranks, std::span<const Place> batch) {
  std::vector<std::vector<PlaceRoutes::WidePlace>> to(size_t(ranks.size()));
  const Runs runs = Runs::equal(std::ssize(batch), ranks.size());
  for (int r = 0; r < ranks.size(); ++r)
    for (std::int64_t i = runs.begin(r); i < runs.begin(r) + runs.size(r); ++i)
      to[size_t(r)].push_back({batch[size_t(i)].face, batch[size_t(i)].u, batch[size_t(i)].v});
  return exchange(ranks, std::move(to))[0];
}

/// Rows of the places that this rank was dealt, in their order.
/// @param by_status  counts what this rank finds
std::string rows_of(const Ranks& ranks, const PlaceRoutes& routes, OwnSurface& surface,
                    std::span<const PlaceRoutes::WidePlace> places,
                    std::array<std::int64_t, num_limit_statuses>& by_status) {
  const PlaceRoutes::Routed routed = routes.route(places);
  struct Row {
    std::int64_t number = 0, size = 0;
  };
  std::vector<std::vector<Row>> rows(size_t(ranks.size()));
  std::vector<std::vector<char>> texts(size_t(ranks.size()));
  ranks.together([&] {
    size_t i = 0;
    surface.evaluate(routed.samples, [&](const std::string& text, LimitStatus status) {
      const auto [rank, number] = routed.asked_by[i++];
      rows[size_t(rank)].push_back({number, std::ssize(text)});
      texts[size_t(rank)].insert(texts[size_t(rank)].end(), text.begin(), text.end());
      ++by_status[size_t(status)];
    });
  });
  rows = exchange(ranks, std::move(rows));
  texts = exchange(ranks, std::move(texts));
  std::vector<std::string_view> found(places.size());
  size_t size = 0;
  for (size_t r = 0; r < rows.size(); ++r) {
    const char* at = texts[r].data();
    for (const Row& row : rows[r]) {
      found[size_t(row.number)] = {at, size_t(row.size)};
      at += row.size;
    }
    size += texts[r].size();
  }
  std::string text;
  text.reserve(size + 40 * places.size());
  for (size_t i = 0; i < places.size(); ++i) {
    append_place(text, {static_cast<Index>(places[i].address), places[i].u, places[i].v});
    text += found[i];
  }
  return text;
}

}  // namespace

SamplesMade write_samples(const Ranks& ranks, const SpreadJob& job, const SampleRequest& request, SampleReader* reader,
                          const Told& told) {
  told("dividing");
  int rings = 0;
  ranks.together([&] {
    if (!job.scheme.preparation.empty() && !job.all_whole)
      throw UnsupportedTopology(
          job.name + ": " + job.scheme.name +
          " cuts faces first where not all of the mesh have four corners; `sublimit sample` does");
    rings = shard_rings(*std::make_unique<Patterns>(job.scheme), job.creasing);
  });
  const std::vector<int> part_of = divided(ranks, job, {});
  const MeshPart part =
      gather_part(ranks, job.mesh, job.incidence, owned_faces(ranks, job.mesh, part_of, ranks.size())[0], rings, false);
  const PlaceRoutes routes(ranks, job, part_of, part);
  FaceCount faces{0, routes.triangles()};
  SampleSource source;
  SharedFile file(ranks, request.output, 0);
  std::string header;
  ranks.together([&] {
    if (routes.num_addresses() > std::numeric_limits<Index>::max())
      throw ResourceError(
          fmt::format("{}: {} faces, and places number them by 32 bits", job.name, routes.num_addresses()));
    faces.size = static_cast<Index>(routes.num_addresses());
    header = sample_header(request.columns);
    if (!ranks.is_first()) return;
    source = places_of(request, faces, reader);
    file.write(0, header);
  });
  SamplesMade made;
  std::int64_t offset = std::ssize(header);
  std::optional<OwnSurface> surface;
  std::vector<Place> batch;
  const std::int64_t most = samples_per_batch * ranks.size();
  for (std::int64_t count = most; count == most;) {
    ranks.together([&] {
      if (ranks.is_first()) source(batch, size_t(most));
    });
    count = ranks.sum(std::ssize(batch));
    if (!surface) {
      const bool by_patches = count >= samples_per_batch || count >= 4 * num_pieces(ranks, job, routes.num_addresses());
      told("preparing");
      ranks.together([&] { surface.emplace(job, part, request.columns, by_patches); });
    }
    const std::vector<PlaceRoutes::WidePlace> places = dealt(ranks, batch);
    const std::string text = rows_of(ranks, routes, *surface, places, made.summary.by_status);
    const std::int64_t before = ranks.sum_before(std::ssize(text));
    ranks.together([&] { file.write(offset + before, text); });
    offset += ranks.sum(std::ssize(text));
    made.summary.num_samples += count;
    told(fmt::format("sampling: {} done", made.summary.num_samples));
  }
  file.commit();
  for (std::int64_t& status : made.summary.by_status) status = ranks.sum(status);
  if (reader) made.num_clamped = reader->num_clamped();
  return made;
}

}  // namespace sublimit
