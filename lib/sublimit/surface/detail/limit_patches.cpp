// SPDX-License-Identifier: Apache-2.0
#include "sublimit/surface/detail/limit_patches.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <tuple>

#include "sublimit/base/detail/parallel_for.h"
#include "sublimit/neighborhood/piece_rows.h"

// The loops below are compiled for wide registers too, and the machine chooses; none of them fuses multiplications, so
// all give the same bits.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_THREAD__) && \
    !defined(__SANITIZE_ADDRESS__)
#define SUBLIMIT_WIDE __attribute__((target_clones("avx2", "default")))
#else
#define SUBLIMIT_WIDE
#endif

namespace sublimit {
namespace {

/// x, y, z, and anything.
typedef double Vec4 __attribute__((vector_size(32), aligned(8), may_alias));

struct Jet {
  Vec4 p, u, v, uu, uv, vv;
};

/// Sum of coefficients[i, j] s^i t^j with derivatives by s and t.
template <int Degree, bool Total, int Order>
[[gnu::always_inline]] inline void horner(const double* coefficients, double s, double t, Jet& jet) {
  const auto c = [coefficients](int k) -> const Vec4& {
    return *reinterpret_cast<const Vec4*>(coefficients + 3 * k);  // and the x of the next one, which goes nowhere
  };
  Vec4 p{}, p1{}, p2{}, q{}, q1{}, r{};
  for (int i = Degree; i >= 0; --i) {
    const int first = Total ? i * (Degree + 1) - i * (i - 1) / 2 : i * (Degree + 1), last = Total ? Degree - i : Degree;
    Vec4 a = c(first + last), b{}, d{};
    for (int j = last - 1; j >= 0; --j) {
      if (Order >= 2) d = d * t + 2 * b;
      if (Order >= 1) b = b * t + a;
      a = a * t + c(first + j);
    }
    if (Order >= 2) {
      p2 = p2 * s + 2 * p1;
      q1 = q1 * s + q;
      r = r * s + d;
    }
    if (Order >= 1) {
      p1 = p1 * s + p;
      q = q * s + b;
    }
    p = p * s + a;
  }
  jet.p = p;
  if (Order >= 1) jet.u = p1, jet.v = q;
  if (Order >= 2) jet.uu = p2, jet.uv = q1, jet.vv = r;
}

template <int Order>
[[gnu::always_inline]] inline void evaluate_patch(const PatchTree& tree, const double* c, const PieceCoordinates& place,
                                                  Jet& jet) {
  const double s = 2 * place.u - 1, t = 2 * place.v - 1;
  switch (tree.degree() + (tree.total() ? 10 : 0)) {
    case 1:
      horner<1, false, Order>(c, s, t, jet);
      break;
    case 2:
      horner<2, false, Order>(c, s, t, jet);
      break;
    case 3:
      horner<3, false, Order>(c, s, t, jet);
      break;
    case 4:
      horner<4, false, Order>(c, s, t, jet);
      break;
    case 11:
      horner<1, true, Order>(c, s, t, jet);
      break;
    case 12:
      horner<2, true, Order>(c, s, t, jet);
      break;
    case 13:
      horner<3, true, Order>(c, s, t, jet);
      break;
    default:
      horner<4, true, Order>(c, s, t, jet);
  }
  if (Order >= 1) jet.u = 2 * jet.u, jet.v = 2 * jet.v;
  if (Order >= 2) jet.uu = 4 * jet.uu, jet.uv = 4 * jet.uv, jet.vv = 4 * jet.vv;
}

template <int Order>
[[gnu::always_inline]] inline void apply_chain(const PieceMap::Chain& c, Jet& jet) {
  const Jet old = jet;
  if (Order >= 1) {
    jet.u = c.first[0][0] * old.u + c.first[0][1] * old.v;
    jet.v = c.first[1][0] * old.u + c.first[1][1] * old.v;
  }
  if (Order >= 2) {
    Vec4* second[3] = {&jet.uu, &jet.uv, &jet.vv};
    for (int i = 0; i < 3; ++i)
      *second[i] = c.second[i][0] * old.uu + c.second[i][1] * old.uv + c.second[i][2] * old.vv + c.bend[i][0] * old.u +
                   c.bend[i][1] * old.v;
  }
}

[[gnu::always_inline]] inline void store(const Vec4& x, double* row) {
  row[0] = x[0];
  row[1] = x[1];
  row[2] = x[2];
}

/// `matrix` times the differences of a piece's points; the constants of all patches get slot 0.
SUBLIMIT_WIDE void bind_patches(const RowMatrix& matrix, int patch_size, const double* from, double* out) {
  const Eigen::Index rows = matrix.rows(), columns = matrix.cols();
  const Vec4* differences = reinterpret_cast<const Vec4*>(from);  // the origin comes behind them
  const Vec4& origin = differences[columns];
  int in_patch = 0;
  for (Eigen::Index i = 0; i < rows; ++i) {
    const double* row = matrix.data() + i * columns;
    Vec4 a{}, b{};
    Eigen::Index j = 0;
    for (; j + 1 < columns; j += 2) {
      a += row[j] * differences[j];
      b += row[j + 1] * differences[j + 1];
    }
    if (j < columns) a += row[j] * differences[j];
    store(in_patch == 0 ? a + b + origin : a + b, out + 3 * i);
    if (++in_patch == patch_size) in_patch = 0;
  }
}

}  // namespace

/// What a loop over samples needs of everything else, by plain pointers.
struct LimitPatches::Loop {
  const LimitMap::Parts& parts;
  const Bound* bound;
  const double* coefficients;
  bool second_jumps, dual;
  bool one_to_one;  ///< pieces are the addresses
  bool triangles;

