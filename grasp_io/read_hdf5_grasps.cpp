#include <algorithm>
#include <charconv>
#include <string_view>

#include "antigrasp/core/error.h"
#include "antigrasp/core/throwaway_copy.h"
#include "antigrasp/grasp_io/base_pose.h"
#include "antigrasp/grasp_io/grasp_hdf5.h"

namespace antigrasp {
namespace {

using Eigen::Vector3d;

// 0, 2, 10 of "grasp_0", "grasp_10", "grasp_2".
std::vector<std::uint64_t> NumbersBehind(std::string_view head,
                                         const std::vector<std::string>& names) {
  std::vector<std::uint64_t> numbers;
  for (const std::string& name : names) {
    std::uint64_t number = 0;
    const char* const end = name.data() + name.size();
    if (!name.starts_with(head)) continue;
    const auto read = std::from_chars(name.data() + head.size(), end, number);
    if (read.ec == std::errc() && read.ptr == end) numbers.push_back(number);
  }
  std::sort(numbers.begin(), numbers.end());
  return numbers;
}

class Hdf5Grasps {
 public:
  Hdf5Grasps(const std::string& path, const GripperBase& base, const MetricOptions& metric)
      : path_(path), base_(base), metric_(metric), tree_(Hdf5Tree::Open(path)) {
    if (!tree_) Fail("damaged HDF5", "a whole file of grasps");
  }

  std::vector<GivenGrasp> All() const {
    const std::vector<std::string> top = tree_->Children("/");
    const auto has = [&](const char* name) {
      return std::find(top.begin(), top.end(), name) != top.end();
    };
    if (!has("grasps") && !has("datasets")) {
      Fail("HDF5 without grasps", "/grasps/transforms (ACRONYM) or /datasets (Dex-Net 2.0)");
    }
    std::vector<GivenGrasp> grasps = has("grasps") ? OfAcronym() : OfDexNet();
    if (grasps.empty()) Fail("no grasps", "a pose for every grasp");
    return grasps;
  }

 private:
  [[noreturn]] void Fail(const std::string& what, const std::string& expected) const {
    throw InputError(what, path_, expected);
  }

  std::vector<GivenGrasp> OfAcronym() const {
    const auto poses = tree_->Numbers("/grasps/transforms");
    if (!poses || poses->extents.size() != 3 || poses->extents[1] != 4 || poses->extents[2] != 4) {
      Fail("no readable /grasps/transforms", "numbers [N, 4, 4]");
    }
    RequireSameGripper(tree_->Text("/gripper/type").value_or(""), base_, path_);
    const std::string object = tree_->Text("/object/file").value_or("");
    const auto scale = tree_->Numbers("/object/scale");
    if (scale && (scale->values.size() != 1 || !(scale->values[0] > 0.0))) {
      Fail("/object/scale is none", "metres a unit of the mesh");
    }
    const auto candidates = tree_->Numbers("/grasps/qualities/antigrasp/candidate");
    std::vector<GivenGrasp> grasps(poses->extents[0]);
    for (std::size_t i = 0; i < grasps.size(); ++i) {
      GivenGrasp& grasp = grasps[i];
      grasp.object = object;
      grasp.id = std::to_string(i);
      const Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>> pose(
          poses->values.data() + 16 * i);
      TakeBasePose(pose, ConventionFrame(metric_), &grasp);
      grasp.says_scale = scale.has_value();
      grasp.metres_per_unit = scale ? scale->values[0] : 1.0;
      grasp.of_a_candidate = candidates && candidates->values.size() == grasps.size();
      grasp.candidate = grasp.of_a_candidate ? Whole(candidates->values[i]) : i;
    }
    return grasps;
  }

  std::vector<GivenGrasp> OfDexNet() const {
    std::vector<GivenGrasp> grasps;
    for (const std::string& set : tree_->Children("/datasets")) {
      const std::string objects = "/datasets/" + set + "/objects";
      for (const std::string& key : tree_->Children(objects)) {
        OfDexNetObject(objects + "/" + key, key, &grasps);
      }
    }
    return grasps;
  }

  void OfDexNetObject(const std::string& path, const std::string& key,
                      std::vector<GivenGrasp>* grasps) const {
    const std::vector<std::string> grippers = tree_->Children(path + "/grasps");
    if (grippers.empty()) return;
    auto gripper = std::find_if(grippers.begin(), grippers.end(), [&](const std::string& name) {
      return name == base_.name || name == base_.Asset();
    });
    if (gripper == grippers.end()) {
      if (grippers.size() > 1) {
        Fail("grasps of several grippers, none of " + base_.name, "--gripper as one of them");
      }
      gripper = grippers.begin();
      RequireSameGripper(*gripper, base_, path_);
    }
    const std::string group = path + "/grasps/" + *gripper;
    const auto scale = tree_->NumbersAttribute(path, "metres_per_unit");
    const bool says_scale = scale && scale->values.size() == 1 && scale->values[0] > 0.0;
    for (const std::uint64_t i : NumbersBehind("grasp_", tree_->Children(group))) {
      const std::string at = group + "/grasp_" + std::to_string(i);
      const auto values = tree_->NumbersAttribute(at, "configuration");
      const auto id = tree_->NumbersAttribute(at, "id");
      if (!values || values->values.size() < 9 || values->values.size() > 10) {
        Fail("no readable " + at + "@configuration", "ten numbers");
      }
      GivenGrasp grasp;
      grasp.object = tree_->TextAttribute(path, "file").value_or(key);
      grasp.id = std::to_string(i);
      grasp.frame = GraspFrame::kMetres;
      const double* const v = values->values.data();
      grasp.center = Vector3d(v[0], v[1], v[2]);
      grasp.axis = Vector3d(v[3], v[4], v[5]);
      grasp.approach = DexNetApproach(grasp.axis.normalized(), v[7]);
      grasp.says_scale = says_scale;
      grasp.metres_per_unit = says_scale ? scale->values[0] : 1.0;
      grasp.of_a_candidate = says_scale && id && id->values.size() == 1;
      grasp.candidate = grasp.of_a_candidate ? Whole(id->values[0]) : i;
      grasps->push_back(std::move(grasp));
    }
  }

  std::uint64_t Whole(double value) const {
    if (value >= 0.0 && value < 1e15) return static_cast<std::uint64_t>(value);
    Fail("a candidate's number is none", "whole numbers from 0");
  }

  const std::string& path_;
  const GripperBase& base_;
  const MetricOptions& metric_;
  std::unique_ptr<Hdf5Tree> tree_;
};

}  // namespace

std::vector<GivenGrasp> ReadHdf5Grasps(const std::string& path, const GripperBase& base,
                                       const MetricOptions& metric) {
  // Texts of free length, and all that older layouts hold, have no check sums: a damaged one leads
  // the library (1.10.8) out of its buffers.
  constexpr unsigned kMostSeconds = 60;
  const auto read = [&] { return Hdf5Grasps(path, base, metric).All(); };
  if (!ReturnsInACopy([&] { read(); }, kMostSeconds)) {
    throw InputError("damaged HDF5", path, "a whole file of grasps");
  }
  return read();
}

}  // namespace antigrasp
