#include <fcntl.h>
#include <unistd.h>

#include <memory>
#include <string_view>

#include "antigrasp/core/atomic_file.h"
#include "antigrasp/core/error.h"
#include "antigrasp/core/format.h"
#include "antigrasp/datasets/npy_grids.h"

// Grids as one array of NumPy.
namespace antigrasp {
namespace {

class NpyFile {
 public:
  explicit NpyFile(const std::filesystem::path& path)
      : path_(path.string()), file_(::open(path.c_str(), O_RDONLY | O_CLOEXEC)) {}
  NpyFile(const NpyFile&) = delete;
  NpyFile& operator=(const NpyFile&) = delete;
  ~NpyFile() {
    if (file_ >= 0) ::close(file_);
  }
  std::string Read(std::uint64_t at, std::size_t size) const {
    std::string bytes(size, '\0');
    std::size_t done = 0;
    while (done < size) {
      const ssize_t count =
          ::pread(file_, bytes.data() + done, size - done, static_cast<off_t>(at + done));
      if (count <= 0) break;
      done += static_cast<std::size_t>(count);
    }
    bytes.resize(done);
    return bytes;
  }
  const std::string& path() const { return path_; }

 private:
  std::string path_;
  int file_;
};

class NpySink : public GridSink {
 public:
  explicit NpySink(const std::filesystem::path& path) : target_(path) {}
  void Begin(const ShapeSet& /*about*/, std::size_t count, const SdfGrid& first) override {
    const auto n = static_cast<std::uint64_t>(first.n);
    target_.Append(NpyHeaderText("<f4", {count, n, n, n}));
  }
  void Add(const std::vector<float>& values) override {
    target_.Append({reinterpret_cast<const char*>(values.data()), values.size() * sizeof(float)});
  }
  void Commit(const std::vector<std::string>& /*names*/) override { target_.Commit(); }

 private:
  AtomicFile target_;
};

}  // namespace

NpyGrids NpyGridsOf(const NpyHeader& header, const std::string& where) {
  std::vector<std::uint64_t> shape = header.shape;
  if (shape.size() == 5 && shape[1] == 1) shape.erase(shape.begin() + 1);
  if (shape.size() == 3) shape.insert(shape.begin(), 1);
  if (shape.size() != 4 || shape[1] != shape[2] || shape[2] != shape[3]) {
    std::string text;
    for (const std::uint64_t extent : header.shape) {
      text += (text.empty() ? "" : ", ") + std::to_string(extent);
    }
    throw InputError("an array of shape [" + text + "]", where,
                     "[N, n, n, n], [N, 1, n, n, n] or [n, n, n]: z, y, x");
  }
  RequireUsableSize(shape[0], shape[1], where);
  return {shape[0], shape[1], NpyFloatSize(header, where), header.size};
}

std::vector<std::string> NamesAfterFile(const std::filesystem::path& path, std::uint64_t count) {
  const std::string stem = path.stem().string();
  if (count == 1) return {stem};
  std::vector<std::string> names;
  for (std::uint64_t i = 0; i < count; ++i) {
    names.push_back(NumberedName(stem, static_cast<std::int64_t>(i)));
  }
  return names;
}

ForeignGrids ReadNpyGrids(const std::filesystem::path& path) {
  RequireFile(path, "a NumPy array of grids");
  const auto file = std::make_shared<NpyFile>(path);
  const NpyGrids array =
      NpyGridsOf(ParseNpyHeader(file->Read(0, kLongestNpyHeader), path.string()), path.string());
  const std::uintmax_t size = std::filesystem::file_size(path);
  if (size != array.bytes()) {
    throw InputError(std::to_string(size) + " bytes", path.string(),
                     std::to_string(array.bytes()) + " of the shape that its header says");
  }
  ForeignGrids grids;
  grids.info.format = ShapeFormat::kNpy;
  grids.info.count = static_cast<int>(array.count);
  grids.info.n = static_cast<int>(array.n);
  grids.names = NamesAfterFile(path, array.count);
  grids.read = [file, array](int i, std::span<float> values) {
    const std::size_t bytes = values.size() * array.float_size;
    const std::string read = file->Read(array.begin + static_cast<std::uint64_t>(i) * bytes, bytes);
    if (read.size() != bytes) throw InputError("read error", file->path(), "a whole file");
    NpyToFloats(read, array.float_size, values);
  };
  return grids;
}

std::unique_ptr<GridSink> MakeNpySink(const std::filesystem::path& path) {
  return std::make_unique<NpySink>(path);
}

}  // namespace antigrasp
