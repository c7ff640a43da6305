#pragma once

#include "antigrasp/datasets/import.h"
#include "antigrasp/datasets/shape_set.h"
#include "tests/support/temp_folder.h"

namespace antigrasp {

// What an import writes and says.
struct Imported {
  ShapeSet set;
  std::vector<ImportedMesh> reports;
};

inline Imported Import(const std::vector<std::filesystem::path>& inputs, int resolution,
                       int threads, ImportScale scale = ImportScale::kSet,
                       const ProgressFn& progress = nullptr) {
  const shapes::TempFolder folder;
  std::vector<ImportedMesh> reports =
      ImportMeshes(inputs, folder / "set.h5", {resolution, scale, threads}, progress);
  return {ReadShapeSet(folder / "set.h5"), std::move(reports)};
}

}  // namespace antigrasp
