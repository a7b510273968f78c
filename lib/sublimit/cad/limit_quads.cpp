// SPDX-License-Identifier: Apache-2.0
#include "sublimit/cad/limit_quads.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

#include "sublimit/base/error.h"
#include "sublimit/base/parallel_for.h"
#include "sublimit/cad/place_numbers.h"
#include "sublimit/limit/limit_patches.h"
#include "sublimit/patches/blossom.h"

namespace sublimit {
namespace {

/// Extraordinary vertices are apart from each other after two quarterings, whatever faces they share.
constexpr int first_quarterings = 2;
/// Sharpness below 10 is gone after so many.
constexpr int most_decaying = 10;
/// Cells keep whole steps between their corners, the middles of their sides, and the middles of these.
constexpr std::int32_t least_steps = 8;

/// Part of the surface: a polynomial, or what is not known to be one.
struct CadCell {
  Index address = 0;
  CellCorners corners;
  int depth = 0;  ///< quarterings of a quadrilateral face, or of a triangle
  bool triangle = false;
  int degree = 0;   ///< 0: no polynomial
  Points net = {};  ///< on the square, or the triangle
  const PieceType* type = nullptr;
  Points points = {};
};

class CellCutter {
 public:
  CellCutter(std::vector<CadCell>& exact, std::vector<CadCell>& rest) : exact_(exact), rest_(rest) {}

  /// @param least  quarterings that all but polynomials have
  void cut(CadCell cell, int least) {
    const bool decays = cell.type->decays() && cell.depth < most_decaying;
    if (!cell.type->polynomial() && cell.depth >= least && !decays) return rest_.push_back(std::move(cell));
    if (!cell.type->polynomial()) return cut_children(cell, least);
    std::vector<PiecePart> whole;
    parts_.find(*cell.type, cell.points, cell.corners, 0, whole);
    if (whole[0].nets.size() > 1)
      throw UnsupportedTopology(
          "faces of this scheme's limit are cut along their diagonals, which no tensor B-spline is; catmull-clark, "
          "doo-sabin, averaging, bilinear and loop are exact in B-splines");
    cell.degree = cell.type->polynomial()->basis.degree();
    cell.net = std::move(whole[0].nets[0]);
    cell.points.resize(0, 3);
    exact_.push_back(std::move(cell));
  }

  void cut_children(const CadCell& cell, int least) {
    const auto& children = cell.type->children();
    for (const PieceLink& link : children) {
      const std::optional<CellCorners> child = child_of(cell.corners, link.map, cell.triangle);
      if (!child)
        throw UnsupportedTopology(
            "faces next to a border of a dual scheme, or with knot intervals, are not cut into quarters; close the "
            "mesh, or take catmull-clark");
      CadCell own{cell.address, *child, cell.depth + (children.size() > 1 ? 1 : 0), cell.triangle};
      own.type = link.type;
      own.points = child_points(link, cell.points);
      cut(std::move(own), least);
    }
  }