  /// Rows of a run of samples that are left for the long way. No vector: g++ 12 lets no exception out of functions that
  /// it clones.
  struct Rest {
    static constexpr std::int64_t most = 512;
    std::array<std::int64_t, most> rows;
    std::int64_t count = 0;
  };

  void positions(std::span<const Place> samples, std::int64_t begin, std::int64_t end, LimitSamples& out,
                 Rest& rest) const;
  void first_derivatives(std::span<const Place> samples, std::int64_t begin, std::int64_t end, bool normals,
                         LimitSamples& out, Rest& rest) const;
  void second_derivatives(std::span<const Place> samples, std::int64_t begin, std::int64_t end, bool normals,
                          LimitSamples& out, Rest& rest) const;

  /// A piece, and the place in it.
  struct At {
    Index number;
    PieceCoordinates place;
    const PieceMap* map = nullptr;  ///< of derivatives, then
    PieceCoordinates outer = {};
  };
  [[gnu::always_inline]] At at(const Place& s) const {
    if (one_to_one) return {s.face, triangles ? triangle_place(s.u, s.v) : quad_place(s.u, s.v)};
    const LimitMap::Parts::Target target = parts.target(s);
    return {parts.number(s, target), target.place, target.map, target.outer};
  }

  // Memory for samples to come, where it is known without a search. Faces may not exist.
  [[gnu::always_inline]] void fetch_piece(const Place& s) const {
    if (one_to_one && parts.is_inside(s)) __builtin_prefetch(bound + s.face);
  }
  [[gnu::always_inline]] void fetch_patch(const Place& s) const {
    if (!one_to_one || !parts.is_inside(s)) return;
    const Bound& piece = bound[s.face];
    const int patch = std::max<int>(0, piece.tree->cell(s.u, s.v).patch);
    const double* c = coefficients + 3 * (piece.first + std::int64_t(patch) * piece.tree->num_coefficients());
    for (int k = 0; k < 3 * piece.tree->num_coefficients(); k += 8) __builtin_prefetch(c + k);
  }

