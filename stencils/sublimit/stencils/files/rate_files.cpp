// SPDX-License-Identifier: Apache-2.0
#include "sublimit/stencils/files/rate_files.h"

#include <algorithm>
#include <map>
#include <utility>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/error.h"
#include "sublimit/stencils/formats/csv_rows.h"

namespace sublimit {

std::vector<Index> read_edge_rates(const std::filesystem::path& path, const Topology& topology) {
  constexpr std::int64_t largest_rate = 1 << 22;
  std::map<std::pair<std::int64_t, std::int64_t>, Index> edges;
  for (Index e = 0; e < topology.num_edges(); ++e)
    edges[std::minmax<std::int64_t>(index(topology.tail(Edge{e})), index(topology.head(Edge{e})))] = e;
  CsvRows rows(path, {"v0", "v1", "rate"});
  std::vector<Index> rates(size_t(topology.num_edges()), 0);
  const std::string vertices = "vertices are 0 to " + format_number(topology.num_vertices() - 1);
  while (rows.next()) {
    const std::int64_t a = rows.integer(0, vertices), b = rows.integer(1, vertices),
                       rate = rows.integer(2, "rates are 1 to 4194304");
    const auto edge = edges.find(std::minmax(a, b));
    if (edge == edges.end())
      throw FormatError(rows.place() + "no face has an edge from " + format_number(a) + " to " + format_number(b));
    if (rate < 1 || rate > largest_rate)
      throw FormatError(rows.place() + "the rate is " + format_number(rate) + "; rates are 1 to 4194304");
    Index& known = rates[size_t(edge->second)];
    if (known > 0) throw FormatError(rows.place() + "this edge has a rate already; leave one of the rows out");
    known = static_cast<Index>(rate);
  }
  std::ranges::replace(rates, Index{0}, Index{1});
  return rates;
}

}  // namespace sublimit
