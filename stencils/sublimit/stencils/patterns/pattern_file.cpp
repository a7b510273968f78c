// SPDX-License-Identifier: Apache-2.0
#include "sublimit/stencils/patterns/pattern_file.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <type_traits>

#include "sublimit/base/detail/read_file.h"
#include "sublimit/base/error.h"
#include "sublimit/eval/file/detail/safetensors.h"
#include "sublimit/eval/table/pattern_table.h"
#include "sublimit/scheme/detail/prepare.h"
#include "sublimit/stencils/patterns/demo_mesh.h"

namespace sublimit {
namespace {

constexpr const char* format = "sublimit-dictionary";
constexpr const char* schema_version = "3";

// Arrays of a file; each pattern's parts follow those of the pattern before.
//   patterns    P x 6: kind, points, decays, numbers of signatures, of matrices of rows, of blocks of limits
//   signatures  turn, number of words          words     all words
//   rows        levels, ends, rows             limits    cells a side, turn, quarter, order of points, derivatives
//   weights     of rows, then of limits        status    of limits
constexpr int pattern_columns = 6, row_columns = 3, limit_columns = 5;
/// A matrix is of level 11 at most.
constexpr std::int64_t last_level = 11, last_n = 1 << last_level;

/// Numbers of an array, taken one after the other.
template <class T>
class Reader {
 public:
  Reader(const Safetensors& file, const char* name, const std::string& path) : name_(name), path_(path) {
    const Tensor* tensor = file.find(name);
    if (!tensor || tensor->dtype != dtype_of<T>()) fail("is missing, or has other numbers than it should");
    const auto count = std::int64_t(tensor->bytes.size() / sizeof(T));
    items_.resize(size_t(count));
    std::copy(tensor->bytes.begin(), tensor->bytes.end(), reinterpret_cast<std::byte*>(items_.data()));
  }
  std::span<const T> take(std::int64_t count) {
    if (count < 0 || count > std::int64_t(items_.size() - next_)) fail("ends too early");
    const std::span<const T> part(items_.data() + next_, size_t(count));
    next_ += size_t(count);
    return part;
  }
  std::int64_t count() const { return std::int64_t(items_.size()); }
  /// One number, from `least` to `most`.
  std::int64_t number(std::int64_t least, std::int64_t most) {
    const std::int64_t value = std::int64_t(take(1)[0]);
    if (value < least || value > most) fail("has " + std::to_string(value) + " out of range");
    return value;
  }
  void expect_end() const {
    if (next_ != items_.size()) fail("has more than belongs to patterns");
  }
  [[noreturn]] void fail(const std::string& what) const {
    throw FormatError(path_ + ": dictionary: '" + name_ + "' " + what);
  }

