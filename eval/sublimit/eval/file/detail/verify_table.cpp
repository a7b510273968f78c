// SPDX-License-Identifier: Apache-2.0
#include "sublimit/eval/file/detail/verify_table.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>
#include <set>
#include <utility>
#include <variant>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/detail/mapped_file.h"
#include "sublimit/base/error.h"
#include "sublimit/eval/file/detail/safetensors.h"
#include "sublimit/eval/file/detail/table_tensors.h"
#include "sublimit/eval/file/table_file.h"

namespace sublimit {
namespace {

/// Of findings alike, so many are told one by one.
constexpr std::int64_t told = 5;

template <class Real>
class Verifier {
 public:
  Verifier(const Safetensors& file, const BakedTable<Real>& table, Verification& out)
      : file_(file), baked_(table), a_(table.table.arrays()), out_(out) {}

  void verify() {
    checksums();
    known_arrays();
    sums_of_blocks();
    if (a_.first) sums("first", *a_.first, a_.first->num_rows(), {});
    if (a_.rest) sums("rest", *a_.rest, a_.rest->num_rows() / a_.quantities, baked_.rest_status);
    points_made();
    copies();
    unused();
  }

 private:
  void find(std::string what) { out_.findings.push_back(std::move(what)); }

  /// Findings of one kind.
  class Kind {
   public:
    Kind(Verifier& verifier, std::string more) : verifier_(verifier), more_(std::move(more)) {}
    Kind(const Kind&) = delete;
    Kind& operator=(const Kind&) = delete;
    ~Kind() {
      if (count_ > told) verifier_.find(std::to_string(count_ - told) + more_);
    }
    /// @param what  makes the text, which most of many findings do not need
    template <class What>
    void add(const What& what) {
      if (count_++ < told) verifier_.find(what());
    }

   private:
    Verifier& verifier_;
    std::string more_;
    std::int64_t count_ = 0;
  };

  void checksums() {
    // Reading has compared the one of the header.
    if (file_.metadata.count("header_checksum") != 0)
      ++out_.checksums;
    else
      find("header: it has no checksum");
    for (const Tensor& tensor : file_.tensors) {
      const std::optional<bool> matches = matches_checksum(file_, tensor);
      if (matches) ++out_.checksums;
      if (!matches) find("'" + tensor.name + "': it has no checksum");
      if (matches == false) find("'" + tensor.name + "': its checksum does not match");
    }
  }

  void known_arrays() {
    std::set<std::string> known;
    const TableTensors written(baked_);
    for (const Tensor& tensor : written.file().tensors) known.insert(tensor.name);
    for (const Tensor& tensor : file_.tensors)
      if (known.count(tensor.name) == 0)
        find("'" + tensor.name + "': no part of a table, " + std::to_string(tensor.bytes.size()) + " bytes");
  }

  /// One row's sum: 1 of positions, 0 of derivatives. Where there is no surface, nothing is 0 too.
  template <class Where>
  void sum(Kind& kind, std::span<const Real> weights, int quantity, bool may_be_absent, const Where& where) {
    ++out_.rows;
    double total = 0, size = 0;
    for (const Real weight : weights) total += double(weight), size += std::abs(double(weight));
    if (may_be_absent && size == 0) return;
    const double right = quantity == 0 ? 1 : 0;
    // Of their size: what bakes promise in double, or rounding to float. Where a derivative vanishes, rounding is all
    // that is left, of weights that were about 1.
    constexpr double in_double[] = {1e-12, 1e-11, 1e-11, 1e-9, 1e-9, 1e-9};
    const double rounding = 64 * double(std::numeric_limits<Real>::epsilon());
    const double tolerance = std::max(in_double[quantity], rounding) * std::max(size, 1.0);
    if (std::abs(total - right) > tolerance)
      kind.add([&] {
        return where() + ": weights of " + (quantity == 0 ? "a position" : "a derivative") + " sum to " +
               format_number(total);
      });
  }

  bool no_surface(std::uint8_t status) const {
    const std::string& word = baked_.info.statuses[status];
    return word == "hole" || word == "outside";
  }

  /// Weights of each block: begin, end.
  std::vector<std::pair<std::int64_t, std::int64_t>> block_ranges() const {
    std::vector<std::pair<std::int64_t, std::int64_t>> ranges;
    for (const auto& b : a_.blocks)
      ranges.push_back({b.weights, b.weights + std::int64_t{b.rows} * b.columns * a_.quantities});
    std::sort(ranges.begin(), ranges.end());
    return ranges;
  }

  bool blocks_overlap() const {
    const auto ranges = block_ranges();
    return std::adjacent_find(ranges.begin(), ranges.end(),
                              [](const auto& x, const auto& y) { return y.first < x.second; }) != ranges.end();
  }