  /// Fast path of one row. Returns false if the general path is needed.
  template <int Order>
  [[gnu::always_inline]] bool row(const Place& place, bool normals, LimitSamples& out, std::int64_t i) const {
    if (!parts.is_inside(place)) return false;
    const At target = at(place);
    const Bound& piece = bound[target.number];
    const PatchTree& tree = *piece.tree;
    const PatchTree::Cell& cell = tree.cell(target.place.u, target.place.v);
    // Quarters are cut off by the bits of the parameters, exactly.
    const PieceLink* links[8];
    PieceCoordinates places[9];
    places[0] = target.place;
    int depth = 0, patch = cell.patch;
    double scale = cell.size;  // of derivatives, while children lie as their parents do
    bool aligned = true;
    const auto cut = [&](double& x, double& x1) {
      const double n = scale * x, lower = std::max(0., std::ceil(n) - 1);
      x1 = scale * x1 - (scale - 1 - lower);
      x = n - lower;
    };
    cut(places[0].u, places[0].u1);
    cut(places[0].v, places[0].v1);
    if (patch < 0) {
      const PatchTree::Node* nodes = tree.nodes().data();
      const PatchTree::Node* node = nodes + cell.node;
      while (node->patch < 0) {
        if (node->first_child < 0) return false;
        const PieceCoordinates& at = places[depth];
        PieceCoordinates& next = places[depth + 1];
        int k = 0;
        if (node->in_four) {
          const bool right = at.u > 0.5, up = at.v > 0.5;
          k = right ? (up ? 2 : 1) : (up ? 3 : 0);
          next.u1 = right ? 2 * at.u1 : 1 - 2 * at.u;
          next.u = right ? 1 - next.u1 : 2 * at.u;
          next.v1 = up ? 2 * at.v1 : 1 - 2 * at.v;
          next.v = up ? 1 - next.v1 : 2 * at.v;
          scale *= 2;
        } else {
          aligned = false;
          while (k < int(node->links->size()) && !(*node->links)[k].map.contains(at)) ++k;
          if (k == int(node->links->size())) return false;
          next = (*node->links)[k].map(at);
        }
        links[depth++] = &(*node->links)[k];
        node = nodes + node->first_child + k;
      }
      patch = node->patch;
    }
    const PieceCoordinates& inner = places[depth];
    const PieceCoordinates& p = target.place;
    LimitStatus status = LimitStatus::regular;
    const unsigned own_sides = piece.sides;
    if (own_sides != 0) {
      if (own_sides & LimitMap::Parts::sides_at(p, tree.total())) status = LimitStatus::crease;
      if (own_sides & LimitMap::Parts::hole) status = LimitStatus::hole;
    }
    int order = Order;
    if (Order == 2 && second_jumps) {
      if (is_on_knot(inner, tree.total(), dual, tree.halves())) {
        order = 1;
        if (status == LimitStatus::regular) status = LimitStatus::unbounded_second;
      }
    }
    if (tree.halves()) patch = 2 * (patch / 2) + (inner.u < inner.v ? 1 : 0);
    Jet jet;
    evaluate_patch<Order>(tree, coefficients + 3 * (piece.first + std::int64_t(patch) * tree.num_coefficients()), inner,
                          jet);
    if (Order >= 1) {
      if (aligned) {
        jet.u = scale * jet.u, jet.v = scale * jet.v;
        if (Order >= 2) {
          const double square = scale * scale;
          jet.uu = square * jet.uu, jet.uv = square * jet.uv, jet.vv = square * jet.vv;
        }
      } else {
        while (depth-- > 0) apply_chain<Order>(links[depth]->map.chain(places[depth]), jet);
      }
      if (target.map) apply_chain<Order>(target.map->chain(target.outer), jet);
      if (normals) {
        const Vec4 a = jet.u, b = jet.v;
        const double x = a[1] * b[2] - a[2] * b[1], y = a[2] * b[0] - a[0] * b[2], z = a[0] * b[1] - a[1] * b[0];
        const double cross = x * x + y * y + z * z;
        const double size = (a[0] * a[0] + a[1] * a[1] + a[2] * a[2]) * (b[0] * b[0] + b[1] * b[1] + b[2] * b[2]);
        if (!is_sound_normal(cross, size)) return false;
        const double inverse = 1 / std::sqrt(cross);
        double* n = out.normal.data() + 3 * i;
        n[0] = x * inverse, n[1] = y * inverse, n[2] = z * inverse;
      }
    }
    store(jet.p, out.position.data() + 3 * i);
    if (Order >= 1) {
      store(jet.u, out.du.data() + 3 * i);
      store(jet.v, out.dv.data() + 3 * i);
    }
    if (Order >= 2) {
      if (order < 2) jet.uu = jet.uv = jet.vv = Vec4{};
      store(jet.uu, out.duu.data() + 3 * i);
      store(jet.uv, out.duv.data() + 3 * i);
      store(jet.vv, out.dvv.data() + 3 * i);
    }
    out.status[i] = status;
    out.order[i] = static_cast<std::int8_t>(order);
    return true;
  }
};

LimitPatches::LimitPatches(const LimitMap::Parts& parts, const Points& points)
    : parts_(parts), points_(points), pieces_(parts.pieces()) {
  const Index count = parts.num_pieces();
  bound_.resize(count);
  std::int64_t size = 0;
  for (Index i = 0; i < count; ++i) {
    bound_[i].tree = pieces_.trees[i];
    bound_[i].first = size;
    size += pieces_.trees[i]->matrix().rows();
  }
  coefficients_.resize(3 * size + 1);
  coefficients_[3 * size] = 0;
  const Points fine = parts.prepared ? Points(parts.prepared->S * points) : Points();
  const Points& x_of = parts.prepared ? fine : points;
  parallel_for_blocks(
      count,
      [&](std::int64_t, std::int64_t begin, std::int64_t end) {
        std::vector<double> differences;
        for (std::int64_t i = begin; i < end; ++i) {
          const Piece piece = parts.piece(static_cast<Index>(i));
          const PatchTree& tree = *pieces_.trees[i];
          const Index* v = pieces_.vertices.data() + pieces_.first[i];
          const auto n = pieces_.first[i + 1] - pieces_.first[i] - 1;
          const double* x0 = x_of.data() + 3 * std::int64_t(v[0]);
          differences.resize(4 * (n + 1));
          for (std::int64_t j = 0; j < n; ++j) {
            const double* x = x_of.data() + 3 * std::int64_t(v[j + 1]);
            for (int k = 0; k < 3; ++k) differences[4 * j + k] = x[k] - x0[k];
            differences[4 * j + 3] = 0;
          }
          for (int k = 0; k < 3; ++k) differences[4 * n + k] = x0[k];
          differences[4 * n + 3] = 0;
          bind_patches(tree.matrix(), tree.num_coefficients(), differences.data(),
                       coefficients_.data() + 3 * bound_[i].first);
          bound_[i].sides = static_cast<std::uint16_t>(parts.sides(piece));
        }
      },
      256);
}

namespace {

template <int Order, class Loop>
[[gnu::always_inline]] inline void run(const Loop& loop, std::span<const Place> samples, std::int64_t begin,
                                       std::int64_t end, bool normals, LimitSamples& out, typename Loop::Rest& rest) {
  constexpr std::int64_t patches_ahead = 6, pieces_ahead = 12;
  for (std::int64_t i = begin; i < end; ++i) {
    if (i + pieces_ahead < end) loop.fetch_piece(samples[i + pieces_ahead]);
    if (i + patches_ahead < end) loop.fetch_patch(samples[i + patches_ahead]);
    if (!loop.template row<Order>(samples[i], normals, out, i)) rest.rows[rest.count++] = i;
  }
}

}  // namespace

SUBLIMIT_WIDE void LimitPatches::Loop::positions(std::span<const Place> samples, std::int64_t begin, std::int64_t end,
                                                 LimitSamples& out, Rest& rest) const {
  run<0>(*this, samples, begin, end, false, out, rest);
}
SUBLIMIT_WIDE void LimitPatches::Loop::first_derivatives(std::span<const Place> samples, std::int64_t begin,
                                                         std::int64_t end, bool normals, LimitSamples& out,
                                                         Rest& rest) const {
  run<1>(*this, samples, begin, end, normals, out, rest);
}
SUBLIMIT_WIDE void LimitPatches::Loop::second_derivatives(std::span<const Place> samples, std::int64_t begin,
                                                          std::int64_t end, bool normals, LimitSamples& out,
                                                          Rest& rest) const {
  run<2>(*this, samples, begin, end, normals, out, rest);
}

std::int64_t LimitPatches::evaluate(std::span<const Place> samples, std::int64_t begin, std::int64_t end, int order,
                                    bool normals, LimitSamples& out) const {
  const Loop loop{parts_,
                  bound_.data(),
                  coefficients_.data(),
                  parts_.types->pieces().regular_smoothness() == 1,
                  parts_.scheme.is_dual(),
                  !parts_.prepared && !parts_.scheme.is_dual(),
                  parts_.addresses.triangles()};
  std::vector<std::int64_t> rest;
  for (std::int64_t first = begin; first < end; first += Loop::Rest::most) {
    const std::int64_t last = std::min(end, first + Loop::Rest::most);
    Loop::Rest left;
    if (order == 0) loop.positions(samples, first, last, out, left);
    if (order == 1) loop.first_derivatives(samples, first, last, normals, out, left);
    if (order == 2) loop.second_derivatives(samples, first, last, normals, out, left);
    rest.insert(rest.end(), left.rows.begin(), left.rows.begin() + left.count);
  }
  // Alike ones one after another: their rows are the same.
  struct Left {
    const PieceType* type;
    double u, v;
    std::int64_t i;
  };
  std::vector<Left> left;
  left.reserve(rest.size());
  for (const std::int64_t i : rest) {
    const Place& s = samples[i];
    if (!parts_.is_inside(s)) {
      left.push_back({nullptr, 0, 0, i});
      continue;
    }
    const LimitMap::Parts::Target target = parts_.target(s);
    left.push_back({pieces_.types[parts_.number(s, target)], target.place.u, target.place.v, i});
  }
  std::sort(left.begin(), left.end(), [](const Left& a, const Left& b) {
    return a.type != b.type ? std::less<>()(a.type, b.type) : std::tie(a.u, a.v, a.i) < std::tie(b.u, b.v, b.i);
  });
  LimitMap::Parts::KnownRows known{.pieces = &pieces_};
  for (const Left& one : left) parts_.evaluate_row(points_, samples[one.i], order, normals, out, one.i, &known);
  return known.made;
}

}  // namespace sublimit
