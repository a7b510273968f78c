// SPDX-License-Identifier: Apache-2.0
#include "sublimit/cad/limit_quads.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/detail/parallel_for.h"
#include "sublimit/base/error.h"
#include "sublimit/cad/cad_cells.h"
#include "sublimit/cad/cap_fitter.h"
#include "sublimit/cad/signed_classes.h"
#include "sublimit/cad/triangle_thirds.h"
#include "sublimit/core/detail/finite_points.h"
#include "sublimit/nets/place_numbers.h"
#include "sublimit/surface/detail/limit_patches.h"

namespace sublimit {
namespace {

/// Extraordinary vertices are apart from each other after two quarterings, whatever faces they share.
constexpr int first_quarterings = 2;
/// Sharpness below 10 is gone after so many.
constexpr int most_decaying = 10;
/// Cells keep whole steps between their corners, the middles of their sides, and the middles of these.
constexpr std::int32_t least_steps = 8;

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
    if (const auto at = thirds_.find(degree); at != thirds_.end()) return at->second;
    std::array<Eigen::MatrixXd, 3>& nets = thirds_[degree];
    const PolynomialBasis basis(degree, true);
    const std::array<Eigen::MatrixXd, 3> thirds = triangle_thirds(degree);
    const int n = degree + 1;
    for (size_t k = 0; k < 3; ++k) {
      nets[k].resize(n * n, basis.size());
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j)  // here v is the faster one
          for_each_net_row(basis, [&](int a, int b, Eigen::Index column) {
            nets[k](i * n + j, column) = thirds[k](i + n * j, net_row(basis, b, a));
          });
    }
    return nets;
  }

 private:
  std::map<int, std::array<Eigen::MatrixXd, 3>> thirds_;
};

/// Numbers of the groups of cells that share corners: those around one extraordinary vertex.
std::vector<size_t> groups_of(const std::vector<CadCell>& cells, const LimitMap::Parts& parts) {
  SignedClasses classes(cells.size());
  PlaceNumbers places(parts);
  std::vector<size_t> first;
  for (size_t c = 0; c < cells.size(); ++c)
    for (size_t k = 0; k < (cells[c].triangle ? 3u : 4u); ++k) {
      const auto place = size_t(places.add(cells[c].address, cells[c].corners[k]));
      if (place == first.size()) first.push_back(c);
      classes.join(first[place], c);
    }
  std::vector<size_t> groups;
  for (size_t c = 0; c < cells.size(); ++c) groups.push_back(classes.find(c).first);
  return groups;
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
void cut_addresses(const LimitMap& surface, const Points& points, std::vector<CadCell>& exact,
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

LimitQuads limit_quads(const LimitMap& surface, const Points& points, const LimitQuadOptions& options) {
  if (!(options.tolerance > 0) || !std::isfinite(options.tolerance))
    throw InvalidParameter("the tolerance is " + format_number(options.tolerance) + "; a distance above 0 is right");
  check_measurable_control(points);
  if (options.join_smoothly && surface.addresses().triangles())
    throw UnsupportedTopology("caps of triangles join by g0; g1 is for schemes of quadrilaterals");
  std::vector<CadCell> exact, rest;
  cut_addresses(surface, points, exact, rest);
  int degree = 3;
  for (const CadCell& cell : exact) degree = std::max(degree, cell.degree);
  const CapFitter fitter(surface, points, degree);
  LimitQuads result;
  std::vector<LimitQuad> caps;
  for (int round = 0; !rest.empty(); ++round) {
    if (options.progress) options.progress(round);
    const std::vector<size_t> group = groups_of(rest, surface.parts());
    std::vector<LimitQuad> own = fitter.caps(rest, group);
    if (options.join_smoothly) fitter.join(rest, group, own);
    const std::vector<double> deviation = fitter.deviations(own);
    const size_t a_cell = own.size() / rest.size();
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