  void sums_of_blocks() {
    if (blocks_overlap()) return find("'blocks': two of them have the same weights");
    std::vector<std::vector<bool>> made(a_.blocks.size());  // rows of blocks that some group makes
    Kind kind(*this, " more rows of 'weights' have the wrong sum");
    for (const auto& group : a_.groups) {
      const auto& block = a_.blocks[group.block];
      std::vector<bool>& used = made[size_t(group.block)];
      used.resize(size_t(block.rows));
      for (std::int64_t at = group.rows; at < group.rows + group.num_rows; ++at) {
        const std::int32_t row = a_.rows[at];
        if (used[row]) continue;
        used[row] = true;
        const bool absent = !baked_.row_status.empty() && no_surface(baked_.row_status[at]);
        for (int q = 0; q < a_.quantities; ++q)
          sum(kind,
              a_.weights.span().subspan(size_t(block.weights + (std::int64_t{q} * block.rows + row) * block.columns),
                                        size_t(block.columns)),
              q, absent, [&] {
                return "'weights': row " + std::to_string(row) + " of block " + std::to_string(group.block) +
                       ", quantity " + std::to_string(q);
              });
      }
    }
    for (size_t b = 0; b < a_.blocks.size(); ++b) {
      const auto used = std::count(made[b].begin(), made[b].end(), true);
      out_.spare_bytes +=
          (a_.blocks[b].rows - used) * a_.blocks[b].columns * a_.quantities * std::int64_t(sizeof(Real));
    }
  }

  /// @param per_quantity  rows that are positions, then as many of each derivative
  void sums(const std::string& name, const StencilTable<Real>& table, std::int64_t per_quantity,
            std::span<const std::uint8_t> status) {
    Kind kind(*this, " more rows of '" + name + ".weights' have the wrong sum");
    for (std::int64_t row = 0; row < table.num_rows(); ++row) {
      const std::int64_t begin = table.offsets()[row], end = table.offsets()[row + 1];
      const bool absent = !status.empty() && no_surface(status[size_t(row % per_quantity)]);
      sum(kind, table.weights().span().subspan(size_t(begin), size_t(end - begin)),
          static_cast<int>(row / per_quantity), absent,
          [&] { return "'" + name + ".weights': row " + std::to_string(row); });
    }
  }

  /// Those of patches lie beside each other, without overlap: as many as there are places for them.
  void points_made() {
    out_.points = baked_.table.num_points();
    if (a_.patch_points.empty()) return;
    std::vector<std::pair<std::int64_t, std::int64_t>> runs;  // begin, end
    runs.reserve(a_.patch_points.size());
    baked_.table.for_each_run(0, baked_.table.num_patches(), [&](size_t g, std::int64_t first, std::int64_t count) {
      for (std::int64_t patch = first; patch < first + count; ++patch)
        runs.push_back({a_.patch_points[patch], a_.patch_points[patch] + a_.groups[g].num_rows});
    });
    std::sort(runs.begin(), runs.end());
    Kind kind(*this, " more patches have points that others have too");
    std::int64_t at = 0;
    for (const auto& run : runs) {
      if (run.first < at)
        kind.add([&] { return "'patch_points': point " + std::to_string(run.first) + " is made by two patches"; });
      at = std::max(at, run.second);
    }
  }

  void copies() {
    std::vector<std::int32_t> to;
    to.reserve(a_.copies.size() / 2);
    for (size_t i = 0; i < a_.copies.size(); i += 2) to.push_back(a_.copies[i]);
    std::sort(to.begin(), to.end());
    Kind kind(*this, " more such points in 'copies'");
    for (size_t i = 1; i < to.size(); ++i)
      if (to[i] == to[i - 1])
        kind.add([&] { return "'copies': point " + std::to_string(to[i]) + " is a copy of two"; });
    for (size_t i = 1; i < a_.copies.size(); i += 2)
      if (std::binary_search(to.begin(), to.end(), a_.copies[i]))
        kind.add([&] { return "'copies': point " + std::to_string(a_.copies[i]) + " is a copy, and copied"; });
  }

  /// Entries between begin and end of an array that none of the ranges has.
  static std::int64_t gaps(std::vector<std::pair<std::int64_t, std::int64_t>> ranges, size_t size) {
    std::sort(ranges.begin(), ranges.end());
    std::int64_t gaps = 0, at = 0;
    for (const auto& [begin, end] : ranges) {
      gaps += std::max<std::int64_t>(begin - at, 0);
      at = std::max(at, end);
    }
    return gaps + std::int64_t(size) - at;
  }

  void unused() {
    std::vector<std::pair<std::int64_t, std::int64_t>> rows;
    for (const auto& g : a_.groups) rows.push_back({g.rows, g.rows + g.num_rows});
    if (const std::int64_t count = gaps(block_ranges(), a_.weights.size()); count > 0)
      find("'weights': " + std::to_string(count) + " of them are in no block");
    if (const std::int64_t count = gaps(rows, a_.rows.size()); count > 0)
      find("'rows': " + std::to_string(count) + " of them are in no group");
    std::vector<bool> used(a_.blocks.size());
    for (const auto& g : a_.groups) used[size_t(g.block)] = true;
    for (size_t b = 0; b < used.size(); ++b)
      if (!used[b]) find("'blocks': no group uses block " + std::to_string(b));
  }

  const Safetensors& file_;
  const BakedTable<Real>& baked_;
  const typename PatternTable<Real>::Arrays& a_;
  Verification& out_;
};

}  // namespace

Verification verify_table(std::span<const std::byte> bytes, const std::string& name) {
  try {
    Verification out;
    const Safetensors file = read_safetensors(bytes, name);
    out.bytes = std::int64_t(bytes.size());
    out.arrays = std::int64_t(file.tensors.size());
    std::visit([&]<class Real>(const BakedTable<Real>& table) { Verifier<Real>(file, table, out).verify(); },
               load_table(bytes, name));
    return out;
  } catch (const std::bad_alloc&) {
    throw ResourceError(name + ": does not fit into memory");
  }
}

Verification verify_table(const std::filesystem::path& path) {
  const MappedFile file = map_file(path);
  return verify_table(file.bytes, path.string());
}

}  // namespace sublimit
