#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "antigrasp/quality/graspability.h"
#include "antigrasp/quality/metric_options.h"

// At which size the metric looks at an object, and whether that size is believable (docs/metric.md,
// "Size and units").
namespace antigrasp {

// Whether objects keep their size (object_min_extent = 0).
bool AtTrueSize(const MetricOptions& options);

// The unit that meshes are turned into whose files know their own: metric.units where objects keep
// their size; else each is scaled anyway, and results stay in the file's.
std::optional<LengthUnit> UnitToReadIn(const MetricOptions& options);

// Metres per unit of a mesh whose bounding box has these extents (mesh's unit). Not finite when the
// smallest is 0 and objects are rescaled.
double MetresPerUnit(const MetricOptions& options, const Eigen::Vector3d& extent);

// "each scaled to a smallest extent of 40 mm" or "at true size (mm)".
std::string SizeText(const MetricOptions& options);

// A length for people, three digits: "120 m", "50 mm", "0.085 mm".
std::string LengthText(double metres);

// A sentence for every length of the metric that can hardly be in metres (an opening of more than
// one), and for a unit that has no effect.
std::vector<std::string> UnlikelyLengths(const MetricOptions& options,
                                         const TypedOption& typed = nullptr);

// Objects whose size speaks for another unit: at true size larger than a room (5 m) or smaller than
// a millimetre; at any size without a grasp because everything is wider than the jaws open.
class UnlikelySizes {
 public:
  explicit UnlikelySizes(const MetricOptions& options) : options_(options) {}
  // `extent` of the bounding box in the mesh's unit; `score` of an object that was scored.
  void Add(const std::string& name, const Eigen::Vector3d& extent,
           const Graspability* score = nullptr);
  // A sentence for each of the three: its first object, the likely unit, how many more.
  std::vector<std::string> Texts() const;

 private:
  struct Finding {
    std::string first;  // empty: none
    int more = 0;
  };
  void Found(const std::string& text, Finding* finding);

  MetricOptions options_;
  Finding large_, small_, wide_;
};

}  // namespace antigrasp
