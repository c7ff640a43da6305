#include "antigrasp/quality/grasp_table.h"

#include <cstdio>

namespace antigrasp {

GraspTable::GraspTable(GraspFrame frame)
    : frame_(frame),
      csv_({"object",
            "grasp",
            "p1x",
            "p1y",
            "p1z",
            "n1x",
            "n1y",
            "n1z",
            "p2x",
            "p2y",
            "p2z",
            "n2x",
            "n2y",
            "n2z",
            "axis_x",
            "axis_y",
            "axis_z",
            "width",
            "robust_quality",
            "approach_x",
            "approach_y",
            "approach_z",
            "comx",
            "comy",
            "comz",
            "in1x",
            "in1y",
            "in1z",
            "in2x",
            "in2y",
            "in2z",
            "metres_per_unit",
            "candidate",
            "frame"}) {}

void GraspTable::Add(const std::string& object, const Graspability& score,
                     const Eigen::Vector3d& center_of_mass) {
  const auto add = [&](const Eigen::Vector3d& v) { csv_.Numbers({v.x(), v.y(), v.z()}); };
  const bool mesh = frame_ == GraspFrame::kMesh;
  const double divisor = mesh ? score.scale : 1.0;
  const Eigen::Vector3d com = mesh ? center_of_mass : score.scale * center_of_mass;
  for (std::size_t g = 0; g < score.grasps.size(); ++g) {
    const auto& [grasp, quality, draws, candidate] = score.grasps[g];
    csv_.Text(object).Count(std::int64_t(g));
    for (const Contact& contact : grasp.contacts) {
      add(contact.point / divisor);
      add(contact.normal);
    }
    add(grasp.axis);
    csv_.Numbers({grasp.width / divisor, quality});
    add(grasp.approach);
    add(com);
    add(grasp.axis);  // the two jaws' closing directions, as `quality` reads them
    add(-grasp.axis);
    csv_.Number(score.scale).Count(static_cast<std::int64_t>(candidate));
    csv_.Text(ChoiceName(frame_)).EndRow();
  }
}

void CandidateCount::Add(const Graspability& score) {
  attempts_ += score.attempts;
  kept_ += static_cast<double>(score.grasps.size());
  rejected_.Add(score.rejected);
}

std::string CandidateCount::Text() const {
  if (attempts_ == 0.0) return "no candidate grasps";
  const auto number = [](const char* format, double value) {
    char text[64];
    std::snprintf(text, sizeof text, format, value);
    return std::string(text);
  };
  std::string line = number("%.0f candidate grasps", attempts_);
  line += number(": %.0f %% kept", 100.0 * kept_ / attempts_);
  for (const auto& [reason, count] : rejected_.reasons) {
    line += number(", %.0f %% ", 100.0 * count / attempts_) + reason;
  }
  return line + ", " + std::to_string(rejected_.copies) + " copies";
}

}  // namespace antigrasp
