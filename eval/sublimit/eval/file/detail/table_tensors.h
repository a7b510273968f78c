// SPDX-License-Identifier: Apache-2.0
#pragma once
// The named arrays and texts of a table in its file; `eval/table_format.md` defines them.
#include <string>

#include "sublimit/eval/file/detail/safetensors.h"
#include "sublimit/eval/table/baked_table.h"

namespace sublimit {

/// Words of files.
namespace table_words {

inline constexpr const char* format = "sublimit-table";
/// Newest version that is read. Files are written in the oldest version that can hold the table.
inline constexpr int schema_version = 2;
constexpr int schema_of(const TableInfo& info) { return info.rational ? 2 : 1; }
inline constexpr const char* homogeneous = "homogeneous";
/// Order of results: one quantity after the other, each for all points.
inline constexpr const char* order = "quantity,point";
inline constexpr const char* option_prefix = "option.";
/// Returns the word for 1, 3 or 6 quantities: positions, with first derivatives, with second ones.
constexpr const char* quantities(int number) {
  return number == 1 ? "x" : number == 3 ? "x xu xv" : "x xu xv xuu xuv xvv";
}
/// Returns the prefix of the names of a channel's arrays.
inline std::string face_varying(size_t channel) { return "face_varying." + std::to_string(channel) + "."; }
constexpr const char* shape(bool triangles) { return triangles ? "triangle" : "quadrilateral"; }

}  // namespace table_words

/// The arrays of a table, referred to where they are; empty ones are left out.
class TableTensors {
 public:
  /// @param table  must outlive this
  template <class Real>
  explicit TableTensors(const BakedTable<Real>& table);
  template <class Real>
  explicit TableTensors(const BakedTable<Real>&&) = delete;
  TableTensors(const TableTensors&) = delete;
  TableTensors& operator=(const TableTensors&) = delete;
  const Safetensors& file() const { return file_; }

 private:
  template <class T>
  void add(const std::string& name, std::span<const T> items, std::int64_t columns = 1);
  template <class Real>
  void add(const std::string& prefix, const StencilTable<Real>& table);
  void add(const FaceLattices::Arrays& arrays);
  void add(const TableChannels& channels);
  void add(const TableTags& tags);

  std::vector<std::int64_t> blocks_, groups_;
  Safetensors file_;
};

extern template TableTensors::TableTensors(const BakedTable<float>&);
extern template TableTensors::TableTensors(const BakedTable<double>&);

}  // namespace sublimit
