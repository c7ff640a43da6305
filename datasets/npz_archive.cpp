#include "antigrasp/datasets/npz_archive.h"

#include <zip.h>

#include <algorithm>
#include <utility>

#include "antigrasp/core/error.h"

namespace antigrasp {
namespace {

constexpr const char* kWholeArchive = "a whole .npz archive, as numpy.savez writes it";
constexpr std::uint64_t kLoosely = std::uint64_t{64} << 20, kTightest = 100;
constexpr std::size_t kPieceBytes = std::size_t{1} << 20;
constexpr zip_int64_t kMostArrays = 1000;
constexpr std::uint16_t kFirstDay = 0x21;  // 1980-01-01, where the dates of zip begin

using ZipEntry = std::unique_ptr<zip_file_t, int (*)(zip_file_t*)>;

ZipEntry OpenEntry(zip_t* zip, const std::string& name) {
  return {zip_fopen(zip, (name + ".npy").c_str(), 0), &zip_fclose};
}

}  // namespace

struct NpzArchive::Zip {
  zip_t* zip = nullptr;
  ~Zip() {
    if (zip != nullptr) zip_discard(zip);
  }
};

NpzArchive::NpzArchive(const std::filesystem::path& path)
    : zip_(std::make_unique<Zip>()), path_(path.string()) {
  int code = 0;
  zip_->zip = zip_open(path.c_str(), ZIP_RDONLY, &code);
  if (zip_->zip == nullptr) throw InputError("truncated or no zip archive", path_, kWholeArchive);
  const zip_int64_t count = zip_get_num_entries(zip_->zip, 0);
  if (count > kMostArrays) {
    throw InputError(std::to_string(count) + " files in the archive", path_, kWholeArchive);
  }
  for (zip_int64_t i = 0; i < count; ++i) {
    const char* const raw = zip_get_name(zip_->zip, static_cast<zip_uint64_t>(i), 0);
    const std::string name = raw == nullptr ? "" : raw;
    if (name.ends_with(".npy")) names_.push_back(name.substr(0, name.size() - 4));
  }
}

NpzArchive::~NpzArchive() = default;

std::string NpzArchive::Read(const std::string& name, std::size_t most) const {
  const ZipEntry file = OpenEntry(zip_->zip, name);
  std::string bytes(most, '\0');
  std::size_t done = 0;
  zip_int64_t count = file ? 0 : -1;
  while (file && done < most &&
         (count = zip_fread(file.get(), bytes.data() + done, most - done)) > 0) {
    done += static_cast<std::size_t>(count);
  }
  if (count < 0) throw InputError("damaged array " + name, path_, kWholeArchive);
  bytes.resize(done);
  return bytes;
}

void NpzArchive::ReadAll(const std::string& name, std::uint64_t size,
                         const std::function<void(std::string_view)>& use) const {
  zip_stat_t stat;
  zip_stat_init(&stat);
  zip_stat(zip_->zip, (name + ".npy").c_str(), 0, &stat);
  if (stat.size != size) {
    throw InputError(name + " of " + std::to_string(stat.size) + " bytes", path_,
                     std::to_string(size) + " of the shape that its header says");
  }
  if (size > kLoosely && size / kTightest > stat.comp_size) {
    throw InputError(name + " grows to more than a hundred times its packed size", path_,
                     "distances of shapes");
  }
  const ZipEntry file = OpenEntry(zip_->zip, name);
  std::vector<char> piece(kPieceBytes);
  std::uint64_t left = size;
  while (file && left > 0) {
    const zip_int64_t count =
        zip_fread(file.get(), piece.data(), std::min<std::uint64_t>(left, piece.size()));
    if (count <= 0) break;
    left -= static_cast<std::uint64_t>(count);
    use({piece.data(), static_cast<std::size_t>(count)});
  }
  // One byte more is asked for, because libzip compares the check sum at the end.
  if (!file || left > 0 || zip_fread(file.get(), piece.data(), 1) != 0) {
    throw InputError("damaged array " + name, path_, kWholeArchive);
  }
}

struct NpzOutput::Zip {
  zip_t* zip = nullptr;
  ~Zip() {
    if (zip != nullptr) zip_discard(zip);
  }
};

NpzOutput::NpzOutput(const std::filesystem::path& path)
    : zip_(std::make_unique<Zip>()), path_(path.string()) {
  int code = 0;
  zip_->zip = zip_open(path.c_str(), ZIP_CREATE | ZIP_TRUNCATE, &code);
  if (zip_->zip == nullptr) throw RuntimeFailure("cannot write " + path_);
}

NpzOutput::~NpzOutput() = default;

void NpzOutput::AddSource(const std::string& name, void* raw) {
  auto* const source = static_cast<zip_source_t*>(raw);
  const zip_int64_t index =
      source == nullptr ? -1 : zip_file_add(zip_->zip, (name + ".npy").c_str(), source, 0);
  if (index < 0) {
    if (source != nullptr) zip_source_free(source);
    throw RuntimeFailure("cannot write " + path_ + ": " + zip_strerror(zip_->zip));
  }
  const auto at = static_cast<zip_uint64_t>(index);
  zip_set_file_compression(zip_->zip, at, ZIP_CM_STORE, 0);
  zip_file_set_dostime(zip_->zip, at, 0, kFirstDay, 0);
}

void NpzOutput::Add(const std::string& name, std::string bytes) {
  held_.push_back(std::make_unique<std::string>(std::move(bytes)));
  const std::string& held = *held_.back();
  AddSource(name, zip_source_buffer(zip_->zip, held.data(), held.size(), 0));
}

void NpzOutput::AddFile(const std::string& name, const std::filesystem::path& file) {
  AddSource(name, zip_source_file(zip_->zip, file.c_str(), 0, -1));
}

void NpzOutput::Close() {
  if (zip_close(zip_->zip) == 0) {
    zip_->zip = nullptr;
    return;
  }
  throw RuntimeFailure("cannot write " + path_ + ": " + zip_strerror(zip_->zip));
}

}  // namespace antigrasp
