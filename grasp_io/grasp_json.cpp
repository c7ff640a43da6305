#include "antigrasp/grasp_io/grasp_json.h"

#include <Eigen/Geometry>
#include <limits>
#include <nlohmann/json.hpp>

#include "antigrasp/core/atomic_file.h"
#include "antigrasp/core/error.h"
#include "antigrasp/grasp_io/base_pose.h"
#include "antigrasp/grasp_io/joint_values.h"

namespace antigrasp {
namespace {

using Eigen::Matrix4d;
using Eigen::Vector3d;
using Json = nlohmann::ordered_json;

constexpr std::size_t kMostGraspJson = std::size_t{64} << 20;  // a value of one letter takes 16

std::string Line(const Json& value) {
  return value.dump(-1, ' ', false, Json::error_handler_t::replace);
}

// A value of `set` for each grasp, a line each.
template <typename Value>
std::string Lines(const GraspSet& set, const Value& value) {
  std::string text = "[";
  for (const PosedGrasp& grasp : set.grasps) {
    text += (text.size() > 1 ? ",\n    " : "\n    ") + Line(value(grasp));
  }
  return text + "]";
}

// What we know of each grasp beside what the format asks for.
std::string OwnLines(const GraspSet& set, const std::string& indent) {
  return ",\n" + indent +
         "\"candidate\": " + Lines(set, [](const PosedGrasp& g) { return Json(g.candidate); }) +
         ",\n" + indent +
         "\"robust_quality\": " + Lines(set, [](const PosedGrasp& g) { return Json(g.quality); }) +
         ",\n" + indent + "\"held\": " + Lines(set, [](const PosedGrasp& g) {
           if (g.executions == 0) return Json();
           return Json(static_cast<double>(g.held) / g.executions);
         });
}

Json Rows(const Matrix4d& pose) {
  Json rows = Json::array();
  for (int row = 0; row < 4; ++row) {
    rows.push_back({pose(row, 0), pose(row, 1), pose(row, 2), pose(row, 3)});
  }
  return rows;
}

class JsonGrasps {
 public:
  JsonGrasps(const std::string& path, const GripperBase& base, const MetricOptions& metric)
      : path_(path), base_(base), metric_(metric) {
    const std::string text = ReadFile(path);
    if (text.size() > kMostGraspJson) Fail("JSON larger than 64 MiB", "the grasps of one object");
    json_ = Json::parse(text, nullptr, false);
    if (json_.is_discarded()) Fail("damaged JSON", "a whole file of grasps");
  }

  std::vector<GivenGrasp> All() {
    const Json& object = Child(json_, "object");
    const Json& grasps = Child(json_, "grasps");
    if (grasps.is_object() && grasps.contains("transforms")) {
      object_ = Text(Child(object, "file"));
      scale_ = Scale(object, "scale");
      RequireSameGripper(Text(Child(Child(json_, "gripper"), "name")), base_, path_);
      const Json& offset =
          Child(Child(json_, "gripper"), "transform_offset_from_asset_to_graspgen_convention");
      if (!offset.is_null()) {
        const std::vector<double> values = Numbers(offset, 16, "the offset of the gripper");
        offset_ = Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(values.data());
      }
      return Transforms(grasps);
    }
    if (json_.contains("transforms")) {
      object_ = Text(Child(json_, "object"));
      scale_ = Scale(json_, "object_scale");
      return Transforms(json_);
    }
    if (json_.contains("pose")) return Poses();
    Fail("no grasps of a known kind",
         "grasps.transforms (GraspGen), transforms (ACRONYM) or pose "
         "(MultiGripperGrasp)");
  }

 private:
  [[noreturn]] void Fail(const std::string& what, const std::string& expected) const {
    throw InputError(what, path_, expected);
  }

  std::vector<GivenGrasp> Transforms(const Json& grasps) const {
    return Each(Child(grasps, "transforms"), Child(grasps, "candidate"),
                [&](const Json& one, const std::string& name, GivenGrasp* grasp) {
                  Matrix4d pose;
                  if (!one.is_array() || one.size() != 4) Fail(name, "four rows of four numbers");
                  for (int row = 0; row < 4; ++row) {
                    const std::vector<double> values = Numbers(one[std::size_t(row)], 4, name);
                    for (int k = 0; k < 4; ++k) pose(row, k) = values[std::size_t(k)];
                  }
                  TakeBasePose(pose * offset_, ConventionFrame(metric_), grasp);
                });
  }

  std::vector<GivenGrasp> Poses() {
    object_ = Text(Child(json_, "object_ID"));
    scale_ = Scale(json_, "object_scale");
    RequireSameGripper(Text(Child(json_, "gripper")), base_, path_);
    return Each(Child(json_, "pose"), Child(json_, "candidate"),
                [&](const Json& one, const std::string& name, GivenGrasp* grasp) {
                  const std::vector<double> v = Numbers(one, 7, name);
                  TakeBasePose(PoseOf({v[0], v[1], v[2]}, v[3], {v[4], v[5], v[6]}),
                               LinkFrame(base_, metric_), grasp);
                });
  }

