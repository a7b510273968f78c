// SPDX-License-Identifier: Apache-2.0
#include "sublimit/patterns/piece_matches.h"

#include <algorithm>
#include <optional>

#include "sublimit/base/parallel_for.h"
#include "sublimit/neighborhood/regular_faces.h"

namespace sublimit {
namespace {

constexpr std::int64_t per_chunk = 1024;

/// The type of regular faces, if walks find their points in the order of `RegularFaces`: found by looking at one.
struct RegularType {
  std::optional<RegularFaces> faces;
  const Pattern* pattern = nullptr;

  RegularType(Patterns& patterns, const Level& level, Index count, const std::function<Piece(Index)>& piece_at) {
    const int corners = level.topology().uniform_face_size();
    const auto kind = corners == 3 ? Piece::Kind::triangle : Piece::Kind::quad;
    if ((corners != 3 && corners != 4) || count == 0 || piece_at(0).kind != kind ||
        patterns.types()->pieces().rings(level.sharpness) != 1)
      return;
    faces.emplace(level, corners);
    std::vector<Index> points(size_t(faces->num_points()));
    for (Index i = 0; i < count && !pattern; ++i) {
      const Piece piece = piece_at(i);
      if (!faces->points(level.topology().face(piece.start), points.data())) continue;
      const Patterns::Match match = patterns.match(level, piece);
      if (match.turn != 0 || match.vertices != points) return;
      pattern = match.pattern;
    }
  }
};

}  // namespace

void PieceMatches::set(Index i, size_t chunk, const Patterns::Match& match) {
  std::vector<Index>& own = chunks_[chunk];
  matches_[i] = {match.pattern, static_cast<std::int32_t>(chunk), static_cast<std::int32_t>(own.size()),
                 static_cast<std::int8_t>(match.turn)};
  own.insert(own.end(), match.vertices.begin(), match.vertices.end());
}

bool PieceMatches::find(Patterns& patterns, const Level& level, const Piece& piece, Index i, size_t chunk) {
  static thread_local Patterns::Match match;
  if (!patterns.find(level, piece, match)) return false;
  set(i, chunk, match);
  return true;
}

PieceMatches::PieceMatches(Patterns& patterns, const Level& level, Index count,
                           const std::function<Piece(Index)>& piece_at)
    : matches_(count), chunks_(num_blocks(count, per_chunk)) {
  const RegularType regular(patterns, level, count, piece_at);
  std::vector<std::vector<Index>> unknown(chunks_.size());
  parallel_for_blocks(
      count,
      [&](std::int64_t chunk, std::int64_t begin, std::int64_t end) {
        chunks_[chunk].reserve(16 * size_t(end - begin));
        Index points[16];
        for (auto i = static_cast<Index>(begin); i < end; ++i) {
          const Piece piece = piece_at(i);
          if (regular.pattern && regular.faces->points(level.topology().face(piece.start), points)) {
            std::vector<Index>& own = chunks_[chunk];
            matches_[i] = {regular.pattern, static_cast<std::int32_t>(chunk), static_cast<std::int32_t>(own.size()), 0};
            own.insert(own.end(), points, points + regular.faces->num_points());
          } else if (!find(patterns, level, piece, i, size_t(chunk))) {
            unknown[chunk].push_back(i);
          }
        }
      },
      per_chunk);
  std::vector<Index> rest;
  for (const std::vector<Index>& part : unknown) rest.insert(rest.end(), part.begin(), part.end());
  // New types are made by the first piece that has them, whatever the number of threads. Each settles many others.
  const auto chunk_of = [](Index i) { return size_t(i / per_chunk); };
  while (!rest.empty()) {
    const size_t some = std::min<size_t>(rest.size(), 64);
    for (size_t k = 0; k < some; ++k)
      if (!find(patterns, level, piece_at(rest[k]), rest[k], chunk_of(rest[k])))
        set(rest[k], chunk_of(rest[k]), patterns.match(level, piece_at(rest[k])));
    rest.erase(rest.begin(), rest.begin() + std::ptrdiff_t(some));
    std::erase_if(rest, [&](Index i) { return find(patterns, level, piece_at(i), i, chunk_of(i)); });
  }
}

}  // namespace sublimit
