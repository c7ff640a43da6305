#include "antigrasp/core/error.h"
#include "antigrasp/datasets/grid_files.h"

namespace antigrasp {
namespace {

[[noreturn]] void FailWithoutPackages(const std::filesystem::path& path) {
  throw InputError("built without .npz and .vti", path.string(),
                   "a build where libzip-dev, zlib1g-dev and libexpat1-dev are installed");
}

}  // namespace

ForeignGrids ReadNpzGrids(const std::filesystem::path& path) { FailWithoutPackages(path); }
ForeignGrids ReadVtiGrids(const std::filesystem::path& path) { FailWithoutPackages(path); }
std::unique_ptr<GridSink> MakeNpzSink(const std::filesystem::path& path) {
  FailWithoutPackages(path);
}
std::unique_ptr<GridSink> MakeVtiSink(const std::filesystem::path& path) {
  FailWithoutPackages(path);
}

}  // namespace antigrasp