 private:
  std::vector<CadCell>&exact_, &rest_;
  PieceParts parts_;
};

std::vector<std::array<double, 2>> corners_in_address(const CadCell& cell) {
  std::vector<std::array<double, 2>> at;
  for (size_t k = 0; k < (cell.triangle ? 3u : 4u); ++k)
    at.push_back({double(cell.corners[k].i) / cell_steps, double(cell.corners[k].j) / cell_steps});
  return at;
}

/// Corners of the thirds of a unit triangle.
std::array<std::array<double, 2>, 4> third_of_triangle(const std::vector<std::array<double, 2>>& c, size_t k) {
  const auto mean = [](const std::array<double, 2>& a, const std::array<double, 2>& b) {
    return std::array<double, 2>{(a[0] + b[0]) / 2, (a[1] + b[1]) / 2};
  };
  return {c[k],
          mean(c[k], c[(k + 1) % 3]),
          {(c[0][0] + c[1][0] + c[2][0]) / 3, (c[0][1] + c[1][1] + c[2][1]) / 3},
          mean(c[(k + 2) % 3], c[k])};
}

/// Nodes with the ends, symmetric: x(k) = 1 - x(d - k) to the bit.
std::vector<double> interpolation_nodes(int degree) {
  std::vector<double> nodes(size_t(degree) + 1);
  for (int k = 0; 2 * k <= degree; ++k) {
    nodes[size_t(k)] = 2 * k == degree ? 0.5 : (1 - std::cos(k * M_PI / degree)) / 2;
    nodes[size_t(degree - k)] = 1 - nodes[size_t(k)];
  }
  return nodes;
}

/// Bernstein coefficients by values at the nodes.
Eigen::MatrixXd interpolation(int degree) {
  const std::vector<double> nodes = interpolation_nodes(degree);
  Eigen::MatrixXd values(degree + 1, degree + 1);
  for (int k = 0; k <= degree; ++k) {
    std::vector<double> w(size_t(degree) + 1);
    w[0] = 1;
    for (int q = 1; q <= degree; ++q)
      blossom_step(UnitSpan<double>{}, q, UnitArgument<double>::point(nodes[size_t(k)]), w.data());
    for (int i = 0; i <= degree; ++i) values(k, i) = w[size_t(i)];
  }
  return values.fullPivLu().inverse();
}

/// Rows of a square's net by values at pairs of nodes, the second fastest.
Points fitted_net(const Eigen::MatrixXd& coefficients, const Points& values) {
  const Eigen::Index n = coefficients.rows();
  const Eigen::RowVector3d origin = values.row(0);
  Points along(n * n, 3), net(n * n, 3);
  for (Eigen::Index i = 0; i < n; ++i)
    along.middleRows(i * n, n) = coefficients * (values.middleRows(i * n, n).rowwise() - origin);
  for (Eigen::Index j = 0; j < n; ++j) {
    Points column(n, 3);
    for (Eigen::Index i = 0; i < n; ++i) column.row(i) = along.row(i * n + j);
    const Points own = coefficients * column;
    for (Eigen::Index i = 0; i < n; ++i) net.row(i * n + j) = own.row(i) + origin;
  }
  return net;
}

/// Quads of polynomial cells, shared between threads.
class ExactQuads {
 public:
  std::vector<LimitQuad> of(const CadCell& cell) {
    LimitQuad quad{cell.address, cell.corners};
    quad.degree = cell.degree;
    quad.size = std::ldexp(1.0, -cell.depth);
    const std::vector<std::array<double, 2>> at = corners_in_address(cell);
    if (!cell.triangle) {
      std::ranges::copy(at, quad.corners.begin());
      quad.net = cell.net;
      return {quad};
    }
    std::vector<LimitQuad> thirds;
    quad.size /= 2;
    for (size_t k = 0; k < 3; ++k) {
      quad.third = int(k);
      quad.corners = third_of_triangle(at, k);
      quad.net = (thirds_of(cell.degree)[k] * (cell.net.rowwise() - cell.net.row(0))).rowwise() + cell.net.row(0);
      thirds.push_back(quad);
    }
    return thirds;
  }

  /// Nets of the thirds by the net of a triangle.
  const std::array<Eigen::MatrixXd, 3>& thirds_of(int degree) {
    const auto [at, is_new] = thirds_.try_emplace(degree);
    if (!is_new) return at->second;
    const PolynomialBasis basis(degree, true);
    const Eigen::MatrixXd from_net = bernstein_from(basis).fullPivLu().inverse(), fit = interpolation(degree);
    const std::vector<double> nodes = interpolation_nodes(degree);
    const Eigen::Index n = degree + 1;
    for (size_t k = 0; k < 3; ++k) {
      LimitQuad third;
      third.corners = third_of_triangle({{0, 0}, {1, 0}, {0, 1}}, k);
      Eigen::MatrixXd values(n * n, from_net.rows());
      for (Eigen::Index i = 0; i < n; ++i)
        for (Eigen::Index j = 0; j < n; ++j) {
          const Sample s = third.place(nodes[size_t(i)], nodes[size_t(j)]);
          values.row(i * n + j) = basis.at(s.u, s.v, 0) * from_net;
        }
      Eigen::MatrixXd tensor(n * n, n * n);
      for (Eigen::Index i = 0; i < n; ++i)
        for (Eigen::Index j = 0; j < n; ++j)
          for (Eigen::Index a = 0; a < n; ++a)
            for (Eigen::Index b = 0; b < n; ++b) tensor(i * n + j, a * n + b) = fit(i, a) * fit(j, b);
      at->second[k] = tensor * values;
    }
    return at->second;
  }

 private:
  std::map<int, std::array<Eigen::MatrixXd, 3>> thirds_;
};

/// Fits caps to the limit, and measures them.
class CapFitter {
 public:
  CapFitter(const LimitSurface& surface, const Points& points, int degree)
      : bound_(surface, points),
        triangles_(surface.addresses().triangles()),
        degree_(degree),
        coefficients_(interpolation(degree)) {}

