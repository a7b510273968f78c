// SPDX-License-Identifier: Apache-2.0
#include "sublimit/eval/table/face_lattices.h"

#include <limits>
#include <string>
#include <utility>

#include "sublimit/base/detail/parallel_for.h"
#include "sublimit/base/error.h"

namespace sublimit {
namespace {

constexpr std::uint8_t reversed = 8;

/// A face has sixteen million points then.
constexpr std::int32_t last_n = 4096;

[[noreturn]] void refuse(const std::string& what) { throw InvalidParameter("lattices of faces: " + what); }

void check_size(const char* name, size_t size, size_t right) {
  if (size != right)
    refuse(std::string(name) + " has " + std::to_string(size) + " entries, not " + std::to_string(right));
}

}  // namespace

std::int32_t Lattice::on_side(int k, std::int32_t s) const {
  if (triangle) return k == 0 ? row(s, 0) : k == 1 ? row(n - s, s) : row(0, n - s);
  return k == 0 ? row(s, 0) : k == 1 ? row(n, s) : k == 2 ? row(n - s, n) : row(0, n - s);
}

AddressParameters address_parameters(const Lattice& lattice, const LatticePlace& place, std::int32_t i,
                                     std::int32_t j) {
  const std::int32_t n = lattice.n;
  // Turned lattices begin at another corner.
  if (lattice.triangle) {
    const std::int32_t by_corner[3] = {n - i - j, i, j};
    return {double(by_corner[(4 - place.turn) % 3]) / n, double(by_corner[(5 - place.turn) % 3]) / n};
  }
  for (int k = 0; k < place.turn; ++k) {
    std::swap(i, j);
    i = n - i;
  }
  const double u = double(i) / n, v = double(j) / n;
  if (place.quarter < 0) return {u, v};
  const bool right = place.quarter == 1 || place.quarter == 2, up = place.quarter >= 2;
  return {u / 2 + (right ? 0.5 : 0), v / 2 + (up ? 0.5 : 0)};
}

std::uint8_t FaceLattices::share(const Arrays& a, std::int32_t face) {
  const int sides = a.lattice.num_sides();
  int share = 0;
  for (int k = 0; k < sides; ++k) {
    const std::int64_t at = std::int64_t{face} * sides + k;
    if (a.side_faces[at] == face && a.side_places[at] == k) share |= 1 << k;
    if (a.corner_faces[at] == face && a.corner_places[at] == k) share |= 16 << k;
  }
  return static_cast<std::uint8_t>(share);
}

LatticeRanks::LatticeRanks(const Lattice& lattice)
    : lattice_(lattice), places_(size_t(lattice.size())), rank_(256), count_(256, -1) {
  for (int k = 0; k < lattice.num_sides(); ++k)
    for (std::int32_t s = 0; s < lattice.n; ++s)
      places_[size_t(lattice.on_side(k, s))] = {static_cast<std::int8_t>(k), s};
}

std::vector<std::int32_t> LatticeRanks::rows(const Lattice& lattice, Share share) {
  std::vector<std::int32_t> rows;
  lattice.for_each_inner([&](std::int32_t row) { rows.push_back(row); });
  for (int k = 0; k < lattice.num_sides(); ++k)
    for (std::int32_t s = 1; s < lattice.n && (share >> k & 1); ++s) rows.push_back(lattice.on_side(k, s));
  for (int k = 0; k < lattice.num_sides(); ++k)
    if (share >> (4 + k) & 1) rows.push_back(lattice.on_side(k, 0));
  return rows;
}

void LatticeRanks::add(Share share) {
  if (count_[share] >= 0) return;
  rank_[share].assign(size_t(lattice_.size()), -1);
  std::int32_t next = 0;
  for (const std::int32_t row : rows(lattice_, share)) rank_[share][size_t(row)] = next++;
  count_[share] = next;
}

FaceLattices::FaceLattices(std::int64_t num_points, Arrays arrays) : arrays_(std::move(arrays)) {
  const Arrays& a = arrays_;
  if (a.lattice.n < 1 || a.lattice.n > last_n)
    refuse(std::to_string(a.lattice.n) + " cells a side; 1 to " + std::to_string(last_n) + " are right");
  const int sides = a.lattice.num_sides();
  const size_t faces = a.first_points.size(), all = faces * size_t(sides);
  if (faces > size_t(std::numeric_limits<std::int32_t>::max())) refuse("too many faces");
  check_size("side_faces", a.side_faces.size(), all);
  check_size("side_places", a.side_places.size(), all);
  check_size("corner_faces", a.corner_faces.size(), all);
  check_size("corner_places", a.corner_places.size(), all);
  if (!a.addresses.empty()) check_size("addresses", a.addresses.size(), faces);
  check_size("places", a.places.size(), a.addresses.size());
  if (!a.holes.empty()) check_size("holes", a.holes.size(), faces);

  share_.resize(faces);
  ranks_ = LatticeRanks(a.lattice);
  const auto check_owner = [&](const char* what, size_t i, std::int32_t owner, int place, int most) {
    if (owner < 0 || size_t(owner) >= faces || (place & 7) >= sides || place > most)
      refuse("the owner of " + std::string(what) + " " + std::to_string(i) + " does not exist");
  };
  parallel_for(std::int64_t(faces), [&](std::int64_t f) {
    for (size_t at = size_t(f) * size_t(sides); at < size_t(f + 1) * size_t(sides); ++at) {
      check_owner("side", at, a.side_faces[at], a.side_places[at], reversed + 7);
      check_owner("corner", at, a.corner_faces[at], a.corner_places[at], 7);
    }
    share_[f] = share(a, static_cast<std::int32_t>(f));
    if (!a.places.empty()) {
      const int turn = a.places[f] & 7, quarter = (a.places[f] >> 3) - 1;
      if (turn >= sides || quarter >= sides || a.addresses[f] < 0)
        refuse("face " + std::to_string(f) + " has no place in an address");
    }
  });
  for (const std::uint8_t share : share_) ranks_.add(share);
  parallel_for(std::int64_t(faces), [&](std::int64_t f) {
    if (a.first_points[f] < 0 || a.first_points[f] > num_points - ranks_.num_rows(share_[f]))
      refuse("points of face " + std::to_string(f) + " from " + std::to_string(a.first_points[f]) + " on, of " +
             std::to_string(num_points));
    for (int k = 0; k < sides; ++k) {
      const std::int64_t at = f * sides + k;
      if (!(share_[a.side_faces[at]] >> (a.side_places[at] & 7) & 1) ||
          !(share_[a.corner_faces[at]] >> (4 + a.corner_places[at]) & 1))
        refuse("face " + std::to_string(f) + " takes points from a face that does not have them");
    }
  });
}

std::int64_t FaceLattices::point(std::int32_t face, std::int32_t row) const {
  const Arrays& a = arrays_;
  if (const std::int32_t rank = ranks_.rank(share_[face], row); rank >= 0) return a.first_points[face] + rank;
  const auto [side, step] = ranks_.on_side(row);
  const std::int64_t at = std::int64_t{face} * a.lattice.num_sides() + side;
  const bool corner = step == 0;
  const std::int32_t owner = corner ? a.corner_faces[at] : a.side_faces[at];
  const int place = corner ? a.corner_places[at] : a.side_places[at];
  const std::int32_t along = place & reversed ? a.lattice.n - step : step;
  return a.first_points[owner] + ranks_.rank(share_[owner], a.lattice.on_side(place & 7, along));
}

LatticePlace FaceLattices::place(std::int32_t face) const {
  const std::uint8_t place = arrays_.places[face];
  return {arrays_.addresses[face], static_cast<std::int8_t>(place & 7), static_cast<std::int8_t>((place >> 3) - 1)};
}

}  // namespace sublimit