  template <typename Take>
  std::vector<GivenGrasp> Each(const Json& list, const Json& candidates, const Take& take) const {
    if (!list.is_array() || list.empty()) Fail("no grasps", "a pose for every grasp");
    std::vector<GivenGrasp> grasps;
    for (std::size_t i = 0; i < list.size(); ++i) {
      GivenGrasp grasp;
      grasp.object = object_;
      grasp.id = std::to_string(i);
      grasp.candidate = i;
      take(list[i], "grasp " + grasp.id, &grasp);
      grasp.says_scale = scale_ > 0.0;
      grasp.metres_per_unit = grasp.says_scale ? scale_ : 1.0;
      if (candidates.is_array() && i < candidates.size() && candidates[i].is_number_unsigned()) {
        grasp.of_a_candidate = true;
        grasp.candidate = candidates[i].get<std::uint64_t>();
      }
      grasps.push_back(std::move(grasp));
    }
    return grasps;
  }

  // Null when there is none.
  static const Json& Child(const Json& parent, const char* name) {
    static const Json none;
    if (!parent.is_object()) return none;
    const auto found = parent.find(name);
    return found == parent.end() ? none : *found;
  }
  static std::string Text(const Json& value) {
    return value.is_string() ? value.get<std::string>() : "";
  }
  double Scale(const Json& parent, const char* name) const {
    const Json& value = Child(parent, name);
    if (value.is_null()) return 0.0;
    if (value.is_number() && value.get<double>() > 0.0) return value.get<double>();
    Fail(std::string("object scale = ") + Line(value).substr(0, 40), "metres a unit of the mesh");
  }
  std::vector<double> Numbers(const Json& list, std::size_t count, const std::string& name) const {
    const std::string expected = std::to_string(count) + " numbers";
    if (!list.is_array() || list.size() != count) Fail(name, expected);
    std::vector<double> values;
    for (const Json& value : list) {
      // JSON has no nan: writers leave null, or a bare NaN that is no JSON.
      if (!value.is_number() && !value.is_null()) Fail(name, expected);
      values.push_back(value.is_null() ? std::numeric_limits<double>::quiet_NaN()
                                       : value.get<double>());
    }
    return values;
  }

  const std::string& path_;
  const GripperBase& base_;
  const MetricOptions& metric_;
  Json json_;
  std::string object_;
  double scale_ = 0.0;  // 0: the file says none
  Matrix4d offset_ = Matrix4d::Identity();
};

}  // namespace

std::string GraspGenJson(const GraspSet& set, const GraspFileAbout& about) {
  const Json object = {{"file", set.object}, {"scale", set.metres_per_unit}};
  Json offset = Json::array();
  for (int i = 0; i < 16; ++i) offset.push_back(i % 5 == 0 ? 1.0 : 0.0);
  const Json gripper = {{"name", about.base.Asset()},
                        {"width", about.metric.jaw_opening},
                        {"depth", about.Depth()},
                        {"transform_offset_from_asset_to_graspgen_convention", offset}};
  const BaseFrame frame = ConventionFrame(about.metric);
  return "{\n  \"object\": " + Line(object) + ",\n  \"gripper\": " + Line(gripper) +
         ",\n  \"label\": " + Line(about.LabelText()) + ",\n  \"grasps\": {\n   \"transforms\": " +
         Lines(set, [&](const PosedGrasp& grasp) { return Rows(BasePose(grasp, frame)); }) +
         ",\n   \"object_in_gripper\": " +
         Lines(set, [&](const PosedGrasp& grasp) { return Json(about.Success(grasp)); }) +
         OwnLines(set, "   ") + "\n  }\n}\n";
}

std::string MultiGripperJson(const GraspSet& set, const GraspFileAbout& about) {
  const BaseFrame frame = LinkFrame(about.base, about.metric);
  const auto pose = [&](const PosedGrasp& grasp) {
    const Matrix4d matrix = BasePose(grasp, frame);
    const Eigen::Quaterniond q(Eigen::Matrix3d(matrix.topLeftCorner<3, 3>()));
    return Json{matrix(0, 3), matrix(1, 3), matrix(2, 3), q.w(), q.x(), q.y(), q.z()};
  };
  const auto dofs = [&](const PosedGrasp&) {
    Json values = Json::array();
    for (const auto& [joint, value] : JointValues(about, about.metric.jaw_opening)) {
      values.push_back(value);
    }
    return values;
  };
  return "{\n  \"gripper\": " + Line(about.base.Asset()) +
         ",\n  \"object_ID\": " + Line(set.object) +
         ",\n  \"object_scale\": " + Line(set.metres_per_unit) +
         ",\n  \"label\": " + Line(about.LabelText()) + ",\n  \"pose\": " + Lines(set, pose) +
         ",\n  \"dofs\": " + Lines(set, dofs) + ",\n  \"result\": " +
         Lines(set, [&](const PosedGrasp& grasp) { return Json(about.Success(grasp) ? 1 : 0); }) +
         OwnLines(set, "  ") + "\n}\n";
}

std::vector<GivenGrasp> ReadJsonGrasps(const std::string& path, const GripperBase& base,
                                       const MetricOptions& metric) {
  return JsonGrasps(path, base, metric).All();
}

}  // namespace antigrasp
