#include "antigrasp/quality/object_size.h"

#include <cmath>
#include <cstdio>
#include <optional>
#include <variant>

#include "antigrasp/core/format.h"
#include "antigrasp/quality/parallel_jaws.h"

namespace antigrasp {
namespace {

constexpr double kRoom = 5.0, kSpeck = 0.001;  // largest extents, m
constexpr double kLeastHeld = 0.01;            // things for the hand, m
constexpr double kMostHeld = 1.0;              // and the widest opening of a gripper
constexpr LengthUnit kByLikelihood[] = {LengthUnit::kMm, LengthUnit::kCm, LengthUnit::kIn,
                                        LengthUnit::kM};

// The unit in which the object would be one for the hand, other than the one it is read in.
std::optional<LengthUnit> LikelyUnit(double largest_extent, LengthUnit now) {
  for (const LengthUnit unit : kByLikelihood) {
    const double metres = largest_extent * MetresPer(unit);
    if (unit != now && metres >= kLeastHeld && metres <= kMostHeld) return unit;
  }
  return std::nullopt;
}

// ": are the coordinates in mm? --units mm"
std::string Question(double largest_extent, LengthUnit now) {
  const auto unit = LikelyUnit(largest_extent, now);
  if (!unit) return ": are the coordinates in " + ChoiceName(now) + "? --units";
  return ": are the coordinates in " + ChoiceName(*unit) + "? --units " + ChoiceName(*unit);
}

std::string BoxText(const Eigen::Vector3d& metres) {
  return LengthText(metres.x()) + " x " + LengthText(metres.y()) + " x " + LengthText(metres.z());
}

}  // namespace

bool AtTrueSize(const MetricOptions& options) { return !(options.object_min_extent > 0.0); }

std::optional<LengthUnit> UnitToReadIn(const MetricOptions& options) {
  if (!AtTrueSize(options)) return std::nullopt;
  return options.units;
}

double MetresPerUnit(const MetricOptions& options, const Eigen::Vector3d& extent) {
  return AtTrueSize(options) ? MetresPer(options.units)
                             : options.object_min_extent / extent.minCoeff();
}

std::string SizeText(const MetricOptions& options) {
  if (AtTrueSize(options)) return "at true size (" + ChoiceName(options.units) + ")";
  return "each scaled to a smallest extent of " + LengthText(options.object_min_extent);
}

std::string LengthText(double metres) {
  char text[400];
  const bool large = metres >= 0.9995;
  const double value = large ? metres : 1000.0 * metres;
  std::snprintf(text, sizeof text, value >= 99.95 ? "%.0f %s" : "%.3g %s", value,
                large ? "m" : "mm");
  return text;
}

std::vector<std::string> UnlikelyLengths(const MetricOptions& options, const TypedOption& typed) {
  std::vector<std::string> texts;
  MetricOptions copy = options;
  OptionTable lengths;
  Bind(&lengths, &copy.gripper);  // whose numbers with a fraction are all lengths
  lengths.Add("metric.jaw_opening", &copy.jaw_opening, 0.0, 0.0, "");
  lengths.Add("metric.object_min_extent", &copy.object_min_extent, 0.0, 0.0, "");
  for (const Option& option : lengths.options()) {
    const double* const* const length = std::get_if<double*>(&option.target);
    if (length == nullptr || !(**length > kMostHeld)) continue;
    const std::string number = FormatDouble(**length);
    texts.push_back(OptionText(option.key, **length, typed) + " is " + LengthText(**length) +
                    ": the metric's lengths are in metres, " + number + " mm are " +
                    FormatDouble(**length / 1000.0));
  }
  if (options.units != LengthUnit::kM && !AtTrueSize(options)) {
    texts.push_back("--units " + ChoiceName(options.units) + " changes nothing while objects are " +
                    SizeText(options) + "; --true-size keeps their size");
  }
  return texts;
}

void UnlikelySizes::Found(const std::string& text, Finding* finding) {
  if (finding->first.empty()) {
    finding->first = text;
  } else {
    ++finding->more;
  }
}

void UnlikelySizes::Add(const std::string& name, const Eigen::Vector3d& extent,
                        const Graspability* score) {
  const double largest = extent.maxCoeff();
  const Eigen::Vector3d metres = MetresPerUnit(options_, extent) * extent;
  if (!(largest > 0.0) || !metres.allFinite()) return;
  const bool true_size = AtTrueSize(options_);
  const std::string is = name + ": largest extent " + LengthText(metres.maxCoeff());
  if (true_size && metres.maxCoeff() > kRoom) {
    return Found(is + Question(largest, options_.units), &large_);
  }
  if (true_size && metres.maxCoeff() < kSpeck) {
    return Found(is + Question(largest, options_.units), &small_);
  }
  const bool too_wide = score != nullptr && score->status == GraspabilityStatus::kNoGrasps &&
                        2 * score->rejected.Of(kTooWide) > score->attempts;
  if (!too_wide) return;
  Found(name + ": no grasp, everything is wider than the opening of " +
            LengthText(options_.jaw_opening) + " (" + BoxText(metres) + ")" +
            (true_size && metres.maxCoeff() > kMostHeld ? Question(largest, options_.units) : ""),
        &wide_);
}

std::vector<std::string> UnlikelySizes::Texts() const {
  std::vector<std::string> texts;
  for (const Finding* finding : {&large_, &small_, &wide_}) {
    if (finding->first.empty()) continue;
    texts.push_back(finding->first +
                    (finding->more > 0 ? " (and " + std::to_string(finding->more) + " more)" : ""));
  }
  return texts;
}

}  // namespace antigrasp