 private:
  std::string name_, path_;
  std::vector<T> items_;
  size_t next_ = 0;
};

RowMatrix matrix(Reader<double>& weights, std::int64_t rows, std::int64_t columns) {
  const std::span<const double> numbers = weights.take(rows * columns);
  for (const double x : numbers)
    if (!std::isfinite(x)) weights.fail("has a number that is not finite");
  return Eigen::Map<const RowMatrix>(numbers.data(), rows, columns);
}

}  // namespace

std::uint64_t mask_hash(const Scheme<double>& scheme) {
  Mesh mesh = demo_mesh();
  if (scheme.face_size() == 3) mesh = triangulated(mesh);
  if (scheme.sharpening != Sharpening::semi_sharp) mesh = without_creases(mesh);
  // Not with the steps of level 0, which dictionaries do not know.
  Scheme<double> plain = scheme;
  plain.preparation.clear();
  std::string bytes;
  const auto put = [&](const auto& number) { bytes.append(reinterpret_cast<const char*>(&number), sizeof number); };
  Level level = control_level(scheme, mesh);
  for (int k = 0; k < (scheme.preparation.empty() ? 1 : 2); ++k) {
    level = next_level(k == 0 ? scheme : plain, level);
    for (Eigen::Index r = 0; r < level.S.rows(); ++r)
      for (SparseMatrix::InnerIterator it(level.S, r); it; ++it) {
        put(static_cast<std::int32_t>(it.col()));
        put(static_cast<float>(it.value()));
      }
  }
  return std::stoull(checksum(std::as_bytes(std::span(bytes))), nullptr, 16);
}

void save_patterns(const std::filesystem::path& path, const Patterns& patterns) {
  const std::vector<Patterns::Stored> all = patterns.stored();
  std::vector<std::int32_t> heads, signatures, words, rows, limits;
  std::vector<double> weights;
  std::vector<std::uint8_t> status;
  for (const Patterns::Stored& one : all) {
    heads.insert(heads.end(), {std::int32_t(one.kind), one.num_slots, one.decays, std::int32_t(one.signatures.size()),
                               std::int32_t(one.rows.size()), std::int32_t(one.limits.size())});
    for (const auto& signature : one.signatures) {
      signatures.insert(signatures.end(), {signature.turn, std::int32_t(signature.words.size())});
      words.insert(words.end(), signature.words.begin(), signature.words.end());
    }
    for (const auto& r : one.rows) {
      rows.insert(rows.end(), {r.levels, std::int32_t(r.ends), std::int32_t(r.weights.rows())});
      weights.insert(weights.end(), r.weights.data(), r.weights.data() + r.weights.size());
    }
    for (const auto& l : one.limits) {
      limits.insert(limits.end(), {l.request.lattice.n, l.request.place.turn, l.request.place.quarter,
                                   l.request.by_address, l.request.derivatives});
      weights.insert(weights.end(), l.block.weights.data(), l.block.weights.data() + l.block.weights.size());
      status.insert(status.end(), l.block.status.begin(), l.block.status.end());
    }
  }
  Safetensors file;
  const auto add = [&](const char* name, const auto& items, std::int64_t columns) {
    using T = typename std::decay_t<decltype(items)>::value_type;
    std::vector<std::int64_t> shape{std::int64_t(items.size()) / columns};
    if (columns > 1) shape.push_back(columns);
    file.tensors.push_back(tensor<T>(name, std::span<const T>(items), shape));
  };
  add("patterns", heads, pattern_columns);
  add("signatures", signatures, 2);
  add("words", words, 1);
  add("rows", rows, row_columns);
  add("limits", limits, limit_columns);
  add("weights", weights, 1);
  add("status", status, 1);
  file.metadata = {{"format", format},
                   {"schema_version", schema_version},
                   {"scheme", patterns.scheme().name},
                   {"masks", std::to_string(mask_hash(patterns.scheme()))}};
  write_safetensors(path, std::move(file));
}

void load_patterns(const std::filesystem::path& path, Patterns& patterns) {
  const std::string bytes = read_file(path), name = path.string();
  const Safetensors file = read_safetensors(std::as_bytes(std::span(bytes)), name);
  const auto text = [&](const char* key) {
    const auto at = file.metadata.find(key);
    return at == file.metadata.end() ? std::string() : at->second;
  };
  if (text("format") != format)
    throw FormatError(name + ": not a dictionary of patterns, as `bake --dictionary` writes");
  if (text("schema_version") != schema_version)
    throw FormatError(name + ": a dictionary of version " + text("schema_version") + "; this program reads version " +
                      schema_version);
  const Scheme<double>& scheme = patterns.scheme();
  if (text("masks") != std::to_string(mask_hash(scheme)))
    throw FormatError(name + ": a dictionary of " +
                      (text("scheme") == scheme.name ? "other options or masks of " + scheme.name
                                                     : "'" + text("scheme") + "', not of '" + scheme.name + "'") +
                      "; take another file for each scheme and its options");
  for (const Tensor& tensor : file.tensors)
    if (matches_checksum(file, tensor) == false)
      throw FormatError(name + ": dictionary: '" + tensor.name + "' is not what was written; delete the file");

  Reader<std::int32_t> heads(file, "patterns", name), signatures(file, "signatures", name), words(file, "words", name),
      rows(file, "rows", name), limits(file, "limits", name);
  Reader<double> weights(file, "weights", name);
  Reader<std::uint8_t> status(file, "status", name);
  if (heads.count() % pattern_columns != 0) heads.fail("has a broken row");
  std::vector<Patterns::Stored> all(size_t(heads.count() / pattern_columns));
  constexpr std::int64_t many = std::numeric_limits<std::int32_t>::max();
  for (Patterns::Stored& one : all) {
    one.kind = Piece::Kind(heads.number(0, std::int64_t(Piece::Kind::cut)));
    one.num_slots = static_cast<Index>(heads.number(1, many));
    one.decays = heads.number(0, 1) != 0;
    const std::int64_t num_signatures = heads.number(1, many), num_rows = heads.number(0, many),
                       num_limits = heads.number(0, many);
    for (std::int64_t i = 0; i < num_signatures; ++i) {
      Patterns::Stored::Signature signature;
      signature.turn = static_cast<int>(signatures.number(0, 3));
      const std::span<const std::int32_t> own = words.take(signatures.number(1, many));
      signature.words.assign(own.begin(), own.end());
      one.signatures.push_back(std::move(signature));
    }
    const bool triangle = one.kind == Piece::Kind::triangle;
    for (std::int64_t i = 0; i < num_rows; ++i) {
      Patterns::Stored::Rows r;
      r.levels = static_cast<int>(rows.number(0, last_level));
      r.ends = Patterns::Ends(rows.number(0, 1));
      const std::int64_t count = rows.number(1, many);
      const bool is_whole = one.kind != Piece::Kind::corner;  // corners have as many as there are children
      if (r.levels % scheme.period != 0 || (is_whole && count != Patterns::lattice_of(scheme, r.levels).size()))
        rows.fail("has points that no level has");
      r.weights = matrix(weights, count, one.num_slots);
      one.rows.push_back(std::move(r));
    }
    for (std::int64_t i = 0; i < num_limits; ++i) {
      Patterns::LimitRequest r;
      r.lattice = {static_cast<std::int32_t>(limits.number(1, last_n)), triangle};
      r.place.turn = static_cast<std::int8_t>(limits.number(0, 3));
      r.place.quarter = static_cast<std::int8_t>(limits.number(-1, 3));
      r.by_address = limits.number(0, 1) != 0;
      r.derivatives = static_cast<int>(limits.number(0, 2));
      Patterns::LimitBlock block;
      block.weights = matrix(weights, std::int64_t{r.lattice.size()} * num_quantities(r.derivatives), one.num_slots);
      const std::span<const std::uint8_t> own = status.take(r.lattice.size());
      block.status.assign(own.begin(), own.end());
      one.limits.push_back({r, std::move(block)});
    }
  }
  for (const auto* reader : {&heads, &signatures, &words, &rows, &limits}) reader->expect_end();
  weights.expect_end();
  status.expect_end();
  for (Patterns::Stored& one : all) patterns.add(std::move(one));
}

}  // namespace sublimit
