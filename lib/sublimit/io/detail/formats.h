// SPDX-License-Identifier: Apache-2.0
#pragma once
// File formats as a table: a row has the extensions of a format, the first bytes of its files, what is read from them
// and written to them, and the fields of a mesh that they hold. A new format is a reader or writer and a row; the
// choice of both, lists in messages and checks of names come from the table.
//
//   if (const FileFormat* format = io_formats().reader(path, contents::meshes)) return format->read_mesh(path);
//   io_formats().readers({contents::meshes})  // ".obj", ".ply", ".off", ".stl", ...
//
// Formats of `lib` are in formats.cpp; the offline part adds its own (stencils/formats/formats.h).
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sublimit/io/detail/file_extension.h"
#include "sublimit/io/detail/gzip.h"
#include "sublimit/mesh/control_polygon.h"
#include "sublimit/mesh/mesh.h"

namespace sublimit {

class UsdStage;

/// Something that files hold and that a reader or writer is for.
struct Content {
  std::string_view name;    ///< in the plural
  bool compressed = false;  ///< files may be compressed (gzip)
  friend bool operator==(const Content&, const Content&) = default;
};

namespace contents {
inline constexpr Content meshes{"meshes", true};                       ///< read_mesh, write_mesh
inline constexpr Content mesh_parts{"parts of meshes"};                ///< any part of a file alone, for many processes
inline constexpr Content vertex_values{"values at vertices", true};    ///< `Mesh::vertex_values`, read by their names
inline constexpr Content vertex_normals{"normals of vertices", true};  ///< read_obj_normals
inline constexpr Content polygons{"polygons", true};                   ///< read_polygon, write_polygon
inline constexpr Content tangents{"polygons with tangents", true};     ///< polygons, with tangents and in any dimension
inline constexpr Content free_form{"free-form curves, surfaces", true};  ///< read_free_form, write_free_form
inline constexpr Content rows{"rows of numbers"};                        ///< lines of numbers below a header
inline constexpr Content scenes{"scenes", true};                         ///< `flatten`: meshes in a whole, which stays
inline constexpr Content cad{"CAD files"};                               ///< boundary models: faces with shared edges
inline constexpr Content step{"STEP files"};  ///< of CAD files those of ISO 10303, which have names
}  // namespace contents

/// Fields of a mesh besides its positions and faces.
enum class MeshField {
  creases,
  corners,
  knot_intervals,
  holes,
  rules,         ///< boundary, creasing, triangles, face-varying interpolation
  face_varying,  ///< one channel of 1 to 3 columns, or of `texture_columns`
  groups,
  objects,
  materials,
  smoothing_groups,
  vertex_normals,  ///< a normal for each vertex
  corner_normals,  ///< a normal for each corner of a face
  texture,         ///< texture coordinates of vertices
  face_ids,
  vertex_colours,  ///< values red, green and blue at vertices
  vertex_values,   ///< other ones
  face_colours,
  face_values,
  comments,
};

/// Returns the fields that a mesh has, in the order of the enumerators.
std::vector<MeshField> fields_of(const Mesh& mesh);
/// Returns a field in words: "creases", "knot intervals".
std::string_view name_of(MeshField field);

/// The first bytes of a file, by which formats recognise it.
struct FileStart {
  explicit FileStart(std::string_view first_bytes);
  std::string_view bytes;
  std::string_view line;  ///< the first line that is neither blank nor a comment (#); empty in binary files
  std::string_view word;  ///< its first word
};

/// A row of the table.
struct FileFormat {
  /// A content, and how messages name files with it if the extension alone is too little: "binary .ply".
  struct Ability {
    Content content;
    std::string_view words = {};
  };
  std::string_view name;                     ///< a file that begins as one of this format: "an OBJ file"
  std::vector<std::string_view> extensions;  ///< in lower case, with the dot
  bool (*begins)(const FileStart&) = nullptr;
  std::vector<Ability> reads = {}, writes = {};
  std::vector<MeshField> holds = {};  ///< fields of a mesh that files hold; others are left out or refused
  std::vector<MeshField> keeps = {};  ///< of these, fields that `read_mesh` returns as they were written
  int texture_columns = 0;            ///< columns that a face-varying channel must have; 0: 1 to 3
  bool needs_normals = false;         ///< other programs show surfaces in facets if files have no normals

