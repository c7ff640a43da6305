#include "antigrasp/trial/replay_file.h"

#include <algorithm>
#include <cstdio>
#include <initializer_list>
#include <utility>

#include "antigrasp/trial/trial_summary.h"

namespace antigrasp {
namespace {

using Eigen::Vector3d;

constexpr std::size_t kMostFrames = 120;

std::string Quoted(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) {
    char escaped[8] = "";
    if (c == '"' || c == '\\') {
      quoted += '\\';
      quoted += c;
    } else if (static_cast<unsigned char>(c) < 0x20) {
      std::snprintf(escaped, sizeof escaped, "\\u%04x", static_cast<unsigned>(c));
      quoted += escaped;
    } else {
      quoted += c;
    }
  }
  return quoted + "\"";
}

void Append(std::initializer_list<double> numbers, std::string* text) {
  *text += '[';
  bool first = true;
  for (const double number : numbers) {
    char digits[32];
    std::snprintf(digits, sizeof digits, first ? "%.6g" : ",%.6g", number);
    *text += digits;
    first = false;
  }
  *text += ']';
}

std::string Number(double value) {
  char digits[32];
  std::snprintf(digits, sizeof digits, "%.6g", value);
  return digits;
}

std::string FrameText(const ReplayFrame& frame, const Eigen::Isometry3d& mesh, double tip_out) {
  const Eigen::Quaterniond q(mesh.linear());
  const Vector3d p = mesh.translation();
  std::string text = "{\"t\":" + Number(frame.seconds) + ",\"object\":";
  Append({p.x(), p.y(), p.z(), q.w(), q.x(), q.y(), q.z()}, &text);
  text += ",\"tips\":[";
  Append({frame.state.travel - tip_out, 0.0, 0.0}, &text);
  text += ',';
  Append({tip_out - frame.state.travel, 0.0, 0.0}, &text);
  text += "],\"forces\":[";
  for (const ContactForce& contact : frame.contacts) {
    if (text.back() == ']') text += ',';
    const Vector3d &at = contact.position, &f = contact.force;
    Append({at.x(), at.y(), at.z(), f.x(), f.y(), f.z()}, &text);
  }
  return text + "],\"table\":" + (frame.table == kNoTable ? "null" : Number(frame.table)) + "}";
}

std::string TipText(const Fingertip& tip) {
  if (tip.shape == TipShape::kSphere) {
    return R"({"kind":"sphere","radius":)" + Number(tip.radius) + "}";
  }
  std::string text = R"({"kind":"pad","half":)";
  const Vector3d half = tip.Half();
  Append({half.x(), half.y(), half.z()}, &text);
  return text + "}";
}

}  // namespace

std::string ReplayText(const std::string& object, std::string_view side, PhysicsTrials* trials,
                       const Fingertip& tip, const PhysicsTrial& trial, std::size_t grasp,
                       std::size_t draw) {
  const ExecutedGrasp& executed = trial.grasps[grasp];
  const GripStart start = trials->StartOfDraw(executed, draw);
  std::vector<ReplayFrame> frames;
  const Execution execution = trials->Replay(executed, draw, [&](const ReplayFrame& frame) {
    if (!frame.state.broken && frame.state.body.matrix().allFinite()) frames.push_back(frame);
  });
  if (frames.size() < 2) return {};
  std::string text = R"({"object":)" + Quoted(object) + R"(,"side":")" + std::string(side) +
                     R"(","protocol":")" + ChoiceName(trials->protocol().name) + R"(","grasp":)" +
                     std::to_string(grasp) + R"(,"execution":)" + std::to_string(draw) +
                     R"(,"outcome":")" + ChoiceName(execution.outcome) + R"(","friction":)" +
                     Number(start.friction) + R"(,"metres_per_unit":)" +
                     Number(trial.metres_per_unit) + R"(,"tip":)" + TipText(tip) + R"(,"up":)";
  Append({start.up.x(), start.up.y(), start.up.z()}, &text);
  text += ",\"frames\":[\n";
  const double tip_out = 0.5 * start.opening + tip.Half().x();
  const std::size_t count = std::min(frames.size(), kMostFrames);
  for (std::size_t i = 0; i < count; ++i) {
    const ReplayFrame& frame = frames[i * (frames.size() - 1) / (count - 1)];
    text += (i == 0 ? "" : ",\n") + FrameText(frame, trials->MeshPose(frame.state.body), tip_out);
  }
  return text + "]}";
}

void ReplayFile::Add(const std::string& replay) {
  if (replay.empty()) return;
  text_ += (any_ ? ",\n" : "") + replay;
  any_ = true;
}

std::string ReplayFile::TakeText() { return std::exchange(text_, {}); }

std::string ReplayFile::EndText() { return TakeText() + "\n]}\n"; }

void ReplayFile::GoOnBehind(std::uintmax_t bytes) {
  any_ = bytes > text_.size();  // than what every file begins with
  text_.clear();
}

std::vector<std::pair<std::size_t, std::size_t>> WorthAReplay(const PhysicsTrial& trial, int each) {
  std::vector<std::pair<std::size_t, std::size_t>> chosen;
  int held = 0, lost = 0;
  for (const std::size_t grasp : GraspsOf(trial, GraspGroup::kAll)) {
    const auto& draws = trial.grasps[grasp].draws;
    for (std::size_t draw = 0; draw < draws.size(); ++draw) {
      const Execution& execution = draws[draw].execution;
      if (execution.steps < 2) continue;
      int& count = execution.stages > 0 ? held : lost;
      if (count >= each) continue;
      ++count;
      chosen.emplace_back(grasp, draw);
      break;  // one of a grasp
    }
  }
  return chosen;
}

}  // namespace antigrasp
