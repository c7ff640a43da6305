#include <hdf5.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "antigrasp/datasets/shape_set.h"
#include "bench/compare.h"
#include "bench/timing.h"

namespace antigrasp::bench {
namespace {

constexpr int kNodes = 6, kReads = 500;

std::filesystem::path WriteSet(const std::filesystem::path& folder, std::size_t count) {
  const auto path = folder / (std::to_string(count) + ".h5");
  SdfGrid grid = UnitCubeGrid(kNodes);
  ShapeSetWriter writer(path, {.kind = "bench"}, count);
  for (std::size_t i = 0; i < count; ++i) {
    grid.values.assign(kNodes * kNodes * kNodes, static_cast<float>(i));
    writer.Add(std::to_string(i), grid);
  }
  writer.Commit();
  return path;
}

// The look-up that walks through the index of chunks until it meets the one asked for.
void WalkTo(hid_t dataset, hsize_t item) {
  const hsize_t start[4] = {item, 0, 0, 0};
  unsigned passed_by = 0;
  haddr_t address = HADDR_UNDEF;
  hsize_t stored = 0;
  if (H5Dget_chunk_info_by_coord(dataset, start, &passed_by, &address, &stored) < 0) std::abort();
}

}  // namespace

// Reading grids spread over a file of many, against what the walk alone takes.
void CompareFiles() {
  const auto folder = std::filesystem::temp_directory_path() / "antigrasp_bench_files";
  std::filesystem::create_directories(folder);
  for (const std::size_t count : {2'000, 20'000, 100'000}) {
    const auto path = WriteSet(folder, count);
    const ShapeSetReader reader(path);
    const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
    const hid_t dataset = H5Dopen2(file, "/sdf", H5P_DEFAULT);
    static float sink = 0.0F;
    const auto each = [&](const auto& read) {
      return [&, read] {
        for (std::size_t i = 0; i < kReads; ++i) read(i * (count / kReads));
      };
    };
    const auto ours = [&](std::size_t i) { sink += reader.Grid(static_cast<int>(i)).values[0]; };
    const auto walk = [&](std::size_t i) { WalkTo(dataset, i); };
    const std::vector<double> seconds =
        MedianSeconds({{"read", each(ours), kReads}, {"walk", each(walk), kReads}}, 3);
    H5Dclose(dataset);
    H5Fclose(file);
    const std::string name = "files_grid_of_" + std::to_string(count);
    PrintTime(name, seconds[0]);
    PrintTime(name + "_walk", seconds[1]);
    PrintRatio(name + "_vs_walk", seconds[1] / seconds[0]);
  }
  std::filesystem::remove_all(folder);
}

}  // namespace antigrasp::bench
