#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "antigrasp/export/plate.h"
#include "antigrasp/mesh/triangle_mesh.h"

namespace antigrasp {

// What `export` can write: the formats of WriteMesh, a plate, a picture of each for a viewer.
std::vector<std::string> ExportFormats();

// The solids of `export` in a folder: NAME.stl each, or all of them in plate.3mf.
class PrintFiles {
 public:
  PrintFiles(std::filesystem::path folder, std::string format);
  static bool IsPlate(const std::string& format) { return format == "3mf"; }
  static constexpr const char* kPlate = "plate.3mf";
  // The file of an object whose file name is this.
  static std::string FileOf(const std::string& name, const std::string& format);
  // Of millimetres, z up.
  void Add(const std::string& name, const std::string& file, const TriangleMesh& mesh);
  void Close();  // after the last one

 private:
  std::filesystem::path folder_;
  std::string format_;
  Plate plate_;
};

}  // namespace antigrasp
