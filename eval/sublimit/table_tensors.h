// SPDX-License-Identifier: Apache-2.0
#pragma once
// What a table has in a file: named arrays and texts. `eval/table_format.md` says what each of them means.
#include <string>

#include "sublimit/baked_table.h"
#include "sublimit/safetensors.h"

namespace sublimit {

/// Words of files.
namespace table_words {

inline constexpr const char* format = "sublimit-table";
/// The newest that is read; what is written has the oldest that can say it.
inline constexpr int schema_version = 2;
constexpr int schema_of(const TableInfo& info) { return info.rational ? 2 : 1; }
inline constexpr const char* homogeneous = "homogeneous";
/// One quantity after the other, each for all points.
inline constexpr const char* order = "quantity,point";
inline constexpr const char* option_prefix = "option.";
/// Positions, derivatives along u and v, second ones: 1, 3 or 6.
constexpr const char* quantities(int number) {
  return number == 1 ? "x" : number == 3 ? "x xu xv" : "x xu xv xuu xuv xvv";
}
/// What names of a channel's parts begin with.
inline std::string face_varying(size_t channel) { return "face_varying." + std::to_string(channel) + "."; }
constexpr const char* shape(bool triangles) { return triangles ? "triangle" : "quadrilateral"; }

}  // namespace table_words

/// Arrays where they lie in a table, which must stay as long. Those without entries are left out.
class TableTensors {
 public:
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
