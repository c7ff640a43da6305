#include "antigrasp/grasp_io/isaac_grasp.h"

#include <yaml-cpp/yaml.h>

#include <Eigen/Geometry>
#include <charconv>
#include <limits>
#include <optional>

#include "antigrasp/core/atomic_file.h"
#include "antigrasp/core/error.h"
#include "antigrasp/core/format.h"
#include "antigrasp/grasp_io/base_pose.h"
#include "antigrasp/grasp_io/joint_values.h"

namespace antigrasp {
namespace {

using Eigen::Matrix4d;
using Eigen::Vector3d;

constexpr std::size_t kMostYaml = std::size_t{8} << 20;  // a value of one letter takes 240
constexpr const char* kFormat = "isaac_grasp";

// YAML 1.1, which PyYAML reads, takes 1e-05 for a text: a number has a point.
std::string YamlNumber(double value) {
  std::string text = FormatDouble(value);
  if (text.find('.') != std::string::npos) return text;
  const std::size_t exponent = std::min(text.find('e'), text.size());
  return text.insert(exponent, ".0");
}

// In double quotes, as JSON has it, whatever the name.
std::string YamlText(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) {
    constexpr const char* kDigits = "0123456789ABCDEF";
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') quoted += '\\';
    if (byte < 0x20 || byte == 0x7f) {
      quoted += std::string("\\x") + kDigits[byte / 16] + kDigits[byte % 16];
    } else {
      quoted += c;
    }
  }
  return quoted + "\"";
}

std::string YamlList(const Vector3d& v) {
  return "[" + YamlNumber(v.x()) + ", " + YamlNumber(v.y()) + ", " + YamlNumber(v.z()) + "]";
}

std::string YamlJoints(const GraspFileAbout& about, double opening) {
  std::string text;
  for (const auto& [joint, value] : JointValues(about, opening)) {
    text += (text.empty() ? "" : ", ") + YamlText(joint) + ": " + YamlNumber(value);
  }
  return "{" + text + "}";
}

double Confidence(const GraspFileAbout& about, const PosedGrasp& grasp) {
  if (grasp.executions > 0) return static_cast<double>(grasp.held) / grasp.executions;
  return about.Success(grasp) ? 1.0 : 0.0;
}

class IsaacGrasps {
 public:
  IsaacGrasps(const std::string& path, const GripperBase& base, const MetricOptions& metric)
      : path_(path), frame_(LinkFrame(base, metric)) {
    const std::string text = ReadFile(path);
    if (text.size() > kMostYaml) Fail("YAML larger than 8 MiB", "the grasps of one object");
    try {
      root_ = YAML::Load(text);
    } catch (const YAML::Exception& error) {
      Fail("damaged YAML in line " + std::to_string(error.mark.line + 1), "isaac_grasp 1.0");
    }
    if (Text(root_, "format") != kFormat)
      Fail("YAML without format: isaac_grasp", "isaac_grasp 1.0");
    RequireSameGripper(Text(root_, "gripper"), base, path);
    if (Text(root_, "object_scale").empty()) return;
    scale_ = Number(root_["object_scale"]).value_or(0.0);
    if (!(scale_ > 0.0)) {
      Fail("object_scale = " + Text(root_, "object_scale"), "metres a unit of the mesh");
    }
  }

  std::vector<GivenGrasp> All() const {
    const YAML::Node list = root_["grasps"];
    std::vector<GivenGrasp> grasps;
    if (list && list.IsMap()) {
      for (const auto& item : list) {
        grasps.push_back(
            One(item.first.IsScalar() ? item.first.Scalar() : "", item.second, grasps.size()));
      }
    }
    if (grasps.empty()) Fail("no grasps", "a map grasps with a name and a pose for every grasp");
    return grasps;
  }

 private:
  [[noreturn]] void Fail(const std::string& what, const std::string& expected) const {
    throw InputError(what, path_, expected);
  }

  GivenGrasp One(const std::string& name, const YAML::Node& node, std::size_t number) const {
    GivenGrasp grasp;
    grasp.object = Text(root_, "object_file");
    grasp.id = name;
    grasp.candidate = number;
    const YAML::Node turn = Child(node, "orientation");
    const auto position = Vector(Child(node, "position")), xyz = Vector(Child(turn, "xyz"));
    const auto w = Number(Child(turn, "w"));
    if (!position || !xyz || !w) {
      Fail("grasp " + name, "position: [x, y, z] and orientation: {w: w, xyz: [x, y, z]}");
    }
    TakeBasePose(PoseOf(*position, *w, *xyz), frame_, &grasp);
    grasp.says_scale = scale_ > 0.0;
    grasp.metres_per_unit = grasp.says_scale ? scale_ : 1.0;
    const std::string candidate = Text(node, "candidate");
    const auto parsed =
        std::from_chars(candidate.data(), candidate.data() + candidate.size(), grasp.candidate);
    grasp.of_a_candidate = parsed.ec == std::errc() && !candidate.empty() &&
                           parsed.ptr == candidate.data() + candidate.size();
    return grasp;
  }