  /// Reader and writer of meshes; null if there is none.
  Mesh (*read_mesh)(const std::filesystem::path&) = nullptr;
  void (*write_mesh)(const std::filesystem::path&, const Mesh&, const std::function<void(std::int64_t)>&) = nullptr;
  /// Returns what the writer changes of the fields that files hold, a sentence each; null if nothing.
  std::vector<std::string> (*changes)(const Mesh&) = nullptr;
  /// Where the writer splits vertices whose corners differ: those of `split_vertices` in the order of files.
  std::vector<Index> (*vertex_order)(const Mesh&) = nullptr;
  /// Returns the bytes of a scene whose first layer has another text; null if there is none.
  std::string (*format_scene)(const UsdStage&, const std::string& layer, const std::string& name,
                              std::vector<std::string>& warnings) = nullptr;
  /// Reader and writer of polygons, from and to text; null if there is none.
  ControlPolygon (*parse_polygon)(std::string_view text, std::string_view name, bool tangents) = nullptr;
  std::string (*format_polygon)(const ControlPolygon&) = nullptr;
};

/// File formats by extension, in either case. No file is opened: queries by path are about its name.
class FileFormats {
 public:
  explicit FileFormats(std::vector<FileFormat> rows) : rows_(std::move(rows)) {}

  /// Returns all formats, in the order of the table.
  const std::vector<FileFormat>& rows() const { return rows_; }
  /// Returns the format of a path; null if its extension is unknown.
  const FileFormat* find(const std::filesystem::path& path) const;

  /// Returns the format of a path if it has a reader of the content; null otherwise. Files that may be compressed have
  /// the format of their name without `.gz`.
  const FileFormat* reader(const std::filesystem::path& path, Content content) const;
  /// Returns the format of a path if it has a writer of the content; null otherwise.
  const FileFormat* writer(const std::filesystem::path& path, Content content) const;
  /// Returns true if the format of a path has a reader of the content.
  bool reads(const std::filesystem::path& path, Content content) const { return reader(path, content); }
  /// Returns true if the format of a path has a writer of the content.
  bool writes(const std::filesystem::path& path, Content content) const { return writer(path, content); }
  /// Returns true if the format of a path holds a field of a mesh.
  bool holds(const std::filesystem::path& path, MeshField field) const;

  /// Returns the first format whose files begin so; null if there is none.
  const FileFormat* recognized(std::string_view first_bytes) const;

  /// Returns the extensions of the formats with one of the contents: those of the first content in the order of the
  /// table, then further ones of the second, ...
  std::vector<std::string> readers(const std::vector<Content>& wanted) const;
  /// Returns the same of writers.
  std::vector<std::string> writers(const std::vector<Content>& wanted) const;
  /// Returns the extensions of the formats that hold a field of a mesh.
  std::vector<std::string> holders(MeshField field) const;

  /// Returns these extensions as words of a message, ".obj, binary .ply and .off".
  /// @param conjunction  before the last one: "and", "or"
  std::string readers_in_words(const std::vector<Content>& wanted, std::string_view conjunction) const;
  /// Returns the same of writers.
  std::string writers_in_words(const std::vector<Content>& wanted, std::string_view conjunction) const;

 private:
  std::vector<FileFormat> rows_;
};

/// Returns the fields of a mesh that files of a format do not hold.
std::vector<MeshField> left_out(const FileFormat& format, const Mesh& mesh);

/// Returns true if a format has a reader of the content.
bool reads(const FileFormat& format, Content content);
/// Returns words as a list: "a, b and c", or "a, b, c" without a conjunction.
std::string listed(const std::vector<std::string>& words, std::string_view conjunction);

/// Returns the formats of meshes, curves, free-form surfaces and CAD files.
const FileFormats& io_formats();

}  // namespace sublimit
