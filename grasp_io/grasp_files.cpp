#include "antigrasp/grasp_io/grasp_files.h"

#include <algorithm>
#include <utility>

#include "antigrasp/core/error.h"
#include "antigrasp/core/file_kind.h"
#include "antigrasp/grasp_io/grasp_json.h"
#include "antigrasp/grasp_io/isaac_grasp.h"

namespace antigrasp {
namespace {

namespace fs = std::filesystem;

GraspFormat ByExtension(const fs::path& path) {
  const fs::path extension = path.extension();
  if (extension == ".yaml" || extension == ".yml") return GraspFormat::kIsaac;
  if (extension == ".json") return GraspFormat::kGraspGen;
  if (extension == ".h5") return GraspFormat::kAcronym;
  if (extension == ".hdf5") return GraspFormat::kDexNet;
  return GraspFormat::kCsv;
}

const char* ExtensionOf(GraspFormat format) {
  if (format == GraspFormat::kIsaac) return ".yaml";
  return format == GraspFormat::kAcronym ? ".h5" : ".json";
}

std::string TextOf(GraspFormat format, const GraspSet& set, const GraspFileAbout& about) {
  if (format == GraspFormat::kIsaac) return IsaacGraspYaml(set, about);
  if (format == GraspFormat::kGraspGen) return GraspGenJson(set, about);
  return MultiGripperJson(set, about);
}

// A whole file at once.
void WriteOne(AtomicFile* file, GraspFormat format, const GraspSet& set,
              const GraspFileAbout& about) {
  if (format == GraspFormat::kAcronym) return WriteAcronym(file->temp_path(), set, about);
  file->Append(TextOf(format, set, about));
}

bool HoldsMesh(GraspFormat format) {
  return format == GraspFormat::kAcronym || format == GraspFormat::kDexNet;
}

void RequireNewFolder(const fs::path& folder) {
  std::error_code ignored;
  if (!fs::exists(folder, ignored)) return;
  if (fs::is_directory(folder, ignored) && fs::is_empty(folder, ignored)) return;
  throw InputError("it is there already", folder.string(), "a new or an empty folder");
}

std::vector<GivenGrasp> ReadOne(const fs::path& path, const GripperBase& base,
                                const MetricOptions& metric) {
  const std::string name = path.string();
  RequireFile(path, "a file of grasps");
  const GraspFormat format = ByExtension(path);
  if (format == GraspFormat::kIsaac) return ReadIsaacGrasps(name, base, metric);
  if (format == GraspFormat::kGraspGen) return ReadJsonGrasps(name, base, metric);
  if (format != GraspFormat::kCsv && !IsHdf5(path)) {
    throw InputError("no HDF5", name, "grasps of ACRONYM (.h5) or Dex-Net 2.0 (.hdf5)");
  }
  return ReadHdf5Grasps(name, base, metric);
}

}  // namespace

GraspFiles::GraspFiles(GraspOutput output, const ObjectSource& objects)
    : output_(std::move(output)), objects_(objects), table_(output_.frame) {
  if (!wanted()) return;
  if (output_.format == GraspFormat::kAuto) output_.format = ByExtension(output_.path);
  if (output_.format != GraspFormat::kCsv && output_.frame == GraspFrame::kMesh) {
    throw InputError("--frame mesh", "--grasps " + output_.path,
                     "csv, the one format in the unit of the mesh: all others hold metres");
  }
  const bool folder = OfOneObject() && objects.size() > 1;
  if (folder && fs::path(output_.path).has_extension()) {
    throw InputError(std::to_string(objects.size()) + " objects in one file",
                     "--grasps " + output_.path,
                     "a folder, as a file of " + ChoiceName(output_.format) +
                         " holds one object; or csv or dexnet");
  }
  if (folder) {
    RequireNewFolder(output_.path);
    folder_.emplace(output_.path);
  } else {
    file_.emplace(output_.path);
  }
  if (output_.format == GraspFormat::kDexNet) dexnet_.emplace(file_->temp_path(), output_.about);
}

bool GraspFiles::OfOneObject() const {
  return output_.format != GraspFormat::kCsv && output_.format != GraspFormat::kDexNet;
}

void GraspFiles::Add(std::int64_t place, const ScoredObject& scored) {
  if (!wanted()) return;
  if (output_.format == GraspFormat::kCsv) {
    table_.Add(scored.name, scored.score, scored.center_of_mass);
    file_->Append(table_.TakeText());
    return;
  }
  GraspSet set;
  set.object = scored.name;
  set.metres_per_unit = scored.score.scale;
  for (std::size_t g = 0; g < scored.score.grasps.size(); ++g) {
    const auto& [grasp, quality, draws, candidate] = scored.score.grasps[g];
    set.grasps.push_back({std::to_string(g), grasp.center, grasp.axis, grasp.approach, grasp.width,
                          quality, candidate});
  }
  Add(place, std::move(set));
}

void GraspFiles::RequireLabels() const {
  if (!wanted() || output_.format != GraspFormat::kCsv) return;
  throw InputError("grasps with labels as csv", "--grasps " + output_.path,
                   "another format; with --grasps-in --out has what is known of each in a table");
}

void GraspFiles::Add(std::int64_t place, GraspSet set) {
  if (!wanted()) return;
  RequireLabels();
  without_way_ +=
      std::erase_if(set.grasps, [](const PosedGrasp& grasp) { return grasp.approach.isZero(0.0); });
  if (set.grasps.empty()) {
    ++empty_;
    return;
  }
  written_ += std::ssize(set.grasps);
  if (HoldsMesh(output_.format)) set.mesh = objects_.Load(place).mesh;
  const std::string name = FileNameOf(set.object);
  if (dexnet_) {
    dexnet_->Add(name, set);
  } else if (folder_) {
    AtomicFile file(folder_->path() / (name + ExtensionOf(output_.format)));
    WriteOne(&file, output_.format, set, output_.about);
    file.Commit();
  } else {
    WriteOne(&*file_, output_.format, set, output_.about);
  }
}

std::vector<std::string> GraspFiles::Commit() {
  if (!wanted()) return {};
  std::vector<std::string> notes;
  if (without_way_ > 0) {
    notes.push_back(std::to_string(without_way_) +
                    " grasps without a way in of the gripper are left out of " + output_.path);
  }
  if (output_.format != GraspFormat::kCsv && written_ == 0) {
    throw InputError("no grasp to write" + (notes.empty() ? "" : ": " + notes.front()),
                     "--grasps " + output_.path,
                     "objects that the gripper can hold, and --collision gripper");
  }
  if (empty_ > 0) {
    notes.push_back(std::to_string(empty_) + " objects without grasps are left out of " +
                    output_.path);
  }
  if (dexnet_) dexnet_->Close();
  if (folder_) {
    folder_->Commit();
  } else {
    file_->Commit();
  }
  return notes;
}

GraspsRead ReadGraspFiles(const std::string& path, const GripperBase& base,
                          const MetricOptions& metric) {
  if (!fs::is_directory(path)) {
    if (ByExtension(path) == GraspFormat::kCsv && !IsHdf5(path)) {
      return {ReadGivenGrasps(path), false};
    }
    return {ReadOne(path, base, metric), true};
  }
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(path)) {
    if (entry.is_regular_file() && ByExtension(entry.path()) != GraspFormat::kCsv) {
      files.push_back(entry.path());
    }
  }
  std::sort(files.begin(), files.end());
  if (files.empty()) throw InputError("no file of grasps", path, ".yaml, .json, .h5 or .hdf5");
  GraspsRead all{{}, true};
  for (const fs::path& file : files) {
    for (GivenGrasp& grasp : ReadOne(file, base, metric)) all.grasps.push_back(std::move(grasp));
  }
  return all;
}

}  // namespace antigrasp
