#include "antigrasp/trial/replay_file.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "antigrasp/core/atomic_file.h"

namespace antigrasp {
namespace {

using Eigen::Vector3d;

constexpr int kReplayDigits = 6;

std::string NumberJson(double value) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value + 0.0, std::chars_format::general,
                                 kReplayDigits);
  return {text, end.ptr};
}

std::string ListJson(std::initializer_list<double> values) {
  std::string text;
  for (const double value : values) text += (text.empty() ? "[" : ", ") + NumberJson(value);
  return text + "]";
}

std::string PlaceJson(const Vector3d& p) { return ListJson({p.x(), p.y(), p.z()}); }

std::string TextJson(const std::string& text) {
  constexpr char kHex[] = "0123456789abcdef";
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      quoted += {'\\', c};
    } else if (const auto byte = static_cast<unsigned char>(c); byte < 0x20) {
      quoted += {'\\', 'u', '0', '0', kHex[byte >> 4], kHex[byte & 15]};
    } else {
      quoted += c;
    }
  }
  return quoted + "\"";
}

std::string MomentJson(const ReplayMoment& moment) {
  const Vector3d& place = moment.object.translation();
  const Eigen::Quaterniond turn(moment.object.linear());
  std::string forces;
  for (const auto& [at, force] : moment.forces) {
    forces += (forces.empty() ? "" : ", ") +
              ListJson({at.x(), at.y(), at.z(), force.x(), force.y(), force.z()});
  }
  return "{\"t\": " + NumberJson(moment.seconds) + ", \"object\": " +
         ListJson({place.x(), place.y(), place.z(), turn.w(), turn.x(), turn.y(), turn.z()}) +
         ", \"tips\": [" + PlaceJson(moment.tips[0]) + ", " + PlaceJson(moment.tips[1]) +
         "], \"forces\": [" + forces + "], \"table\": " +
         (std::isfinite(moment.table) ? NumberJson(moment.table) : "null") + "}";
}

bool IsFinite(const ReplayMoment& moment) {
  return std::isfinite(moment.seconds) && moment.object.matrix().allFinite() &&
         moment.tips[0].allFinite() && moment.tips[1].allFinite() &&
         std::all_of(moment.forces.begin(), moment.forces.end(), [](const auto& force) {
           return force.first.allFinite() && force.second.allFinite();
         });
}

// Empty when there is nothing to look at.
std::string FramesJson(const std::vector<ReplayMoment>& moments) {
  std::vector<const ReplayMoment*> all;
  for (const ReplayMoment& moment : moments) {
    if (IsFinite(moment)) all.push_back(&moment);
  }
  if (all.size() < 2) return "";
  const std::size_t count = std::min(all.size(), kMostReplayFrames);
  std::string text;
  for (std::size_t i = 0; i < count; ++i) {
    text += (text.empty() ? "\n     " : ",\n     ") +
            MomentJson(*all[i * (all.size() - 1) / (count - 1)]);
  }
  return text;
}

std::string TipJson(const Replay& replay) {
  if (!replay.pad) {
    return "{\"kind\": \"sphere\", \"radius\": " + NumberJson(replay.half.x()) + "}";
  }
  return "{\"kind\": \"pad\", \"half\": " + PlaceJson(replay.half) + "}";
}

std::string ReplayJson(const Replay& replay, const std::string& frames) {
  return "\n  {\"object\": " + TextJson(replay.object) + ", \"side\": \"" +
         (replay.before ? "before" : "after") + "\", \"protocol\": " + TextJson(replay.protocol) +
         ", \"grasp\": " + std::to_string(replay.grasp) +
         ", \"execution\": " + std::to_string(replay.execution) +
         ", \"outcome\": " + TextJson(replay.outcome) +
         ",\n   \"friction\": " + NumberJson(replay.friction) +
         ", \"metres_per_unit\": " + NumberJson(replay.metres_per_unit) +
         ", \"tip\": " + TipJson(replay) + ", \"up\": " + PlaceJson(replay.up) +
         ",\n   \"frames\": [" + frames + "]}";
}

}  // namespace

void WriteReplays(const std::filesystem::path& path, const std::vector<Replay>& replays) {
  std::string text;
  for (const Replay& replay : replays) {
    const std::string frames = FramesJson(replay.moments);
    if (!frames.empty()) text += (text.empty() ? "" : ",") + ReplayJson(replay, frames);
  }
  WriteFileAtomic(path, "{\"format\": \"antigrasp.replays\", \"version\": 1, \"replays\": [" + text +
                            "]}\n");
}

}  // namespace antigrasp
