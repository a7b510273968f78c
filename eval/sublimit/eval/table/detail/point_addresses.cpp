// SPDX-License-Identifier: Apache-2.0
#include "sublimit/eval/table/detail/point_addresses.h"

#include <array>
#include <utility>

#include "sublimit/base/detail/parallel_for.h"

namespace sublimit {
namespace {

/// (i, j) of each row of a lattice.
std::vector<std::array<std::int32_t, 2>> nodes_of(const Lattice& lattice) {
  std::vector<std::array<std::int32_t, 2>> nodes;
  nodes.reserve(size_t(lattice.size()));
  lattice.for_each([&](std::int32_t i, std::int32_t j) { nodes.push_back({i, j}); });
  return nodes;
}

}  // namespace

template <class Real>
SampleAddresses addresses_of(const BakedTable<Real>& table) {
  if (table.info.rows == TableRows::samples) return table.addresses;
  const bool grid = table.info.rows == TableRows::grid;
  if (!grid && !(table.lattices && table.lattices->has_addresses())) return {};
  const auto count = static_cast<size_t>(table.table.num_points());
  std::vector<std::int32_t> faces(count, -1);
  std::vector<double> parameters(2 * count, 0);
  const auto set = [&](std::int64_t point, std::int32_t face, double u, double v) {
    faces[size_t(point)] = face;
    parameters[2 * size_t(point)] = u;
    parameters[2 * size_t(point) + 1] = v;
  };
  if (grid) {
    const Lattice lattice{table.info.grid - 1, table.info.triangles};
    const auto nodes = nodes_of(lattice);
    const std::int64_t size = lattice.size();
    parallel_for(std::int64_t(count) / size, [&](std::int64_t face) {
      for (std::int64_t row = 0; row < size; ++row) {
        const double u = double(nodes[size_t(row)][0]) / lattice.n, v = double(nodes[size_t(row)][1]) / lattice.n;
        // A rounded sum must not leave the triangle.
        set(face * size + row, static_cast<std::int32_t>(face), lattice.triangle && u + v > 1 ? 1 - v : u, v);
      }
    });
    return {std::move(faces), std::move(parameters)};
  }
  const FaceLattices& lattices = *table.lattices;
  const auto nodes = nodes_of(lattices.lattice());
  std::array<std::vector<std::int32_t>, 256> rows;  // by share, of those that there are
  std::array<bool, 256> known{};
  for (std::int32_t f = 0; f < lattices.num_faces(); ++f) {
    const std::uint8_t share = FaceLattices::share(lattices.arrays(), f);
    if (!std::exchange(known[share], true)) rows[share] = LatticeRanks::rows(lattices.lattice(), share);
  }
  parallel_for(lattices.num_faces(), [&](std::int64_t at) {
    const auto f = static_cast<std::int32_t>(at);
    std::int64_t point = lattices.arrays().first_points[f];
    const std::int32_t address = lattices.place(f).address;
    for (const std::int32_t row : rows[FaceLattices::share(lattices.arrays(), f)]) {
      const AddressParameters p = lattices.parameters(f, nodes[size_t(row)][0], nodes[size_t(row)][1]);
      set(point++, address, p.u, p.v);
    }
  });
  return {std::move(faces), std::move(parameters)};
}

template SampleAddresses addresses_of(const BakedTable<float>&);
template SampleAddresses addresses_of(const BakedTable<double>&);

}  // namespace sublimit