  std::vector<LimitQuad> caps(const std::vector<CadCell>& cells) const {
    std::vector<LimitQuad> quads;
    for (const CadCell& cell : cells) {
      LimitQuad quad{cell.address, cell.corners};
      quad.is_exact = false;
      quad.degree = degree_;
      quad.size = std::ldexp(1.0, -cell.depth) / (cell.triangle ? 2 : 1);
      const std::vector<std::array<double, 2>> at = corners_in_address(cell);
      for (size_t k = 0; k < (cell.triangle ? 3u : 1u); ++k) {
        quad.third = cell.triangle ? int(k) : -1;
        if (cell.triangle)
          quad.corners = third_of_triangle(at, k);
        else
          std::ranges::copy(at, quad.corners.begin());
        quads.push_back(quad);
      }
    }
    const std::vector<double> nodes = interpolation_nodes(degree_);
    std::vector<Sample> places;
    for (const LimitQuad& quad : quads)
      for (const double s : nodes)
        for (const double t : nodes) places.push_back(inside(quad.place(s, t)));
    const LimitSamples samples = bound_.evaluate(places, 0, false);
    const Eigen::Index size = Eigen::Index(nodes.size() * nodes.size());
    for (size_t q = 0; q < quads.size(); ++q)
      quads[q].net = fitted_net(coefficients_, samples.position.middleRows(Eigen::Index(q) * size, size));
    return quads;
  }

  /// Largest distance of points of each quad from points of the limit near them.
  std::vector<double> deviations(const std::vector<LimitQuad>& quads) const {
    constexpr int grid = 6, rounds = 3;
    std::vector<Sample> places;
    std::vector<Eigen::RowVector3d> own;
    for (const LimitQuad& quad : quads)
      for (int i = 0; i < grid; ++i)
        for (int j = 0; j < grid; ++j) {
          const double s = (i + 0.5) / grid, t = (j + 0.5) / grid;
          places.push_back(inside(quad.place(s, t)));
          own.push_back(value(quad, s, t));
        }
    std::vector<double> distance(own.size(), HUGE_VAL);
    for (int round = 0; round < rounds; ++round) {
      const LimitSamples x = bound_.evaluate(places, 1, false);
      for (size_t i = 0; i < own.size(); ++i) {
        const auto row = Eigen::Index(i);
        const Eigen::Vector3d off = (own[i] - x.position.row(row)).transpose();
        distance[i] = std::min(distance[i], off.norm());
        if (x.order[i] < 1) continue;
        Eigen::Matrix<double, 3, 2> J;
        J << x.du.row(row).transpose(), x.dv.row(row).transpose();
        const Eigen::Vector2d step = J.colPivHouseholderQr().solve(off);
        if (!step.allFinite()) continue;
        places[i].u += step[0], places[i].v += step[1];
        places[i] = inside(places[i]);
      }
    }
    std::vector<double> largest(quads.size(), 0);
    for (size_t i = 0; i < own.size(); ++i)
      largest[i / (grid * grid)] = std::max(largest[i / (grid * grid)], distance[i]);
    return largest;
  }

 private:
  Sample inside(Sample s) const {
    s.u = std::clamp(s.u, 0.0, 1.0);
    s.v = std::clamp(s.v, 0.0, triangles_ ? 1 - s.u : 1.0);
    return s;
  }
  static Eigen::RowVector3d value(const LimitQuad& quad, double s, double t) {
    const int d = quad.degree;
    std::vector<double> a(size_t(d) + 1), b(size_t(d) + 1);
    a[0] = b[0] = 1;
    for (int q = 1; q <= d; ++q) {
      blossom_step(UnitSpan<double>{}, q, UnitArgument<double>::point(s), a.data());
      blossom_step(UnitSpan<double>{}, q, UnitArgument<double>::point(t), b.data());
    }
    Eigen::RowVector3d x = Eigen::RowVector3d::Zero();
    for (int i = 0; i <= d; ++i)
      for (int j = 0; j <= d; ++j) x += a[size_t(i)] * b[size_t(j)] * quad.net.row(i * (d + 1) + j);
    return x;
  }