  static YAML::Node Child(const YAML::Node& parent, const char* name) {
    if (!parent.IsDefined() || !parent.IsMap()) return YAML::Node(YAML::NodeType::Undefined);
    return parent[name];
  }
  static std::string Text(const YAML::Node& parent, const char* name) {
    const YAML::Node node = Child(parent, name);
    return node.IsDefined() && node.IsScalar() ? node.Scalar() : "";
  }
  // To the last bit; not a number for .nan and .inf.
  static std::optional<double> Number(const YAML::Node& node) {
    if (!node.IsDefined() || !node.IsScalar()) return std::nullopt;
    std::string text = node.Scalar();
    if (text.starts_with('+')) text.erase(0, 1);
    if (text.find("nan") != std::string::npos || text.find("inf") != std::string::npos) {
      return std::numeric_limits<double>::quiet_NaN();
    }
    double value = 0.0;
    const auto read = std::from_chars(text.data(), text.data() + text.size(), value);
    if (read.ec != std::errc() || read.ptr != text.data() + text.size()) return std::nullopt;
    return value;
  }
  static std::optional<Vector3d> Vector(const YAML::Node& node) {
    if (!node.IsDefined() || !node.IsSequence() || node.size() != 3) return std::nullopt;
    Vector3d v;
    for (int k = 0; k < 3; ++k) {
      const auto value = Number(node[k]);
      if (!value) return std::nullopt;
      v[k] = *value;
    }
    return v;
  }

  const std::string& path_;
  BaseFrame frame_;
  YAML::Node root_;
  double scale_ = 0.0;  // 0: the file says none
};

}  // namespace

std::string IsaacGraspYaml(const GraspSet& set, const GraspFileAbout& about) {
  const std::string frame = YamlText(about.base.frame), object = YamlText(set.object);
  std::string text = std::string("format: ") + kFormat + "\nformat_version: 1.0\n";
  for (const char* key : {"object_frame", "object_frame_link"}) {
    text += std::string(key) + ": " + object + "\n";
  }
  for (const char* key : {"gripper_frame", "gripper_frame_link"}) {
    text += std::string(key) + ": " + frame + "\n";
  }
  text += "object_file: " + object + "\nobject_scale: " + YamlNumber(set.metres_per_unit) +
          "\ngripper: " + YamlText(about.base.name) + "\n";
  if (!about.base.joints.empty()) {
    const bool upper = about.base.joint_open > about.base.joint_closed;
    text += std::string("open_limit: ") + (upper ? "upper" : "lower") + "\n";
  }
  text += "label: " + YamlText(about.LabelText()) + "\ngrasps:\n";
  const BaseFrame link = LinkFrame(about.base, about.metric);
  for (const PosedGrasp& grasp : set.grasps) {
    const Matrix4d pose = BasePose(grasp, link);
    const Eigen::Quaterniond q(Eigen::Matrix3d(pose.topLeftCorner<3, 3>()));
    text += "  " + YamlText("grasp_" + grasp.id) + ":\n" +
            "    confidence: " + YamlNumber(Confidence(about, grasp)) + "\n" +
            "    position: " + YamlList(pose.topRightCorner<3, 1>()) + "\n" +
            "    orientation: {\"w\": " + YamlNumber(q.w()) + ", \"xyz\": " + YamlList(q.vec()) +
            "}\n    cspace_position: " + YamlJoints(about, grasp.width) +
            "\n    pregrasp_cspace_position: " + YamlJoints(about, about.metric.jaw_opening) +
            "\n    candidate: " + std::to_string(grasp.candidate) +
            "\n    robust_quality: " + YamlNumber(grasp.quality) + "\n";
    if (grasp.executions > 0) {
      text += "    executions: " + std::to_string(grasp.executions) + "\n";
    }
  }
  return text;
}

std::vector<GivenGrasp> ReadIsaacGrasps(const std::string& path, const GripperBase& base,
                                        const MetricOptions& metric) {
  return IsaacGrasps(path, base, metric).All();
}

}  // namespace antigrasp
