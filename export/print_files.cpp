#include "antigrasp/export/print_files.h"

#include <utility>

#include "antigrasp/core/atomic_file.h"
#include "antigrasp/export/glb.h"
#include "antigrasp/mesh/mesh_file.h"
#include "antigrasp/mesh/mesh_format.h"

namespace antigrasp {

std::vector<std::string> ExportFormats() {
  std::vector<std::string> formats = WritableExtensions();
  formats.insert(formats.end(), {"3mf", "glb"});
  return formats;
}

PrintFiles::PrintFiles(std::filesystem::path folder, std::string format)
    : folder_(std::move(folder)), format_(std::move(format)) {}

std::string PrintFiles::FileOf(const std::string& name, const std::string& format) {
  return IsPlate(format) ? kPlate : name + "." + format;
}

void PrintFiles::Add(const std::string& name, const std::string& file, const TriangleMesh& mesh) {
  if (IsPlate(format_)) {
    plate_.Add(name, mesh);
  } else if (format_ == "glb") {
    WriteFileAtomic(folder_ / file, GlbBytes(mesh, name, kCreaseOfGlb));
  } else {
    WriteMesh(folder_ / file, mesh);
  }
}

void PrintFiles::Close() {
  if (plate_.empty()) return;
  AtomicFile file(folder_ / kPlate);
  plate_.Write(file.temp_path());
  file.Commit();
}

}  // namespace antigrasp
