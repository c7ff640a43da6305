#include "antigrasp/core/file_kind.h"

#include <cstdint>
#include <cstring>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>
#include <string_view>
#include <vector>

#include "antigrasp/core/error.h"

namespace antigrasp {
namespace {

constexpr std::string_view kHdf5Bytes = "\x89HDF\r\n\x1a\n";
constexpr std::string_view kZipBytes = "PK\x03\x04";
constexpr std::string_view kPngBytes = "\x89PNG\r\n\x1a\n";

std::string FirstBytes(const std::filesystem::path& path, std::size_t most) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) return "";
  std::ifstream in(path, std::ios::binary);
  std::string first(most, '\0');
  in.read(first.data(), static_cast<std::streamsize>(most));
  first.resize(static_cast<std::size_t>(in.gcount()));
  return first;
}

bool BeginsWith(const std::filesystem::path& path, std::string_view bytes) {
  return FirstBytes(path, bytes.size()) == bytes;
}

// The names in the first line when it is the header of a table; else nothing.
std::vector<std::string> ColumnsIn(const std::string& text) {
  static const std::regex name("\\s*[A-Za-z_][A-Za-z0-9_]*\\s*");
  const std::size_t end = text.find_first_of("\r\n");
  if (end == std::string::npos) return {};
  std::vector<std::string> columns;
  std::istringstream fields(text.substr(0, end));
  for (std::string field; std::getline(fields, field, ',');) {
    if (!std::regex_match(field, name)) return {};
    columns.push_back(field.substr(field.find_first_not_of(" \t")));
  }
  return columns.size() < 2 ? std::vector<std::string>() : columns;
}

// A header of 80 bytes, the number of faces, 50 bytes a face.
bool IsBinaryStl(const std::filesystem::path& path, const std::string& first) {
  constexpr std::size_t kHeader = 80;
  std::uint32_t faces = 0;
  if (first.size() < kHeader + sizeof faces) return false;
  std::memcpy(&faces, first.data() + kHeader, sizeof faces);
  std::error_code ignored;
  return std::filesystem::file_size(path, ignored) ==
         kHeader + sizeof faces + std::uintmax_t{50} * faces;
}

// Whether the first line that is no comment is one of an OBJ file: "v 0 1 2", "g part". Settings
// ("g = 1") are none.
bool IsObj(const std::string& first) {
  std::istringstream lines(first);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string key, value;
    if (!(words >> key) || key.starts_with('#')) continue;
    words >> value;
    static const std::set<std::string> keys{"v", "vn", "vt", "o", "g", "mtllib", "usemtl"};
    return keys.contains(key) && !value.empty() && !value.starts_with('=');
  }
  return false;
}

bool IsMeshText(const std::string& first) {
  return (first.starts_with("solid") && first.find("facet") != std::string::npos) ||
         first.starts_with("ply\n") || first.starts_with("ply\r") || first.starts_with("OFF") ||
         first.starts_with("glTF") || IsObj(first);
}

// "a table of object, status, num_grasps, ...".
std::string TableInWords(const std::string& first) {
  constexpr std::size_t kMostNames = 4;
  const std::vector<std::string> columns = ColumnsIn(first);
  std::string text = "a table of ";
  for (std::size_t i = 0; i < columns.size() && i < kMostNames; ++i) {
    text += (i > 0 ? ", " : "") + columns[i];
  }
  return text + (columns.size() > kMostNames ? ", ..." : "");
}

FileKind KindOf(const std::filesystem::path& path, const std::string& first) {
  if (first.starts_with(kHdf5Bytes)) return FileKind::kHdf5;
  if (first.starts_with(kZipBytes)) return FileKind::kZip;
  if (first.starts_with(kPngBytes)) return FileKind::kPng;
  if (!ColumnsIn(first).empty()) return FileKind::kTable;
  return IsMeshText(first) || IsBinaryStl(path, first) ? FileKind::kMesh : FileKind::kUnknown;
}

constexpr std::size_t kLookedAt = 4096;

}  // namespace

bool IsHdf5(const std::filesystem::path& path) { return BeginsWith(path, kHdf5Bytes); }
bool IsZip(const std::filesystem::path& path) { return BeginsWith(path, kZipBytes); }

FileKind KindOf(const std::filesystem::path& path) {
  return KindOf(path, FirstBytes(path, kLookedAt));
}

void RefuseOtherKind(const std::filesystem::path& path, FileKind wanted, const std::string& noun,
                     const std::string& expected) {
  const std::string first = FirstBytes(path, kLookedAt);
  const FileKind kind = KindOf(path, first);
  if (kind == wanted || kind == FileKind::kUnknown) return;
  const std::string words = kind == FileKind::kHdf5    ? "an HDF5 file (as SDF files are)"
                            : kind == FileKind::kZip   ? "a zip archive (as checkpoints are)"
                            : kind == FileKind::kPng   ? "a picture"
                            : kind == FileKind::kTable ? TableInWords(first)
                                                       : "a mesh";
  throw InputError("is " + words + ", not " + noun, path.string(), expected);
}

}  // namespace antigrasp
