// SPDX-License-Identifier: Apache-2.0
#include "sublimit/certificates/spectra/exact_schemes.h"
#include "sublimit/report/analysis/registered_rows.h"

#include <fmt/core.h>

#include <algorithm>
#include <map>

#include "sublimit/base/error.h"

namespace sublimit::report {
namespace {

using Json = nlohmann::ordered_json;
using Row = std::map<SectorLabel, Algebraic>;

Row row_in(const Json& witness_row) {
  Row row;
  for (const Json& w : witness_row.at("weights"))
    row[{w.at(0).get<int>(), w.at(1).get<int>(), w.at(2).get<int>()}] = Algebraic::parse(w.at(3).get<std::string>());
  return row;
}

Row row_of(const LocalPatch<Algebraic>& patch, size_t i) {
  Row row;
  for (size_t j = 0; j < patch.labels.size(); ++j) {
    const Algebraic& weight = patch.A(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
    if (!weight.is_zero()) row[patch.labels[j]] = weight;
  }
  return row;
}

std::string text_of(const Json& at) { return fmt::format("({}, {})", at.at(0).dump(), at.at(1).dump()); }

}  // namespace

std::optional<ExactScheme> registered_scheme(const std::string& name, const SchemeOptions& options) {
  try {
    std::optional<Scheme<Algebraic>> scheme = find_scheme<Algebraic>(name, options);
    if (!scheme) return std::nullopt;
    RegularMask<Algebraic> mask = regular_mask(*scheme);
    return ExactScheme{std::move(*scheme), std::move(mask)};
  } catch (const Error&) {  // options that it does not have, or no one mask
    return std::nullopt;
  }
}

std::string differs_from(const ExactScheme& exact, const Json& witness) {
  std::map<LatticePoint, Algebraic> mask;
  for (const Json& m : witness.at("mask"))
    mask[{m.at(0).get<int>(), m.at(1).get<int>()}] = Algebraic::parse(m.at(2).get<std::string>());
  if (mask != exact.mask.plane_weights()) return "its mask is not that of the scheme on regular meshes";

  int reach2 = 2;  // of labels, in half edges
  for (const Json& row : witness.at("rows"))
    for (const Json& x2 : row.at("at")) reach2 = std::max(reach2, x2.get<int>());
  const bool dual = exact.mask.dual;
  const auto patch = local_patch(
      exact.scheme, {.kind = dual ? Centre::Kind::face : Centre::Kind::vertex, .faces = witness.at("n").get<int>()},
      (reach2 + 1) / 2);
  if (!patch) return "the scheme has no such neighbourhood";
  for (const Json& row : witness.at("rows")) {
    const SectorLabel at{0, row.at("at").at(0).get<int>(), row.at("at").at(1).get<int>()};
    const auto found = std::find(patch->labels.begin(), patch->labels.end(), at);
    if (found == patch->labels.end()) return fmt::format("the scheme has no point at {}", text_of(row.at("at")));
    if (row_in(row) != row_of(*patch, static_cast<size_t>(found - patch->labels.begin())))
      return fmt::format("its row for the point at {} is not that of the scheme", text_of(row.at("at")));
  }
  return "";
}

}  // namespace sublimit::report
