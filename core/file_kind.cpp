#include "antigrasp/core/file_kind.h"

#include <fstream>
#include <string>
#include <string_view>

namespace antigrasp {
namespace {

bool BeginsWith(const std::filesystem::path& path, std::string_view bytes) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) return false;
  std::ifstream in(path, std::ios::binary);
  std::string first(bytes.size(), '\0');
  in.read(first.data(), static_cast<std::streamsize>(first.size()));
  return in && first == bytes;
}

}  // namespace

bool IsHdf5(const std::filesystem::path& path) { return BeginsWith(path, "\x89HDF\r\n\x1a\n"); }
bool IsZip(const std::filesystem::path& path) { return BeginsWith(path, "PK\x03\x04"); }

}  // namespace antigrasp
