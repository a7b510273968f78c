// SPDX-License-Identifier: Apache-2.0
#include "sublimit/distributed/jobs/place_routes.h"

#include <algorithm>
#include <tuple>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/error.h"
#include "sublimit/stencils/files/sample_files.h"

namespace sublimit {
namespace {

/// First address of each face, as `Addresses` has them, and the end.
template <class Sizes>
std::vector<std::int64_t> first_addresses(const Sizes& face_sizes, std::int32_t whole, std::int64_t begin = 0) {
  std::vector<std::int64_t> first{begin};
  first.reserve(face_sizes.size() + 1);
  for (const std::int32_t size : face_sizes) first.push_back(first.back() + (size == whole ? 1 : size));
  return first;
}

}  // namespace

PlaceRoutes::PlaceRoutes(const Ranks& ranks, const SpreadJob& job, const std::vector<int>& part, const MeshPart& own)
    : ranks_(ranks), job_(job), part_(part), own_(own), whole_(job.scheme.face_size() == 3 ? 3 : 4) {
  run_ = first_addresses(job.mesh.face_sizes, whole_);
  addresses_ = Runs(ranks, run_.back());
  for (std::int64_t& first : run_) first += addresses_.begin(ranks.rank());
  local_ = first_addresses(own.mesh.face_sizes, whole_);
}

void PlaceRoutes::check(const WidePlace& place, const std::string& where, const std::string& hint) const {
  if (place.address < 0 || place.address >= num_addresses())
    throw FormatError(where + "face " + format_number(place.address) + " does not exist; faces are 0 to " +
                      format_number(num_addresses() - 1) +
                      (triangles() ? ", the triangles of the mesh" : ", a quad each or a corner of another polygon"));
  check_place({1, triangles()}, 0, place.u, place.v, where, hint);
}

PlaceRoutes::Routed PlaceRoutes::route(std::span<const WidePlace> places) const {
  struct Asked {
    std::int64_t rank = 0, number = 0, face = 0, corner = 0;  // face: at first the address
    double u = 0, v = 0;
  };
  std::vector<std::vector<Asked>> to(size_t(ranks_.size()));
  for (size_t i = 0; i < places.size(); ++i) {
    const WidePlace& p = places[i];
    to[size_t(addresses_.rank_of(p.address))].push_back({ranks_.rank(), std::int64_t(i), p.address, 0, p.u, p.v});
  }
  to = exchange(ranks_, std::move(to));
  std::vector<std::vector<Asked>> owners(to.size());
  for (std::vector<Asked>& from : to) {
    for (Asked asked : from) {
      const auto face = std::ranges::upper_bound(run_, asked.face) - run_.begin() - 1;
      asked.corner = asked.face - run_[size_t(face)];
      asked.face = first_face() + face;
      owners[size_t(part_[size_t(face)])].push_back(asked);
    }
    std::vector<Asked>().swap(from);
  }
  std::vector<Asked> all;
  for (std::vector<Asked>& from : exchange(ranks_, std::move(owners))) {
    all.insert(all.end(), from.begin(), from.end());
    std::vector<Asked>().swap(from);
  }
  std::ranges::sort(all, {}, [](const Asked& a) { return std::tuple(a.rank, a.number); });
  Routed routed;
  routed.samples.reserve(all.size());
  routed.asked_by.reserve(all.size());
  for (const Asked& asked : all) {
    const auto face = std::ranges::lower_bound(own_.faces, asked.face) - own_.faces.begin();
    routed.samples.push_back({static_cast<Index>(local_[size_t(face)] + asked.corner), asked.u, asked.v});
    routed.asked_by.push_back({asked.rank, asked.number});
  }
  return routed;
}

std::vector<std::optional<PlaceRoutes::WidePlace>> PlaceRoutes::at_vertices(
    std::span<const std::int64_t> vertices) const {
  const Lists faces = [&] {
    std::vector<std::int64_t> sorted(vertices.begin(), vertices.end());
    sort_unique(sorted);
    Lists at = fetch_lists(ranks_, job_.mesh.vertices, sorted, [&](std::int64_t v) {
      return job_.incidence.faces[v - job_.mesh.vertices.begin(ranks_.rank())];
    });
    // In the order asked.
    Lists lists;
    for (const std::int64_t v : vertices) {
      const auto list = at[std::ranges::lower_bound(sorted, v) - sorted.begin()];
      lists.items.insert(lists.items.end(), list.begin(), list.end());
      lists.begins.push_back(std::ssize(lists.items));
    }
    return lists;
  }();
  std::vector<char> holes;
  if (job_.incidence.has_holes)
    holes = fetch<char>(ranks_, job_.mesh.faces, faces.items,
                        [&](std::int64_t f) { return job_.incidence.is_hole[size_t(f - first_face())]; });
  struct Corner {
    std::int64_t face = 0, vertex = 0;
  };
  std::vector<std::vector<Corner>> asked(size_t(ranks_.size()));
  std::vector<int> rank_of(vertices.size(), -1);  // -1: no surface
  for (size_t i = 0; i < vertices.size(); ++i)
    for (std::int64_t k = faces.begins[i]; k < faces.begins[i + 1]; ++k) {
      if (!holes.empty() && holes[size_t(k)]) continue;
      const std::int64_t face = faces.items[size_t(k)];
      rank_of[i] = job_.mesh.faces.rank_of(face);
      asked[size_t(rank_of[i])].push_back({face, vertices[i]});
      break;
    }
  asked = exchange(ranks_, std::move(asked));
  std::vector<std::int64_t> corners{0};  // where those of each face of the own run begin
  for (const std::int32_t size : job_.mesh.face_sizes) corners.push_back(corners.back() + size);
  std::vector<std::vector<WidePlace>> answers(asked.size());
  for (size_t r = 0; r < asked.size(); ++r)
    for (const Corner& at : asked[r]) {
      const auto f = size_t(at.face - first_face());
      const auto begin = job_.mesh.face_vertices.begin() + corners[f], end = begin + job_.mesh.face_sizes[f];
      const std::int64_t corner = std::find(begin, end, at.vertex) - begin;
      if (job_.mesh.face_sizes[f] != whole_)
        answers[r].push_back({run_[f] + corner, 0, 0});
      else
        answers[r].push_back({run_[f], corner == 1 || (corner == 2 && whole_ == 4) ? 1. : 0., corner >= 2 ? 1. : 0.});
    }
  answers = exchange(ranks_, std::move(answers));
  std::vector<size_t> next(answers.size(), 0);
  std::vector<std::optional<WidePlace>> places(vertices.size());
  for (size_t i = 0; i < vertices.size(); ++i)
    if (rank_of[i] >= 0) places[i] = answers[size_t(rank_of[i])][next[size_t(rank_of[i])]++];
  return places;
}

}  // namespace sublimit
