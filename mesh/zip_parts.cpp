#include "antigrasp/mesh/zip_parts.h"

#include <zip.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "antigrasp/core/error.h"

namespace antigrasp {
namespace {

constexpr std::uint64_t kFree = std::uint64_t{64} << 20, kMost = std::uint64_t{1} << 30;
constexpr std::uint64_t kTimes = 100;  // XML of meshes packs ten times
constexpr std::size_t kPiece = std::size_t{1} << 18;

}  // namespace

struct ZipParts::Archive {
  zip_t* zip = nullptr;
  ~Archive() {
    if (zip != nullptr) zip_discard(zip);
  }
};

ZipParts::ZipParts(std::string_view bytes, std::string path)
    : archive_(std::make_unique<Archive>()),
      path_(std::move(path)),
      left_(std::min(kMost, kFree + kTimes * bytes.size())) {
  zip_error_t error;
  zip_error_init(&error);
  zip_source_t* const source = zip_source_buffer_create(bytes.data(), bytes.size(), 0, &error);
  if (source != nullptr) archive_->zip = zip_open_from_source(source, ZIP_RDONLY, &error);
  const std::string why = zip_error_strerror(&error);
  zip_error_fini(&error);
  if (archive_->zip != nullptr) return;
  if (source != nullptr) zip_source_free(source);
  throw InputError("truncated or no zip archive: " + why, path_, "a whole 3MF file");
}

ZipParts::~ZipParts() = default;

bool ZipParts::Has(const std::string& name) const {
  return zip_name_locate(archive_->zip, name.c_str(), ZIP_FL_NOCASE) >= 0;
}

void ZipParts::Read(const std::string& name, const std::function<void(std::string_view)>& use) {
  const zip_int64_t index = zip_name_locate(archive_->zip, name.c_str(), ZIP_FL_NOCASE);
  if (index < 0) throw InputError("no part " + name, path_, "a whole 3MF file");
  const std::unique_ptr<zip_file_t, int (*)(zip_file_t*)> file(
      zip_fopen_index(archive_->zip, static_cast<zip_uint64_t>(index), 0), &zip_fclose);
  std::vector<char> piece(kPiece);
  zip_int64_t count = file ? 0 : -1;
  while (file && (count = zip_fread(file.get(), piece.data(), piece.size())) > 0) {
    if (static_cast<std::uint64_t>(count) > left_) {
      throw InputError(name + " grows beyond what a mesh would", path_,
                       "at most a hundred times the file, and 1 GiB");
    }
    left_ -= static_cast<std::uint64_t>(count);
    use({piece.data(), static_cast<std::size_t>(count)});
  }
  if (count < 0) throw InputError("damaged part " + name, path_, "a whole 3MF file");
}

}  // namespace antigrasp
