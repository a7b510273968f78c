// SPDX-License-Identifier: Apache-2.0
#include "sublimit/stencils/patterns/piece_matches.h"

#include <algorithm>
#include <numeric>

#include "sublimit/base/detail/parallel_for.h"

namespace sublimit {

void PieceMatches::find_regular(Patterns& patterns, const Level& level, Index count,
                                const std::function<Piece(Index)>& piece_at) {
  const int corners = level.topology().uniform_face_size();
  const auto kind = corners == 3 ? Piece::Kind::triangle : Piece::Kind::quad;
  if ((corners != 3 && corners != 4) || count == 0 || piece_at(0).kind != kind ||
      patterns.types()->pieces().rings(level.sharpness) != 1)
    return;
  regular_faces_.emplace(level, corners);
  std::vector<Index> points(size_t(regular_faces_->num_points()));
  for (Index i = 0; i < count; ++i) {
    const Piece piece = piece_at(i);
    if (!regular_faces_->points(level.topology().face(piece.start), points.data())) continue;
    // Found by looking at one: walks find the points in the same order, or the type is not to be taken from here.
    const Patterns::Match match = patterns.match(level, piece);
    if (match.turn == 0 && match.vertices == points) regular_ = match.pattern;
    return;
  }
}

void PieceMatches::set(Index i, const Patterns::Match& match) {
  Chunk& chunk = chunks_[size_t(i / per_chunk)];
  places_[i] = static_cast<std::int16_t>(chunk.matches.size());
  chunk.matches.push_back(
      {match.pattern, static_cast<std::int32_t>(chunk.points.size()), static_cast<std::int8_t>(match.turn)});
  chunk.points.insert(chunk.points.end(), match.vertices.begin(), match.vertices.end());
}

std::vector<const Pattern*> PieceMatches::patterns() const {
  std::vector<const Pattern*> all;
  for (Index i = 0; i < count(); ++i)
    if (places_[i] != is_unknown && (all.empty() || all.back() != &pattern(i))) all.push_back(&pattern(i));
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

Index* PieceMatches::points(Index i, Index* out) const {
  if (places_[i] == is_regular) {
    regular_faces_->points(Face{i}, out);
    return out + regular_faces_->num_points();
  }
  const Match& m = match(i);
  return std::copy_n(chunks_[size_t(i / per_chunk)].points.data() + m.first, m.pattern->num_slots, out);
}

PieceMatches::PieceMatches(Patterns& patterns, const Level& level, Index count,
                           const std::function<Piece(Index)>& piece_at, bool must_pay)
    : places_(count, is_unknown), chunks_(num_blocks(count, per_chunk)) {
  find_regular(patterns, level, count, piece_at);
  std::vector<std::vector<Index>> unknown(chunks_.size());
  std::vector<double> sizes(chunks_.size(), 0);
  parallel_for_blocks(
      count,
      [&](std::int64_t chunk, std::int64_t begin, std::int64_t end) {
        Patterns::Match match;
        for (auto i = static_cast<Index>(begin); i < end; ++i) {
          const Piece piece = piece_at(i);
          const Face face = level.topology().face(piece.start);
          if (regular_ && regular_faces_->is_regular(face)) {
            sizes[chunk] += double(regular_->size);
            if (index(face) == i) {
              places_[i] = is_regular;
              continue;
            }
            Patterns::Match own{regular_, 0, std::vector<Index>(size_t(regular_faces_->num_points()))};
            regular_faces_->points(face, own.vertices.data());
            set(i, own);  // found again by its number only where that is the face's
            continue;
          }
          if (patterns.find(level, piece, match))
            set(i, match);
          else
            unknown[chunk].push_back(i);
          sizes[chunk] += double(match.size);
        }
        chunks_[chunk].matches.shrink_to_fit();
        chunks_[chunk].points.shrink_to_fit();
      },
      per_chunk);
  std::vector<Index> rest;
  for (const std::vector<Index>& part : unknown) rest.insert(rest.end(), part.begin(), part.end());

  // A type takes about as the square of its size, rows of a piece as the size; types that are known already count as
  // well, so that the choice is that of the mesh.
  constexpr double squares_per_size = 280;
  double left = squares_per_size * std::accumulate(sizes.begin(), sizes.end(), 0.0);
  const auto pay = [&](size_t size) {
    left -= double(size) * double(size);
    if (must_pay && left < 0) pays_ = false;
  };
  for (const Pattern* pattern : this->patterns()) pay(pattern->size);
  // New types are made by the first piece that has them, whatever the number of threads. Each settles many others.
  Patterns::Match match;
  while (!rest.empty() && pays_) {
    const size_t some = std::min<size_t>(rest.size(), 64);
    for (size_t k = 0; k < some && pays_; ++k) {
      const Piece piece = piece_at(rest[k]);
      if (!patterns.find(level, piece, match)) {
        match = patterns.match(level, piece);
        pay(match.pattern->size);
      }
      set(rest[k], match);
    }
    rest.erase(rest.begin(), rest.begin() + std::ptrdiff_t(some));
    std::erase_if(rest, [&](Index i) {
      const bool known = pays_ && patterns.find(level, piece_at(i), match);
      if (known) set(i, match);
      return known;
    });
  }
}

}  // namespace sublimit
