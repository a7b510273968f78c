// SPDX-License-Identifier: Apache-2.0
#include "sublimit/limit/limit_integrals.h"

#include <Eigen/Dense>

#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <tuple>
#include <utility>
#include <vector>

#include "sublimit/base/error.h"
#include "sublimit/base/parallel_for.h"
#include "sublimit/limit/piece_parts.h"

namespace sublimit {
namespace {

/// Nodes and weights on [0, 1], exact up to degree 2n - 1: roots of Legendre polynomials, by Newton's method.
std::vector<std::pair<double, double>> gauss(int n) {
  std::vector<std::pair<double, double>> rule;
  for (int i = 0; i < n; ++i) {
    double x = std::cos(std::numbers::pi * (i + 0.75) / (n + 0.5)), slope = 1;
    for (int step = 0; step < 8; ++step) {
      double before = 1, value = x;
      for (int k = 2; k <= n; ++k) before = std::exchange(value, ((2 * k - 1) * x * value - (k - 1) * before) / k);
      slope = n * (x * value - before) / (x * x - 1);
      x -= value / slope;
    }
    rule.push_back({(1 - x) / 2, 1 / ((1 - x * x) * slope * slope)});
  }
  return rule;
}

/// The domain of a part: the square, its half u >= v or v >= u, or the triangle.
enum class Domain { square, right, left, triangle };

/// Values and derivatives at the nodes of a rule, by Bernstein coefficients.
struct Quadrature {
  Eigen::VectorXd weights;
  Eigen::MatrixXd x, u, v;
};

Quadrature quadrature(const PolynomialBasis& basis, const BernsteinNets& nets, Domain domain) {
  // Second moments have degree 5 d - 1 in each parameter, and one more where the square is collapsed to a triangle; of
  // halves all parameters together count.
  const int d = basis.degree(), degree = domain == Domain::square     ? 5 * d
                                         : domain == Domain::triangle ? 5 * d + 1
                                                                      : 10 * d;
  const auto rule = gauss(degree / 2 + 1);
  const Eigen::MatrixXd to_basis = nets.from_basis().inverse();
  const auto count = static_cast<Eigen::Index>(rule.size() * rule.size());
  Quadrature q{Eigen::VectorXd(count), Eigen::MatrixXd(count, basis.size()), Eigen::MatrixXd(count, basis.size()),
               Eigen::MatrixXd(count, basis.size())};
  Eigen::Index row = 0;
  for (const auto& [s, ws] : rule)
    for (const auto& [t, wt] : rule) {
      double u = s, v = t, weight = ws * wt;
      if (domain != Domain::square) {
        weight *= s;
        if (domain == Domain::triangle) u = s * (1 - t), v = s * t;
        if (domain == Domain::right) v = s * t;
        if (domain == Domain::left) u = s * t, v = s;
      }
      const RowMatrix rows = basis.at(u, v, 1);
      q.weights[row] = weight;
      q.x.row(row) = rows.row(0) * to_basis;
      q.u.row(row) = rows.row(1) * to_basis;
      q.v.row(row) = rows.row(2) * to_basis;
      ++row;
    }
  return q;
}

/// Sums of all parts. Second moments: xx, yy, zz, xy, yz, zx.
struct Moments {
  double area = 0, volume = 0;
  Eigen::Vector3d area_first = Eigen::Vector3d::Zero(), first = Eigen::Vector3d::Zero();
  Eigen::Matrix<double, 6, 1> second = Eigen::Matrix<double, 6, 1>::Zero();
  Moments& operator+=(const Moments& other) {
    area += other.area;
    volume += other.volume;
    area_first += other.area_first;
    first += other.first;
    second += other.second;
    return *this;
  }
};

class Integrator {
 public:
  /// @param centre  that moments are about
  Integrator(const Eigen::RowVector3d& centre, double size) : centre_(centre), size_(size) {}

  void add(const PieceType& type, const Points& points) {
    std::vector<PiecePart> parts;
    parts_.find(type, points, whole_cell(type.kind() == Piece::Kind::triangle), 1, parts);
    for (const PiecePart& part : parts) {
      if (part.polynomial) {
        add(part);
        continue;
      }
      const double across = (part.points.colwise().maxCoeff() - part.points.colwise().minCoeff()).norm();
      if (across > 1e-8 * size_) add(*part.type, part.points);
    }
  }
  const Moments& sum() const { return sum_; }

 private:
  void add(const PiecePart& part) {
    const PolynomialBasis& basis = part.polynomial->basis;
    const bool halves = part.nets.size() > 1;
    for (size_t k = 0; k < part.nets.size(); ++k) {
      const Domain domain = basis.total() ? Domain::triangle
                            : !halves     ? Domain::square
                            : k == 0      ? Domain::right
                                          : Domain::left;
      const Points net = part.nets[k].rowwise() - centre_;
      const Quadrature& q = rule(basis, domain);
      const Points x = q.x * net, u = q.u * net, v = q.v * net;
      Moments m;
      Area area;
      for (Eigen::Index i = 0; i < x.rows(); ++i) {
        const Eigen::Vector3d p = x.row(i),
                              n = q.weights[i] * Eigen::Vector3d(u.row(i)).cross(Eigen::Vector3d(v.row(i)));
        area.add(p, n);
        m.volume += p.dot(n) / 3;
        m.first += p.cwiseProduct(p).cwiseProduct(n) / 2;
        for (int a = 0; a < 3; ++a) {
          const int b = (a + 1) % 3;
          m.second[a] += p[a] * p[a] * p[a] * n[a] / 3;
          m.second[3 + a] += p[a] * p[a] * p[b] * n[a] / 2;
        }
      }
      area = refined(basis, domain, net, area, 0);
      m.area = area.size;
      m.area_first = area.first;
      sum_ += m;
    }
  }

