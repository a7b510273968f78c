// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/detail/row_writer.h"
#include "sublimit/io/detail/off.h"
#include "sublimit/io/detail/writer_parts.h"
#include "sublimit/io/write_mesh.h"
#include "sublimit/mesh/detail/attributes.h"

namespace sublimit {
namespace {

constexpr std::int64_t rows_per_block = 4096;

/// Colours as words: whole numbers of 0 to 255, or numbers of 0 to 1. Values beyond are cut off.
class ColourWords {
 public:
  explicit ColourWords(const std::vector<Mesh::Values>& values) {
    const std::optional<std::array<Index, 4>> found = find_colours(values);
    if (!found) return;
    for (const Index i : *found)
      if (i >= 0) channels_.push_back(&values[static_cast<std::size_t>(i)]);
    // A file whose largest number is 1 has numbers of 0 to 1.
    whole_ = std::ranges::all_of(channels_, [](const Mesh::Values* c) { return c->type == ValueType::uint8; }) &&
             std::ranges::any_of(channels_, [](const Mesh::Values* c) {
               return std::ranges::any_of(c->values, [](double x) { return std::round(x) > 1; });
             });
  }
  bool any() const { return !channels_.empty(); }

  /// Returns how many numbers are cut off.
  std::int64_t num_cut() const {
    std::int64_t cut = 0;
    for (const Mesh::Values* const channel : channels_)
      for (std::size_t i = 0; i < channel->values.size(); ++i) {
        const double value = whole_ ? std::round(channel->values[i]) / 255 : colour_in_unit(*channel, i);
        cut += !(value >= 0 && value <= 1);
      }
    return cut;
  }

  void append(std::string& out, std::size_t i) const {
    for (const Mesh::Values* const channel : channels_) {
      out += ' ';
      if (whole_) {
        append_number(out, static_cast<int>(std::clamp(std::round(channel->values[i]), 0.0, 255.0)));
      } else {
        const double value = std::clamp(colour_in_unit(*channel, i), 0.0, 1.0);
        if (channel->type == ValueType::float64)
          append_number(out, value);
        else
          append_number(out, static_cast<float>(value));
      }
    }
  }

 private:
  std::vector<const Mesh::Values*> channels_;
  bool whole_ = false;
};

void emit_off(const Mesh& mesh, RowWriter out) {
  const ColourWords vertex_colours(mesh.vertex_values), face_colours(mesh.face_values);
  out.write((vertex_colours.any() ? "COFF\n" : "OFF\n") + format_number(mesh.num_vertices()) + " " +
            format_number(mesh.num_faces()) + " 0\n");
  const double* const positions = mesh.positions.data();
  out.rows(mesh.positions.rows(), rows_per_block, [&](std::string& text, std::int64_t begin, std::int64_t end) {
    for (std::int64_t v = begin; v < end; ++v) {
      for (int i = 0; i < 3; ++i) {
        if (i > 0) text += ' ';
        append_number(text, positions[3 * v + i]);
      }
      vertex_colours.append(text, static_cast<std::size_t>(v));
      text += '\n';
    }
  });
  const std::vector<std::size_t> first = first_corners(mesh.face_sizes, rows_per_block);
  out.rows(std::ssize(mesh.face_sizes), rows_per_block, [&](std::string& text, std::int64_t begin, std::int64_t end) {
    const Index* vertex = mesh.face_vertices.data() + first[static_cast<std::size_t>(begin / rows_per_block)];
    for (std::int64_t f = begin; f < end; ++f) {
      const Index size = mesh.face_sizes[static_cast<std::size_t>(f)];
      append_number(text, size);
      for (Index i = 0; i < size; ++i) {
        text += ' ';
        append_number(text, *vertex++);
      }
      face_colours.append(text, static_cast<std::size_t>(f));
      text += '\n';
    }
  });
}

}  // namespace

std::vector<std::string> changes_in_off(const Mesh& mesh) {
  std::vector<std::string> changes;
  const auto add = [&](const std::vector<Mesh::Values>& values, const char* of) {
    if (const std::int64_t cut = ColourWords(values).num_cut(); cut > 0)
      changes.push_back("numbers of colours of " + std::string(of) + " beyond 0 to 1, " + format_number(cut) +
                        " of them, are cut off; a .ply of type float or double keeps them");
  };
  add(mesh.vertex_values, "vertices");
  add(mesh.face_values, "faces");
  return changes;
}

std::string format_off(const Mesh& mesh) {
  check_output(mesh, "OFF");
  std::string text;
  emit_off(mesh, RowWriter(text));
  return text;
}

void write_off(const std::filesystem::path& path, const Mesh& mesh, const std::function<void(std::int64_t)>& progress) {
  check_output(mesh, path.string());
  AtomicFile file(path, progress);
  emit_off(mesh, RowWriter(file));
  file.commit();
}

}  // namespace sublimit
