#include "antigrasp/report/page/replay_file.h"

#include <nlohmann/json.hpp>

#include "antigrasp/core/atomic_file.h"
#include "antigrasp/core/error.h"

namespace antigrasp {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kMostFrames = 120;

// A value of the file with where it stands, for messages: "replays[2].frames[0].object".
class Place {
 public:
  Place(const Json& json, std::string path, std::string name)
      : json_(json), path_(std::move(path)), name_(std::move(name)) {}

  const Json& json() const { return json_; }

  Place At(const char* key) const {
    if (!json_.is_object() || !json_.contains(key)) Fail("the key \"" + std::string(key) + "\"");
    return {json_[key], path_, name_.empty() ? key : name_ + "." + key};
  }
  Place At(std::size_t i) const { return {json_[i], path_, name_ + "[" + std::to_string(i) + "]"}; }

  void RequireNumber() const {
    if (!json_.is_number()) Fail("a number");
  }
  void RequireWhole() const {
    if (!json_.is_number_integer()) Fail("a whole number");
  }
  std::string Text() const {
    if (!json_.is_string()) Fail("text");
    return json_.get<std::string>();
  }
  std::size_t List() const {
    if (!json_.is_array()) Fail("a list");
    return json_.size();
  }
  void RequireNumbers(std::size_t count) const {
    const std::string expected = std::to_string(count) + " numbers";
    if (!json_.is_array() || json_.size() != count) Fail(expected);
    for (const Json& value : json_) {
      if (!value.is_number()) Fail(expected);
    }
  }
  [[noreturn]] void Fail(const std::string& expected) const {
    const std::string found = json_.dump(-1, ' ', true, Json::error_handler_t::replace);
    throw InputError(name_.empty() ? "the file" : name_ + " = " + found.substr(0, 60), path_,
                     expected);
  }

 private:
  const Json& json_;
  std::string path_, name_;
};

void CheckTip(const Place& tip) {
  const std::string kind = tip.At("kind").Text();
  if (kind == "sphere") {
    tip.At("radius").RequireNumber();
  } else if (kind == "pad") {
    tip.At("half").RequireNumbers(3);
  } else {
    tip.At("kind").Fail("\"sphere\" or \"pad\"");
  }
}

void CheckFrame(const Place& frame) {
  frame.At("t").RequireNumber();
  frame.At("object").RequireNumbers(7);
  const Place tips = frame.At("tips");
  if (tips.List() != 2) tips.Fail("two fingertips");
  for (std::size_t i = 0; i < 2; ++i) tips.At(i).RequireNumbers(3);
  const Place forces = frame.At("forces");
  for (std::size_t i = 0; i < forces.List(); ++i) forces.At(i).RequireNumbers(6);
  if (!frame.json().contains("table")) return;
  const Place table = frame.At("table");
  if (!table.json().is_null()) table.RequireNumber();
}

void CheckFrames(const Place& frames) {
  const std::size_t count = frames.List();
  if (count < 2 || count > kMostFrames) {
    frames.Fail("2 to " + std::to_string(kMostFrames) + " frames, not " + std::to_string(count));
  }
  for (std::size_t i = 0; i < count; ++i) {
    CheckFrame(frames.At(i));
    const Place time = frames.At(i).At("t");
    if (i > 0 && !(time.json().get<double>() > frames.json()[i - 1]["t"].get<double>())) {
      time.Fail("a time after the frame before");
    }
  }
}

void Check(const Place& replay) {
  replay.At("object").Text();
  replay.At("protocol").Text();
  replay.At("outcome").Text();
  replay.At("grasp").RequireWhole();
  replay.At("execution").RequireWhole();
  const Place size = replay.At("metres_per_unit");
  size.RequireNumber();
  if (!(size.json().get<double>() > 0.0)) size.Fail("a number above 0");
  replay.At("up").RequireNumbers(3);
  if (replay.json().contains("friction")) replay.At("friction").RequireNumber();
  if (replay.json().contains("side")) {
    const std::string side = replay.At("side").Text();
    if (side != "before" && side != "after") replay.At("side").Fail("\"before\" or \"after\"");
  }
  CheckTip(replay.At("tip"));
  CheckFrames(replay.At("frames"));
}

}  // namespace

std::vector<std::pair<std::string, ReportReplay>> ReadReplays(const std::string& path) {
  Json json;
  try {
    json = Json::parse(ReadFile(path));
  } catch (const Json::exception& error) {
    throw InputError("the file", path, std::string("JSON: ") + error.what());
  }
  const Place file(json, path, "");
  if (file.At("format").json() != "antigrasp.replays") {
    file.At("format").Fail("\"antigrasp.replays\"");
  }
  if (file.At("version").json() != 1) file.At("version").Fail("1");
  const Place replays = file.At("replays");
  std::vector<std::pair<std::string, ReportReplay>> read;
  for (std::size_t i = 0; i < replays.List(); ++i) {
    const Place replay = replays.At(i);
    Check(replay);
    Json keys = replay.json();
    keys.erase("object");
    keys.erase("frames");
    read.emplace_back(replay.At("object").Text(),
                      ReportReplay{keys.dump(), replay.At("frames").json().dump()});
  }
  return read;
}

}  // namespace antigrasp
