// SPDX-License-Identifier: Apache-2.0
#include "sublimit/io/read_mesh.h"

#include <string>
#include <system_error>

#include "sublimit/base/detail/read_file.h"
#include "sublimit/base/error.h"
#include "sublimit/io/detail/file_extension.h"
#include "sublimit/io/detail/obj.h"
#include "sublimit/io/detail/off.h"
#include "sublimit/io/detail/ply.h"

namespace sublimit {

Mesh read_mesh(const std::filesystem::path& path) {
  const std::string extension = file_extension(path);
  if (extension == ".obj") return read_obj(path);
  if (extension == ".ply") return read_ply(path);
  if (extension == ".off") return read_off(path);
  // What is no file at all is better told so than that its name is wrong.
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status) || std::filesystem::is_directory(status)) read_file(path);
  throw FormatError(path.string() + ": unknown kind of mesh '" + extension + "'; .obj, .ply and .off can be read");
}

}  // namespace sublimit
