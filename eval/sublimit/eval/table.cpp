// SPDX-License-Identifier: Apache-2.0
#include "sublimit/eval/table.h"

#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "sublimit/base/error.h"
#include "sublimit/eval/evaluate/evaluation.h"

namespace sublimit {
namespace {

void check_length(const char* what, size_t given, size_t needed) {
  if (given != needed)
    throw InvalidParameter(std::string(what) + " hold " + std::to_string(given) + " numbers; " +
                           std::to_string(needed) + " are right");
}

void check_frame(const Table& table, size_t points, int channels, size_t result) {
  check_length("results", result, table.num_results(channels));
  check_length("points", points, size_t(table.num_control_points()) * size_t(channels));
}

/// What a table is to make of one frame, whose lengths are right.
template <class Real>
Evaluation<Real> frame_of(const BakedTable<Real>& table, std::span<const Real> points, int channels,
                          std::span<Real> result) {
  Evaluation<Real> frame;
  frame.channels = channels;
  frame.points = points;
  frame.rational = table.info.rational;
  if (frame.rational) frame.least_weight = noise_of_weights(frame, table.table.num_control_points());
  const auto quantities = size_t(table.table.quantities()), made = result.size() / quantities;
  for (size_t k = 0; k < quantities; ++k) frame.quantities[k] = result.subspan(k * made, made);
  return frame;
}

template <class To, class From>
std::vector<To> converted(std::span<const From> numbers) {
  return {numbers.begin(), numbers.end()};
}

}  // namespace

struct Table::Prepared {
  AnyTable baked;
  std::optional<PatternEvaluator<float>> of_float;  // one of both, of `baked`
  std::optional<PatternEvaluator<double>> of_double;

  explicit Prepared(AnyTable table) : baked(std::move(table)) {
    if (const auto* all = std::get_if<BakedTable<float>>(&baked)) of_float.emplace(all->table);
    if (const auto* all = std::get_if<BakedTable<double>>(&baked)) of_double.emplace(all->table);
  }
  Prepared(const Prepared&) = delete;

  /// Returns what a function makes of the table and its evaluator.
  template <class Use>
  auto visit(const Use& use) const {
    return of_float ? use(std::get<BakedTable<float>>(baked), *of_float)
                    : use(std::get<BakedTable<double>>(baked), *of_double);
  }

  template <class Real>
  void apply(std::span<const Real> points, int channels, std::span<Real> result) const {
    visit([&](const auto& table, const auto& evaluator) {
      using Own = std::decay_t<decltype(table.table.arrays().weights[0])>;
      if constexpr (std::is_same_v<Own, Real>) {
        evaluator.apply(frame_of(table, points, channels, result));
      } else {
        std::vector<Own> made(result.size());
        apply<Own>(converted<Own>(points), channels, made);
        for (size_t i = 0; i < made.size(); ++i) result[i] = static_cast<Real>(made[i]);
      }
    });
  }

