// SPDX-License-Identifier: Apache-2.0
#include "sublimit/curves/detail/curve_pieces.h"

#include <algorithm>
#include <cmath>

namespace sublimit {

CurvePieces::CurvePieces(const CurveScheme<double>& scheme, int level, const std::vector<CurveOutline>& curves)
    : scheme_(scheme), layout_(scheme) {
  // The first piece whose window lies inside, and one more, whose neighbour does too.
  far_ = std::max(0, (layout_.begin() + layout_.radius() - 1) / 2);
  if (far_ > 0) ++far_;
  pad_ = far_ + layout_.radius() + layout_.end_points() + curve_margin / 2 + 2;
  settled_ = settled_level(level);
  for (const CurveOutline& curve : curves) {
    const Index pieces = num_pieces(curve);
    if (curve.closed)
      add(far_, far_, level);
    else
      for (Index j = 0; j < pieces; ++j) {
        if (j > far_ && pieces - 1 - j > far_) j = pieces - 1 - far_;
        add(j, pieces - 1 - j, level);
      }
  }
  for (int at = 0; at < num_types(); ++at) make_blocks(at);  // and adds children
  // What a piece keeps, its halves must keep.
  for (bool changed = true; changed;) {
    changed = false;
    for (Type& type : types_)
      for (const int child : type.child)
        if (type.keeps_linear && !types_[child].keeps_linear) {
          type.keeps_linear = false;
          changed = true;
        }
  }
  for (Type& type : types_) make_limits(type);
  for (int at = 0; at < num_types(); ++at) find_polynomials(at);
  for (Type& type : types_)
    if (type.polynomials.empty()) {
      make_vertices(type);
      make_powers(type);
    }
  for (Type& type : types_) find_orders(type);
  first_types_.assign((far_ + 1) * (far_ + 1), -1);
  for (const auto& [key, at] : numbers_)
    if (key[2] == std::min(level, settled_)) first_types_[key[0] * (far_ + 1) + key[1]] = at;
}

Index CurvePieces::num_polynomial() const {
  return static_cast<Index>(
      std::count_if(types_.begin(), types_.end(), [](const Type& type) { return !type.polynomials.empty(); }));
}

int CurvePieces::find(Index before, Index after, int level) const {
  return numbers_.at({clipped(before), clipped(after), std::min(level, settled_)});
}

int CurvePieces::add(Index before, Index after, int level) {
  const std::array<Index, 3> key{clipped(before), clipped(after), std::min(level, settled_)};
  const auto [at, is_new] = numbers_.try_emplace(key, num_types());
  if (is_new) {
    Type& type = types_.emplace_back();
    type.before = key[0];
    type.after = key[1];
    type.level = key[2];
  }
  return at->second;
}

CurveOutline CurvePieces::outline(Index pieces) const {
  constexpr Index any = 64;  // lengths differ by whole edges
  const Index end = static_cast<Index>(layout_.end(layout_.control(any, false)) / 2);
  return layout_.control(any + pieces - end, false);
}

CurveOutline CurvePieces::canonical(const Type& type) const {
  return outline(canonical_piece(type) + 1 + (type.after < far_ ? type.after : pad_));
}

PieceWindow CurvePieces::window(const CurveOutline& curve, Index piece) const {
  // Basis functions are zero at both ends of their support, which reaches as far as the masks.
  const std::int64_t low = 2 * std::int64_t{piece} - layout_.radius() + 2,
                     high = 2 * std::int64_t{piece} + layout_.radius();
  if (curve.closed) return {static_cast<Index>((low - curve.first) / 2), layout_.radius()};
  // Rules for points beyond an end see its first points.
  const bool at_start = low < layout_.begin(), at_end = layout_.end(curve) - high < layout_.begin();
  const Index all = curve.size, least = std::min<Index>(all, layout_.end_points());
  Index first = at_start ? 0 : layout_.point(curve, low), last = at_end ? all - 1 : layout_.point(curve, high);
  if (at_start) last = std::max(last, least - 1);
  if (at_end) first = std::min(first, all - least);
  return {first, last - first + 1};
}

/// Weights of the first unknowns, from the others: rows of derivatives sum to zero, those of second ones see nothing
/// linear.
void CurvePieces::project(const Type& type, int derivatives, double* weights) const {
  for (int k = 1; k <= derivatives; ++k) {
    double* row = weights + k * type.width;
    if (k == 2 && type.keeps_linear && type.width > 1) {
      double sum = 0;
      for (Index j = 2; j < type.width; ++j) sum += row[j] * type.slope[j];
      row[1] = -sum;
    }
    double sum = 0;
    for (Index j = 1; j < type.width; ++j) sum += row[j] * type.constant[j];
    row[0] = -sum;
  }
}

void CurvePieces::rows(const CurveOutline& curve, Index piece, double s, int order, bool one_sided,
                       CurvePieceRows& result) const {
  rows(curve.closed ? first_types_.back()
                    : first_types_[clipped(piece) * (far_ + 1) + clipped(num_pieces(curve) - 1 - piece)],
       s, order, one_sided, result);
}

void CurvePieces::rows(int at, double s, int order, bool one_sided, CurvePieceRows& result) const {
  // Down, by the digits of s.
  result.path.clear();
  int end = -1;  // the vertex where the way ends
  for (;;) {
    const Type& type = types_[at];
    if (!type.polynomials.empty()) break;
    if (s == 0 || s == 1) {
      end = s == 0 ? 0 : 1;
      if (type.vertex[end].exists >= 0) break;
      end = -1;
    }
    const int c = s >= 0.5 ? 1 : 0;
    if (type.child[c] == at && type.limit[c].size() > 0) {  // the same digit so many times
      const double rest = c == 0 ? s : 1 - s;
      int exponent = 0;
      const double mantissa = std::frexp(rest, &exponent);
      const int times = c == 1 && mantissa == 0.5 ? 1 - exponent : -exponent;
      s = c == 0 ? std::ldexp(rest, times) : 1 - std::ldexp(rest, times);
      for (int m = 0; times >> m != 0; ++m)
        if ((times >> m & 1) != 0) result.path.push_back({at, c, m});
    } else {
      result.path.push_back({at, c, -1});
      s = 2 * s - c;
      at = type.child[c];
    }
  }
  const Type* type = &types_[at];
  // The rows there.
  result.kink = false;
  const auto room = [&](int rows, Index width, std::vector<double>& weights) {
    if (weights.size() < size_t(rows) * width) weights.resize(size_t(rows) * width);
  };
  int derivatives = 0;
  if (end >= 0) {
    const Vertex& vertex = type->vertex[end];
    result.exists = vertex.exists;
    derivatives = std::min(order, vertex.exists);
    room(derivatives + 1, type->width, result.weights);
    std::copy_n(vertex.rows.data(), (derivatives + 1) * type->width, result.weights.data());
  } else {
    const int parts = static_cast<int>(type->polynomials.size()), part = parts == 2 && s >= 0.5 ? 1 : 0;
    result.exists = s == 0 && !one_sided ? type->start_order : 2;
    if (parts == 2 && s == 0.5) {
      result.kink = type->middle_order == 0;
      result.exists = result.kink ? 2 : type->middle_order;
    }
    derivatives = std::min(order, result.exists);
    room(derivatives + 1, type->width, result.weights);
    type->polynomials[part].evaluate(parts * s - part, derivatives, type->width, result.weights.data());
    for (int k = 1; k <= derivatives && parts == 2; ++k)
      for (Index j = 0; j < type->width; ++j) result.weights[k * type->width + j] *= k == 1 ? 2 : 4;
  }
  project(*type, derivatives, result.weights.data());
  // And back up.
  for (size_t i = result.path.size(); i-- > 0;) {
    const CurvePieceRows::Step& step = result.path[i];
    const Index from = type->width;
    type = &types_[step.piece];
    const Index width = type->width;
    room(derivatives + 1, width, result.before);
    for (int k = 0; k <= derivatives; ++k) {
      const Matrix& T = step.power < 0 ? type->B[step.child] : type->powers[step.child][step.power][k];
      const double factor = step.power < 0 ? 1 << k : 1;
      double* row = result.before.data() + k * width;
      std::fill(row, row + width, 0.0);
      for (Index a = 0; a < from; ++a) {
        const double weight = factor * result.weights[k * from + a];
        if (weight == 0) continue;
        const double* block = T.data() + std::int64_t{a} * width;
        for (Index j = 0; j < width; ++j) row[j] += weight * block[j];
      }
    }
    result.before.swap(result.weights);
    project(*type, derivatives, result.weights.data());
  }
  result.width = type->width;
}

}  // namespace sublimit
