// SPDX-License-Identifier: Apache-2.0
#include "sublimit/io/read_mesh.h"

#include <system_error>

#include "sublimit/base/detail/read_file.h"
#include "sublimit/base/detail/standard_files.h"
#include "sublimit/base/error.h"
#include "sublimit/io/detail/formats.h"

namespace sublimit {

Mesh read_mesh(const std::filesystem::path& path) {
  if (const FileFormat* const format = io_formats().reader(path, contents::meshes)) return format->read_mesh(path);
  // What is no file at all is better told so than that its name is wrong.
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(opened_path(path), error);
  if (!std::filesystem::exists(status) || std::filesystem::is_directory(status)) read_file(path);
  throw FormatError(path.string() + ": unknown kind of mesh '" + file_extension(path) + "'; " +
                    io_formats().readers_in_words({contents::meshes}, "and") + " can be read");
}

}  // namespace sublimit