  struct Area {
    double size = 0;
    Eigen::Vector3d first = Eigen::Vector3d::Zero();
    void add(const Eigen::Vector3d& p, const Eigen::Vector3d& n) {
      size += n.norm();
      first += n.norm() * p;
    }
  };
  Area area_of(const PolynomialBasis& basis, Domain domain, const Points& net) {
    const Quadrature& q = rule(basis, domain);
    const Points x = q.x * net, u = q.u * net, v = q.v * net;
    Area area;
    for (Eigen::Index i = 0; i < x.rows(); ++i)
      area.add(x.row(i), q.weights[i] * Eigen::Vector3d(u.row(i)).cross(Eigen::Vector3d(v.row(i))));
    return area;
  }
  /// Until the quarters have the same area together.
  Area refined(const PolynomialBasis& basis, Domain domain, const Points& net, const Area& known, int depth) {
    if (domain == Domain::right || domain == Domain::left) {  // no quarters of their own
      return known;
    }
    constexpr double accuracy = 1e-12;
    std::array<Points, 4> nets;
    std::array<Area, 4> areas;
    Area together;
    for (int k = 0; k < 4; ++k) {
      nets[size_t(k)] = parts_.nets(basis).quarter(k) * net;
      areas[size_t(k)] = area_of(basis, domain, nets[size_t(k)]);
      together.size += areas[size_t(k)].size;
      together.first += areas[size_t(k)].first;
    }
    const double off = std::abs(together.size - known.size);
    if (off <= accuracy * together.size || off <= 1e-17 * size_ * size_ || depth == 16) return together;
    together = {};
    for (int k = 0; k < 4; ++k) {
      const Area area = refined(basis, domain, nets[size_t(k)], areas[size_t(k)], depth + 1);
      together.size += area.size;
      together.first += area.first;
    }
    return together;
  }

  const Quadrature& rule(const PolynomialBasis& basis, Domain domain) {
    const auto key = std::tuple{basis.degree(), basis.total(), domain};
    if (const auto at = rules_.find(key); at != rules_.end()) return at->second;
    return rules_.emplace(key, quadrature(basis, parts_.nets(basis), domain)).first->second;
  }

  Eigen::RowVector3d centre_;
  double size_;
  PieceParts parts_;
  std::map<std::tuple<int, bool, Domain>, Quadrature> rules_;
  Moments sum_;
};

bool is_closed(const Level& level) {
  const Topology& t = level.topology();
  for (Index f = 0; f < t.num_faces(); ++f)
    if (level.holes[size_t(f)]) return false;
  for (Index h = 0; h < t.num_half_edges(); ++h)
    if (!exists(t.twin(HalfEdge{h}))) return false;
  return t.num_faces() > 0;
}

}  // namespace

LimitIntegrals limit_integrals(const LimitSurface& surface, const Points& points) {
  const AddressPieces pieces(surface, points);
  if (pieces.has_no_polynomials())
    throw UnsupportedTopology(pieces.scheme() +
                              ": no piece of its limits is a polynomial, and integrals of others are not known");
  LimitIntegrals result;
  if (points.rows() == 0) return result;
  const Eigen::RowVector3d low = points.colwise().minCoeff(), high = points.colwise().maxCoeff(),
                           centre = (low + high) / 2;
  const double size = (high - low).norm();
  constexpr std::int64_t addresses_a_block = 32;
  const Index addresses = surface.addresses().size();
  std::vector<Moments> blocks(size_t(num_blocks(addresses, addresses_a_block)));
  parallel_for_blocks(
      addresses,
      [&](std::int64_t block, std::int64_t begin, std::int64_t end) {
        Integrator integrator(centre, size);
        for (std::int64_t a = begin; a < end; ++a)
          pieces.visit(static_cast<Index>(a), [&](const PieceType& type, const Points& local, const CellCorners&) {
            integrator.add(type, local);
          });
        blocks[size_t(block)] = integrator.sum();
      },
      addresses_a_block);
  Moments all;
  for (const Moments& block : blocks) all += block;
  result.area = all.area;
  if (all.area > 0) result.area_centroid = all.area_first / all.area + centre.transpose();
  if (!is_closed(surface.level()) || all.volume == 0) return result;
  LimitIntegrals::Solid solid;
  solid.volume = all.volume;
  const Eigen::Vector3d c = all.first / all.volume;
  solid.centroid = c + centre.transpose();
  Eigen::Matrix3d second;
  second << all.second[0], all.second[3], all.second[5], all.second[3], all.second[1], all.second[4], all.second[5],
      all.second[4], all.second[2];
  second -= all.volume * c * c.transpose();
  solid.inertia = second.trace() * Eigen::Matrix3d::Identity() - second;
  result.solid = solid;
  return result;
}

}  // namespace sublimit
