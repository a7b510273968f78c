// SPDX-License-Identifier: Apache-2.0
#include "sublimit/distributed/jobs/spread_targets.h"

#include <fmt/core.h>

#include <algorithm>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/error.h"

namespace sublimit {
namespace {

constexpr size_t batch_rows = size_t{1} << 15;

}  // namespace

SpreadTargets::SpreadTargets(const Ranks& ranks, const std::filesystem::path& path)
    : ranks_(ranks), name_(path.string()) {
  std::int64_t columns = 0;
  ranks.together([&] {
    if (!ranks.is_first()) return;
    rows_ = std::make_unique<CsvRows>(
        path,
        std::vector<std::vector<std::string>>{
            {"vertex", "x", "y", "z"}, {"face", "u", "v", "x", "y", "z"}, {"face", "u", "v", "x", "y", "z", "weight"}},
        "vertex,x,y,z or face,u,v,x,y,z[,weight]; other targets are for `sublimit fit`");
    columns = std::ssize(rows_->columns());
  });
  columns = ranks.largest(columns);
  at_vertices_ = columns == 4, weighted_ = columns == 7;
}

std::string SpreadTargets::where(std::int64_t line) const { return fmt::format("{}:{}: ", name_, line); }

SpreadTarget SpreadTargets::next(const PlaceRoutes& routes, std::int64_t num_vertices) const {
  SpreadTarget target;
  target.line = rows_->line();
  std::int64_t& number = target.place.address;
  if (at_vertices_) {
    const std::string known = fmt::format("vertices are 0 to {}, counted from 0", num_vertices - 1);
    number = rows_->integer(0, known);
    if (number < 0 || number >= num_vertices)
      throw FormatError(fmt::format("{}vertex {} does not exist; {}", rows_->place(), number, known));
  } else {
    number = rows_->integer(0, "faces are counted from 0");
    target.place.u = rows_->finite(1), target.place.v = rows_->finite(2);
    routes.check(target.place, rows_->place());
  }
  for (size_t c = 0; c < 3; ++c) target.value[c] = rows_->finite(c + (at_vertices_ ? 1 : 3));
  if (weighted_) target.weight = rows_->finite(6);
  if (target.weight < 0)
    throw FormatError(rows_->place() + "weight " + format_number(target.weight) + "; it should be 0 or more");
  return target;
}

std::vector<SpreadTarget> SpreadTargets::deal(const PlaceRoutes& routes, std::int64_t num_vertices) {
  std::vector<SpreadTarget> own;
  for (bool more = true; more;) {
    std::vector<std::vector<SpreadTarget>> to(size_t(ranks_.size()));
    ranks_.together([&] {
      more = false;
      if (!ranks_.is_first()) return;
      for (std::vector<SpreadTarget>& batch : to)
        while (batch.size() < batch_rows && (more = rows_->next())) batch.push_back(next(routes, num_vertices));
    });
    more = !ranks_.all(!more);
    for (const std::vector<SpreadTarget>& batch : exchange(ranks_, std::move(to)))
      own.insert(own.end(), batch.begin(), batch.end());
  }
  rows_.reset();
  return own;
}

void SpreadTargets::place_vertices(const PlaceRoutes& routes, const Runs& vertices,
                                   std::vector<SpreadTarget>& targets) const {
  using Seen = std::array<std::int64_t, 2>;  // vertex, line
  std::vector<std::vector<Seen>> to(size_t(ranks_.size()));
  std::vector<std::int64_t> numbers;
  for (const SpreadTarget& target : targets) {
    numbers.push_back(target.place.address);
    to[size_t(vertices.rank_of(target.place.address))].push_back({target.place.address, target.line});
  }
  std::vector<Seen> seen;
  for (const std::vector<Seen>& from : exchange(ranks_, std::move(to)))
    seen.insert(seen.end(), from.begin(), from.end());
  std::ranges::sort(seen);
  const std::vector<std::optional<PlaceRoutes::WidePlace>> places = routes.at_vertices(numbers);
  ranks_.together([&] {
    for (size_t i = 1; i < seen.size(); ++i)
      if (seen[i][0] == seen[i - 1][0])
        throw FormatError(fmt::format("{}vertex {} has a target already, in line {}; leave one of them",
                                      where(seen[i][1]), seen[i][0], seen[i - 1][1]));
    for (size_t i = 0; i < targets.size(); ++i) {
      if (!places[i])
        throw FormatError(
            fmt::format("{}vertex {} is in no face, or in holes alone, so the limit does not pass there; "
                        "leave this row out",
                        where(targets[i].line), numbers[i]));
      targets[i].place = *places[i];
    }
  });
}

std::vector<SpreadTarget> SpreadTargets::read(const PlaceRoutes& routes, const Runs& vertices) {
  std::vector<SpreadTarget> targets = deal(routes, vertices.size());
  const bool none = ranks_.sum(std::ssize(targets)) == 0;
  const bool none_counts =
      ranks_.all(std::ranges::all_of(targets, [](const SpreadTarget& t) { return t.weight == 0; }));
  ranks_.together([&] {
    if (none) throw FormatError(name_ + ": no targets after the header; every other line should be one");
    if (none_counts) throw FormatError(name_ + ": all weights are 0; one at least should count");
  });
  if (at_vertices_) place_vertices(routes, vertices, targets);
  return targets;
}

}  // namespace sublimit