  template <class Real>
  void apply_transpose(std::span<const Real> values, int channels, std::span<Real> result) const {
    visit([&](const auto& table, const auto& evaluator) {
      using Own = std::decay_t<decltype(table.table.arrays().weights[0])>;
      if constexpr (std::is_same_v<Own, Real>) {
        evaluator.apply_transpose(values, channels, result);
      } else {
        std::vector<Own> made(result.size());
        evaluator.apply_transpose(converted<Own>(values), channels, made);
        for (size_t i = 0; i < made.size(); ++i) result[i] = static_cast<Real>(made[i]);
      }
    });
  }
};

Table::Table(AnyTable table) : prepared_(std::make_shared<const Prepared>(std::move(table))) {}

std::int32_t Table::num_control_points() const {
  return prepared_->visit([](const auto& table, const auto&) { return table.table.num_control_points(); });
}
std::int64_t Table::num_points() const {
  return prepared_->visit([](const auto& table, const auto&) { return table.table.num_points(); });
}
int Table::quantities() const {
  return prepared_->visit([](const auto& table, const auto&) { return int(table.table.quantities()); });
}
const TableInfo& Table::info() const& {
  return *prepared_->visit([](const auto& table, const auto&) { return &table.info; });
}
bool Table::is_double() const { return prepared_->of_double.has_value(); }
FaceList Table::faces() const {
  return prepared_->visit([](const auto& table, const auto&) { return faces_of(table); });
}
std::span<const std::int64_t> Table::refined_points() const {
  return std::visit([](const auto& table) { return table.refined_points.span(); }, prepared_->baked);
}
const AnyTable& Table::baked() const { return prepared_->baked; }

size_t Table::num_results(int channels) const {
  const int least = info().rational ? 2 : 1;
  if (channels < least)
    throw InvalidParameter("channels are " + std::to_string(channels) + "; " + std::to_string(least) +
                           " and more are right");
  return size_t(quantities()) * size_t(num_points()) * size_t(channels - (least - 1));
}

void Table::apply(std::span<const float> points, int channels, std::span<float> result) const {
  check_frame(*this, points.size(), channels, result.size());
  prepared_->apply(points, channels, result);
}
void Table::apply(std::span<const double> points, int channels, std::span<double> result) const {
  check_frame(*this, points.size(), channels, result.size());
  prepared_->apply(points, channels, result);
}

void Table::apply_transpose(std::span<const float> values, int channels, std::span<float> result) const {
  prepared_->apply_transpose(values, channels, result);
}
void Table::apply_transpose(std::span<const double> values, int channels, std::span<double> result) const {
  prepared_->apply_transpose(values, channels, result);
}

template <class Real>
const PatternEvaluator<Real>& Table::evaluator() const {
  constexpr bool wants_double = std::is_same_v<Real, double>;
  if (wants_double != is_double())
    throw InvalidParameter(std::string("the table's weights are ") + (is_double() ? "double" : "float") + ", not " +
                           (wants_double ? "double" : "float"));
  if constexpr (wants_double)
    return *prepared_->of_double;
  else
    return *prepared_->of_float;
}
template const PatternEvaluator<float>& Table::evaluator<float>() const;
template const PatternEvaluator<double>& Table::evaluator<double>() const;

void Table::save(const std::filesystem::path& path) const {
  prepared_->visit([&](const auto& table, const auto&) { save_table(path, table); });
}

template <class Real>
TableFrame<Real>::TableFrame(const Table& table, std::span<const Real> points, int channels, std::span<Real> result)
    : table_(table) {
  const PatternEvaluator<Real>& evaluator = table_.evaluator<Real>();
  check_frame(table_, points.size(), channels, result.size());
  frame_ = frame_of(std::get<BakedTable<Real>>(table_.baked()), points, channels, result);
  inputs_.resize(size_t(evaluator.num_inputs(frame_)));
  if (!inputs_.empty()) evaluator.apply_first(frame_, inputs_);
}

template <class Real>
void TableFrame<Real>::apply_part(int part, int parts) const {
  if (parts < 1) throw InvalidParameter("a frame in " + std::to_string(parts) + " parts; 1 and more are right");
  if (part < 0 || part >= parts)
    throw InvalidParameter("part " + std::to_string(part) + " of " + std::to_string(parts) + "; 0 to " +
                           std::to_string(parts - 1) + " are right");
  const PatternEvaluator<Real>& evaluator = table_.evaluator<Real>();
  const std::int64_t patches = evaluator.num_patches();
  evaluator.apply_patches(frame_, inputs_, patches * part / parts, patches * (part + 1) / parts);
}

template <class Real>
void TableFrame<Real>::finish() const {
  table_.evaluator<Real>().apply_rest(frame_, inputs_);
}

template class TableFrame<float>;
template class TableFrame<double>;

Table load(const std::filesystem::path& path, const LoadOptions& options) { return Table(load_table(path, options)); }

}  // namespace sublimit
