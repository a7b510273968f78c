// SPDX-License-Identifier: Apache-2.0
#include "sublimit/mesh/detail/edge_lookup.h"

#include <algorithm>
#include <bit>
#include <cstdint>

namespace sublimit {
namespace {

/// Pairs of vertices in either order, each with a mark: open addressing, never more than half full.
class MarkedPairs {
 public:
  explicit MarkedPairs(std::size_t count) : slots_(std::bit_ceil(2 * count + 2)) {}

  void insert(Index a, Index b) { slot(a, b).pair = pair(a, b); }
  void mark(Index a, Index b) {
    Slot& found = slot(a, b);
    if (found.pair != none) found.marked = true;
  }
  bool is_marked(Index a, Index b) { return slot(a, b).marked; }

 private:
  static constexpr std::uint64_t none = ~std::uint64_t{0};
  struct Slot {
    std::uint64_t pair = none;
    bool marked = false;
  };

  static std::uint64_t pair(Index a, Index b) {
    return std::uint64_t(std::uint32_t(std::min(a, b))) << 32 | std::uint32_t(std::max(a, b));
  }

  // The slot of a pair, or the free one where it would go.
  Slot& slot(Index a, Index b) {
    const std::uint64_t key = pair(a, b);
    std::uint64_t hash = (key ^ key >> 32) * 0x9E3779B97F4A7C15u;  // 2^64 over the golden ratio
    hash = (hash ^ hash >> 29) * 0xBF58476D1CE4E5B9u;
    std::size_t i = hash >> 32 & (slots_.size() - 1);
    while (slots_[i].pair != none && slots_[i].pair != key) i = (i + 1) & (slots_.size() - 1);
    return slots_[i];
  }

  std::vector<Slot> slots_;
};

}  // namespace

std::vector<bool> along_edges(const Mesh& mesh, std::span<const Mesh::Crease> creases) {
  std::vector<bool> found(creases.size());
  if (creases.empty()) return found;
  MarkedPairs pairs(creases.size());
  std::vector<bool> creased(static_cast<std::size_t>(mesh.num_vertices()));  // most half-edges stop here
  for (const Mesh::Crease& crease : creases) {
    pairs.insert(crease.tail, crease.head);
    creased[crease.tail] = true;
  }
  const Index* face = mesh.face_vertices.data();
  for (const Index size : mesh.face_sizes) {
    Index tail = face[size - 1];
    for (Index i = 0; i < size; ++i) {
      const Index head = face[i];
      if (creased[tail] || creased[head]) pairs.mark(tail, head);
      tail = head;
    }
    face += size;
  }
  for (std::size_t i = 0; i < creases.size(); ++i) found[i] = pairs.is_marked(creases[i].tail, creases[i].head);
  return found;
}

void drop_loose_creases(Mesh& mesh, const std::function<std::string(std::size_t)>& place) {
  const std::vector<bool> found = along_edges(mesh, mesh.creases);
  constexpr std::size_t most = 20;
  std::size_t kept = 0, loose = 0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    const Mesh::Crease crease = mesh.creases[i];
    if (found[i]) {
      mesh.creases[kept++] = crease;
    } else if (++loose <= most) {
      mesh.warnings.push_back(place(i) + "crease ignored: no face has an edge between vertices " +
                              std::to_string(crease.tail) + " and " + std::to_string(crease.head) +
                              " (ids count from 0)");
    }
  }
  mesh.creases.resize(kept);
  if (loose > most)
    mesh.warnings.push_back(place(found.size() - 1) + std::to_string(loose - most) +
                            " further creases without an edge ignored");
}

std::vector<Mesh::Crease> edges_of(std::span<const Mesh::KnotInterval> intervals) {
  std::vector<Mesh::Crease> result;
  for (const Mesh::KnotInterval& interval : intervals) result.push_back({interval.tail, interval.head, 0});
  return result;
}

}  // namespace sublimit
