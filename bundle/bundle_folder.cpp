#include "antigrasp/bundle/bundle_folder.h"

#include <algorithm>
#include <cstdio>
#include <utility>

#include "antigrasp/bundle/bundle_files.h"
#include "antigrasp/bundle/object_bundle.h"
#include "antigrasp/bundle/object_size_rule.h"
#include "antigrasp/core/atomic_file.h"
#include "antigrasp/core/csv_writer.h"
#include "antigrasp/core/error.h"
#include "antigrasp/core/ordered_stream.h"
#include "antigrasp/datasets/npy_text.h"
#include "antigrasp/datasets/objects.h"
#include "antigrasp/datasets/result_folder.h"
#include "antigrasp/mesh/mesh_file.h"
#include "antigrasp/mesh/place.h"
#include "antigrasp/quality/named_gripper.h"
#include "antigrasp/quality/object_size.h"

namespace antigrasp {
namespace {

constexpr const char* kTable = "bundle.csv";
constexpr const char* kSelfCheck = "self_check";
constexpr double kMostLoss = 1e-5;             // of the largest extent, as perturb has it
constexpr const char* kEgadGripper = "panda";  // of EGAD's own trials

struct BundledObject {
  std::string name, note, status;
  double metres_per_unit = 0.0;
  ObjectBundle bundle;  // of "ok"
};

// All that a call can write for an object, so that an earlier call's parts go.
ResultFiles FilesOfCall() {
  ResultFiles files{kTable, {}, {"NAME/NAME.stl"}};
  ObjectBundle any;
  any.name = "NAME";
  for (const TextFile& file : TextFiles(any, BundleTarget::kAll)) {
    files.of_object.push_back("NAME/" + file.name);
  }
  for (std::size_t i = 0; i < static_cast<std::size_t>(kMostParts); ++i) {
    files.of_object.push_back("NAME/" + any.PartName(i) + ".stl");
  }
  return files;
}

// Why no bundle can have this name; empty where one can.
std::string WhyNotNamed(const std::string& name) {
  const bool control = std::any_of(name.begin(), name.end(),
                                   [](char c) { return static_cast<unsigned char>(c) < 0x20; });
  if (control) return "its name has a control character: no XML can hold it";
  if (ValidUtf8(name) != name) return "its name is no UTF-8: no XML can hold it";
  if (FileNameOf(name) == kTable) return "its folder would be called as the table is";
  if (FileNameOf(name).starts_with(kSelfCheck)) {
    return std::string("its name begins with ") + kSelfCheck +
           ", as the files of the self-check do";
  }
  return "";
}

class Bundler {
 public:
  explicit Bundler(const BundleRequest& request) : request_(request) {
    const bool egad = request.scale == ObjectScale::kEgad;
    if (request.gripper.empty() && !egad) return;
    MetricOptions metric;
    ApplyGripper(request.gripper.empty() ? kEgadGripper : request.gripper, &metric);
    opening_ = metric.jaw_opening;
  }

  BundledObject Make(const InputObject& object) const {
    BundledObject made{object.name, object.note, object.status, 0.0, {}};
    if (!object.ok()) return made;
    const Eigen::Vector3d oriented = OrientedExtents(object.mesh);
    made.metres_per_unit = MetresPerUnitOf(object.mesh, oriented);
    const double width = made.metres_per_unit * oriented.minCoeff();
    const TriangleMesh in_metres =
        Transformed(object.mesh, made.metres_per_unit, Eigen::Vector3d::Zero());
    if (const std::string why = WhyNotNamed(object.name); !why.empty()) {
      made.status = why;
    } else if (SinglePrecisionLoss(in_metres) > kMostLoss * Bounds(in_metres).Extent().maxCoeff()) {
      made.status = "too far from the origin for STL's single precision: move it there";
    } else if (!request_.gripper.empty() && width > opening_) {
      made.status = LengthText(width) + " wide where it is narrowest: the gripper opens " +
                    LengthText(opening_);
    } else {
      made.bundle = MakeObjectBundle(FileNameOf(object.name), in_metres, request_.options);
    }
    return made;
  }

