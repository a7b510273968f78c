// SPDX-License-Identifier: Apache-2.0
#include "sublimit/distributed/mesh/incidence.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <bit>
#include <tuple>

#include "sublimit/base/error.h"

namespace sublimit {
namespace {

using Int = std::int64_t;
using Pair = std::array<Int, 2>;

template <class T>
std::vector<std::vector<T>> batches(const Ranks& ranks) {
  return std::vector<std::vector<T>>(size_t(ranks.size()));
}

/// Calls body(face, its corners) for the faces of the own run.
template <class Body>
void for_each_face(const Ranks& ranks, const SpreadMesh& mesh, const Body& body) {
  const Int first = mesh.faces.begin(ranks.rank());
  const Int* corners = mesh.face_vertices.data();
  for (size_t f = 0; f < mesh.face_sizes.size(); ++f) {
    const auto size = size_t(mesh.face_sizes[f]);
    body(first + Int(f), std::span(corners, size));
    corners += size;
  }
}

/// All that came, sorted, by a number that is of the own run first: dealt out by it in linear time, then sorted few by
/// few.
/// @param number  of an item
template <class Item, class Number>
std::vector<Item> sorted(std::vector<std::vector<Item>> from, Int first, Int count, const Number& number) {
  std::vector<size_t> next(static_cast<size_t>(count) + 1, 0);
  for (const auto& items : from)
    for (const Item& item : items) ++next[size_t(number(item) - first) + 1];
  for (size_t i = 1; i < next.size(); ++i) next[i] += next[i - 1];
  std::vector<Item> all(next.back());
  for (auto& items : from) {
    for (const Item& item : items) all[next[size_t(number(item) - first)]++] = item;
    std::vector<Item>().swap(items);
  }
  for (size_t begin = 0, i = 0; i + 1 < next.size(); begin = next[i++])
    std::sort(all.begin() + std::ptrdiff_t(begin), all.begin() + std::ptrdiff_t(next[i]));
  return all;
}

/// Pairs (number of the own run, item) as lists, each pair once.
Lists lists_of(std::vector<std::vector<Pair>> from, Int first, Int count) {
  std::vector<Pair> pairs = sorted(std::move(from), first, count, [](const Pair& pair) { return pair[0]; });
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  Lists lists;
  lists.begins.assign(size_t(count) + 1, 0);
  lists.items.reserve(pairs.size());
  for (const auto& [number, item] : pairs) {
    ++lists.begins[size_t(number - first) + 1];
    lists.items.push_back(item);
  }
  for (size_t i = 1; i < lists.begins.size(); ++i) lists.begins[i] += lists.begins[i - 1];
  return lists;
}

void find_faces(const Ranks& ranks, const SpreadMesh& mesh, Incidence& result) {
  auto to = batches<Pair>(ranks);
  for_each_face(ranks, mesh, [&](Int face, std::span<const Int> corners) {
    for (const Int v : corners) to[size_t(mesh.vertices.rank_of(v))].push_back({v, face});
  });
  const Int first = mesh.vertices.begin(ranks.rank()), count = mesh.vertices.size(ranks.rank());
  result.faces = lists_of(exchange(ranks, std::move(to)), first, count);
  for (Int v = 0; v < count; ++v)
    if (result.faces[v].empty()) result.isolated.push_back(first + v);
}

/// An edge of a face, at its lower end.
struct Side {
  Int low = 0, high = 0, face = 0;
  auto operator<=>(const Side&) const = default;
};

/// All edges of the own vertices, sorted.
std::vector<Side> sides_at_low_ends(const Ranks& ranks, const SpreadMesh& mesh) {
  auto to = batches<Side>(ranks);
  for_each_face(ranks, mesh, [&](Int face, std::span<const Int> corners) {
    for (size_t k = 0; k < corners.size(); ++k) {
      const auto [low, high] = std::minmax(corners[k], corners[(k + 1) % corners.size()]);
      to[size_t(mesh.vertices.rank_of(low))].push_back({low, high, face});
    }
  });
  return sorted(exchange(ranks, std::move(to)), mesh.vertices.begin(ranks.rank()), mesh.vertices.size(ranks.rank()),
                [](const Side& side) { return side.low; });
}

/// Faces get to know what they have first, and their neighbours.
void tell_faces(const Ranks& ranks, const SpreadMesh& mesh, const std::vector<Side>& sides, Incidence& result) {
  const Int first = mesh.faces.begin(ranks.rank()), count = mesh.faces.size(ranks.rank());
  auto firsts = batches<Int>(ranks);
  auto pairs = batches<Pair>(ranks);
  for (size_t i = 0; i < sides.size(); ++i) {
    const Side& side = sides[i];
    const bool again = i > 0 && sides[i - 1].low == side.low && sides[i - 1].high == side.high;
    // A loop, and an edge that a face has a second time, are edges by themselves (`Topology`).
    const bool alone = !again || side.low == side.high || sides[i - 1].face == side.face;
    if (alone) firsts[size_t(mesh.faces.rank_of(side.face))].push_back(side.face);
    if (!again || sides[i - 1].face == side.face) continue;
    // Of three and more faces each knows the one before: enough to be kept together.
    pairs[size_t(mesh.faces.rank_of(side.face))].push_back({side.face, sides[i - 1].face});
    pairs[size_t(mesh.faces.rank_of(sides[i - 1].face))].push_back({sides[i - 1].face, side.face});
  }
  result.own_sides.assign(size_t(count), 0);
  for (const auto& from : exchange(ranks, std::move(firsts)))
    for (const Int f : from) ++result.own_sides[size_t(f - first)];
  result.neighbours = lists_of(exchange(ranks, std::move(pairs)), first, count);
  firsts = batches<Int>(ranks);
  for (Int v = 0; v < result.faces.size(); ++v)
    if (!result.faces[v].empty())
      firsts[size_t(mesh.faces.rank_of(result.faces[v].front()))].push_back(result.faces[v].front());
  result.own_corners.assign(size_t(count), 0);
  for (const auto& from : exchange(ranks, std::move(firsts)))
    for (const Int f : from) ++result.own_corners[size_t(f - first)];
}

Int bits(float sharpness) { return std::bit_cast<std::int32_t>(sharpness); }

void take_tags(const Ranks& ranks, const SpreadMesh& mesh, const std::vector<Side>& sides, const std::string& name,
               Incidence& result) {
  const Int first = mesh.vertices.begin(ranks.rank()), count = mesh.vertices.size(ranks.rank());
  using Tag = std::array<Int, 4>;  // lower vertex, number in the file, other vertex, sharpness
  const auto at_home = [&](std::vector<std::vector<Tag>> to) {
    std::vector<Tag> all;
    for (const auto& from : exchange(ranks, std::move(to))) all.insert(all.end(), from.begin(), from.end());
    std::ranges::sort(all);
    return all;
  };
  auto to = batches<Tag>(ranks);
  for (const SpreadMesh::Crease& crease : mesh.creases) {
    const auto [low, high] = std::minmax(crease.tail, crease.head);
    to[size_t(mesh.vertices.rank_of(low))].push_back({low, crease.number, high, bits(crease.sharpness)});
  }
  const std::vector<Tag> creases = at_home(std::move(to));
  ranks.together([&] {
    for (const Tag& tag : creases) {
      const auto side = std::ranges::lower_bound(sides, Side{tag[0], tag[2], 0});
      if (side == sides.end() || side->low != tag[0] || side->high != tag[2])
        throw InvalidMesh(
            fmt::format("{}: a crease from vertex {} to {}, and no face has such an edge", name, tag[0], tag[2]));
    }
  });
  to = batches<Tag>(ranks);
  for (const SpreadMesh::Corner& corner : mesh.corners)
    to[size_t(mesh.vertices.rank_of(corner.vertex))].push_back(
        {corner.vertex, corner.number, 0, bits(corner.sharpness)});
  const std::vector<Tag> corners = at_home(std::move(to));
  const auto lists = [&](const std::vector<Tag>& tags, size_t numbers) {
    Lists result;
    result.begins.assign(size_t(count) + 1, 0);
    for (const Tag& tag : tags) {
      result.begins[size_t(tag[0] - first) + 1] += Int(numbers);
      result.items.insert(result.items.end(), tag.end() - std::ptrdiff_t(numbers), tag.end());
    }
    for (size_t i = 1; i < result.begins.size(); ++i) result.begins[i] += result.begins[i - 1];
    return result;
  };
  result.creases = lists(creases, 2), result.corners = lists(corners, 1);
  auto holes = batches<Int>(ranks);
  for (const Int f : mesh.holes) holes[size_t(mesh.faces.rank_of(f))].push_back(f);
  result.is_hole.assign(mesh.face_sizes.size(), false);
  for (const auto& from : exchange(ranks, std::move(holes)))
    for (const Int f : from) result.is_hole[size_t(f - mesh.faces.begin(ranks.rank()))] = true;
  result.has_creases = !ranks.all(creases.empty());
  result.has_corners = !ranks.all(corners.empty());
  result.has_holes = !ranks.all(mesh.holes.empty());
}

}  // namespace

Incidence incidence(const Ranks& ranks, const SpreadMesh& mesh, const std::string& name) {
  Incidence result;
  find_faces(ranks, mesh, result);
  const std::vector<Side> sides = sides_at_low_ends(ranks, mesh);
  tell_faces(ranks, mesh, sides, result);
  take_tags(ranks, mesh, sides, name, result);
  return result;
}

}  // namespace sublimit
