// SPDX-License-Identifier: Apache-2.0
#include "sublimit/stencils/formats/formats.h"

namespace sublimit {
namespace {

bool begins_json(const FileStart& start) { return start.line.starts_with('{') || start.line.starts_with('['); }
bool begins_xml(const FileStart& start) { return start.line.starts_with('<'); }
bool begins_vtk(const FileStart& start) {
  return begins_xml(start) && start.bytes.find("<VTKFile") != std::string_view::npos;
}

/// The length of a header that begins with a brace, in eight bytes.
bool begins_safetensors(const FileStart& start) {
  const std::string_view bytes = start.bytes;
  return bytes.size() > 8 && bytes[8] == '{' && bytes[7] == '\0' && bytes[6] == '\0';
}

std::vector<FileFormat> rows() {
  using namespace contents;
  std::vector<FileFormat> all{
      {.name = "a table (safetensors)",
       .extensions = {".safetensors"},
       .begins = begins_safetensors,
       .reads = {{tables}, {mesh_parts}},
       .writes = {{tables}}},
      {.name = "a NumPy array",
       .extensions = {".npy"},
       .begins = [](const FileStart& start) { return start.bytes.starts_with("\x93NUMPY"); },
       .reads = {{arrays}},
       .writes = {{arrays}}},
      {.name = "a zip archive",
       .extensions = {".npz"},
       .begins = [](const FileStart& start) { return start.bytes.starts_with("PK\x03\x04"); },
       .writes = {{table_rows, ".npz (SciPy)"}}},
      {.name = "a Matrix Market file",
       .extensions = {".mtx"},
       .begins = [](const FileStart& start) { return start.line.starts_with("%%MatrixMarket"); },
       .writes = {{matrices}, {table_rows, ".mtx (Matrix Market)"}}},
      {.name = "a VTK file",
       .extensions = {".vtu"},
       .begins = begins_vtk,
       .writes = {{cells}},
       .holds = {MeshField::face_ids}},
      {.name = "an XML or HTML file", .extensions = {".html", ".htm"}, .begins = begins_xml, .writes = {{pages}}},
      {.name = "an XML or HTML file", .extensions = {".svg"}, .begins = begins_xml, .writes = {{pictures}}},
      {.name = "a JSON file",
       .extensions = {".json"},
       .begins = begins_json,
       .reads = {{recipes}, {reports}},
       .writes = {{reports}}},
      {.name = "a JSON file", .extensions = {".jsonl"}, .begins = begins_json, .reads = {{jobs}}},
  };
  all.insert(all.begin(), io_formats().rows().begin(), io_formats().rows().end());
  return all;
}

}  // namespace

const FileFormats& all_formats() {
  static const FileFormats formats(rows());
  return formats;
}

}  // namespace sublimit