 private:
  double MetresPerUnitOf(const TriangleMesh& mesh, const Eigen::Vector3d& oriented) const {
    switch (request_.scale) {
      case ObjectScale::kMinExtent:
        return request_.options.min_extent / Bounds(mesh).Extent().minCoeff();
      case ObjectScale::kEgad:
        return EgadScale(oriented, opening_);
      case ObjectScale::kTrue:
        break;
    }
    return MetresPer(request_.units);
  }

  const BundleRequest& request_;
  double opening_ = 0.0;
};

void WriteFiles(const ObjectBundle& bundle, BundleTarget target,
                const std::filesystem::path& folder) {
  MakeFolder(folder);
  WriteMesh(folder / (bundle.name + ".stl"), bundle.mesh);
  for (std::size_t i = 0; i < bundle.parts.size(); ++i) {
    WriteMesh(folder / (bundle.PartName(i) + ".stl"), bundle.parts[i].mesh);
  }
  for (const TextFile& file : TextFiles(bundle, target)) {
    WriteFileAtomic(folder / file.name, file.text);
  }
}

class BundleTable {
 public:
  BundleTable()
      : csv_({"object", "status", "metres_per_unit", "mass", "com_x", "com_y", "com_z", "parts",
              "covered", "missing", "hausdorff", "dent", "cell"}) {}
  void Add(const BundledObject& made) {
    csv_.Text(made.name).Text(made.status);
    const ObjectBundle& b = made.bundle;
    if (made.status == "ok") {
      csv_.Numbers({made.metres_per_unit, b.mass, b.center.x(), b.center.y(), b.center.z()});
      csv_.Count(std::ssize(b.parts));
      csv_.Numbers({b.errors.covered, b.errors.missing, b.errors.hausdorff, b.errors.dent, b.cell});
      ++made_;
      covered_ = std::max(covered_, b.errors.covered);
      hausdorff_ = std::max(hausdorff_, b.errors.hausdorff);
    } else {
      for (int i = 0; i < 11; ++i) csv_.Text("");
    }
    csv_.EndRow();
  }
  std::string TakeText() { return csv_.TakeText(); }
  std::size_t made() const { return made_; }
  std::string Summary(std::int64_t objects, const std::string& out) const {
    char text[400];
    std::snprintf(text, sizeof text,
                  "%zu of %lld objects in %s\nconvex parts (bundle.csv): at most %.1f %% of an "
                  "object's volume too much, Hausdorff distance %.2f mm\n",
                  made_, static_cast<long long>(objects), out.c_str(), 100.0 * covered_,
                  1000.0 * hausdorff_);
    return text;
  }

 private:
  CsvWriter csv_;
  std::size_t made_ = 0;
  double covered_ = 0.0, hausdorff_ = 0.0;
};

}  // namespace

BundleReport WriteBundles(const BundleRequest& request, RunObserver* observer) {
  if (request.out.empty()) throw InputError("--out \"\"", "bundle", "a folder");
  const bool as_it_is = request.scale == ObjectScale::kTrue;
  const ObjectSource objects(request.inputs, GridUnit::kOfFiles,
                             as_it_is ? std::optional(request.units) : std::nullopt);
  objects.RequireNotSearched(request.out);
  const Bundler bundler(request);
  ResultFolder results(request.out, FilesOfCall(), objects, request.overwrite);
  BundleTable table;
  BundleReport report;
  std::string first;
  StreamInOrder(
      objects.size(), request.threads,
      [&](std::int64_t i) { return bundler.Make(objects.Load(i)); },
      [&](std::int64_t, const BundledObject& made) {
        if (!made.note.empty()) report.warnings.push_back(made.name + ": " + made.note);
        if (made.status == "ok") {
          WriteFiles(made.bundle, request.target, results.path() / made.bundle.name);
        } else {
          report.warnings.push_back(made.name + ": left out: " + made.status);
          if (first.empty()) first = made.status;
        }
        table.Add(made);
        results.AddToTable(table.TakeText());
      },
      observer->Phase("bundling"));
  if (table.made() == 0) {
    throw InputError(first, request.inputs.front(),
                     request.gripper.empty()
                         ? "a closed solid"
                         : "a closed solid, somewhere narrower than the gripper opens");
  }
  results.Commit(table.TakeText());
  report.text = table.Summary(objects.size(), request.out);
  return report;
}

}  // namespace antigrasp