  BoundLimitSurface bound_;
  bool triangles_;
  int degree_;
  Eigen::MatrixXd coefficients_;
};

/// Numbers of the groups of cells that share corners: those around one extraordinary vertex.
std::vector<size_t> groups_of(const std::vector<CadCell>& cells, const LimitSurface::Parts& parts) {
  std::vector<size_t> group(cells.size());
  std::iota(group.begin(), group.end(), size_t{0});
  const auto find = [&](size_t a) {
    while (group[a] != a) a = group[a] = group[group[a]];
    return a;
  };
  PlaceNumbers places(parts);
  std::vector<size_t> first;
  for (size_t c = 0; c < cells.size(); ++c)
    for (size_t k = 0; k < (cells[c].triangle ? 3u : 4u); ++k) {
      const auto place = size_t(places.add(cells[c].address, cells[c].corners[k]));
      if (place == first.size()) first.push_back(c);
      const size_t a = find(first[place]), b = find(c);
      group[std::max(a, b)] = std::min(a, b);
    }
  for (size_t c = 0; c < cells.size(); ++c) group[c] = find(c);
  return group;
}

bool can_be_cut(const CadCell& cell) {
  return std::abs(cell.corners[1].i - cell.corners[0].i) + std::abs(cell.corners[1].j - cell.corners[0].j) >=
         2 * least_steps;
}

/// Quarterings of an address that make cells of this size.
int depth_of(const CellCorners& c, bool triangle) {
  const CellCorner& last = c[triangle ? 2 : 3];
  const double area = double(c[1].i - c[0].i) * (last.j - c[0].j) - double(c[1].j - c[0].j) * (last.i - c[0].i);
  return static_cast<int>(std::lround(std::log2(double(cell_steps)) - std::log2(std::abs(area)) / 2));
}

/// Cells of all addresses, polynomials and the rest.
void cut_addresses(const LimitSurface& surface, const Points& points, std::vector<CadCell>& exact,
                   std::vector<CadCell>& rest) {
  const AddressPieces pieces(surface, points);
  if (pieces.has_no_polynomials())
    throw UnsupportedTopology(
        "no piece of this scheme's limits is a polynomial, and B-splines are polynomials; catmull-clark, loop, "
        "doo-sabin, averaging and bilinear have them");
  constexpr std::int64_t addresses_a_block = 32;
  const Addresses& addresses = surface.addresses();
  std::vector<std::array<std::vector<CadCell>, 2>> blocks(size_t(num_blocks(addresses.size(), addresses_a_block)));
  parallel_for_blocks(
      addresses.size(),
      [&](std::int64_t block, std::int64_t begin, std::int64_t end) {
        auto& [own_exact, own_rest] = blocks[size_t(block)];
        CellCutter cutter(own_exact, own_rest);
        for (auto a = static_cast<Index>(begin); a < end; ++a)
          pieces.visit(a, [&](const PieceType& type, const Points& local, const CellCorners& corners) {
            CadCell cell{a, corners, depth_of(corners, addresses.triangles()), addresses.triangles()};
            if (addresses.place(a).corner >= 0) ++cell.depth;  // half an edge
            cell.type = &type;
            cell.points = local;
            cutter.cut(std::move(cell), first_quarterings);
          });
      },
      addresses_a_block);
  for (auto& [own_exact, own_rest] : blocks) {
    std::ranges::move(own_exact, std::back_inserter(exact));
    std::ranges::move(own_rest, std::back_inserter(rest));
  }
}

}  // namespace

LimitQuads limit_quads(const LimitSurface& surface, const Points& points, const LimitQuadOptions& options) {
  if (!(options.tolerance > 0) || !std::isfinite(options.tolerance))
    throw InvalidParameter("the tolerance is " + std::to_string(options.tolerance) + "; a distance above 0 is right");
  if (!points.allFinite()) throw InvalidParameter("points have to be finite");
  std::vector<CadCell> exact, rest;
  cut_addresses(surface, points, exact, rest);
  int degree = 3;
  for (const CadCell& cell : exact) degree = std::max(degree, cell.degree);
  const CapFitter fitter(surface, points, degree);
  LimitQuads result;
  std::vector<LimitQuad> caps;
  for (int round = 0; !rest.empty(); ++round) {
    if (options.progress) options.progress(round);
    const std::vector<LimitQuad> own = fitter.caps(rest);
    const std::vector<double> deviation = fitter.deviations(own);
    const size_t a_cell = own.size() / rest.size();
    const std::vector<size_t> group = groups_of(rest, LimitPatches::parts_of(surface));
    std::vector<double> largest(rest.size(), 0);
    std::vector<char> last(rest.size(), round >= options.most_rings);
    for (size_t c = 0; c < rest.size(); ++c) {
      for (size_t k = 0; k < a_cell; ++k) largest[group[c]] = std::max(largest[group[c]], deviation[c * a_cell + k]);
      if (!can_be_cut(rest[c])) last[group[c]] = 1;
    }
    std::vector<CadCell> next;
    CellCutter cutter(exact, next);
    for (size_t c = 0; c < rest.size(); ++c) {
      const double off = largest[group[c]];
      if (off > options.tolerance && !last[group[c]]) {
        cutter.cut_children(rest[c], 0);
        continue;
      }
      result.deviation = std::max(result.deviation, off);
      result.met = result.met && off <= options.tolerance;
      caps.insert(caps.end(), own.begin() + std::ptrdiff_t(c * a_cell), own.begin() + std::ptrdiff_t((c + 1) * a_cell));
    }
    rest = std::move(next);
  }
  ExactQuads thirds;
  for (const CadCell& cell : exact)
    for (LimitQuad& quad : thirds.of(cell)) result.quads.push_back(std::move(quad));
  result.caps = std::ssize(caps);
  std::ranges::move(caps, std::back_inserter(result.quads));
  std::int64_t number = -1;
  for (LimitQuad& quad : result.quads) quad.cell_number = quad.third > 0 ? number : ++number;
  return result;
}

}  // namespace sublimit
