#include "antigrasp/export/print_check.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "antigrasp/core/check.h"
#include "antigrasp/export/overhang.h"
#include "antigrasp/export/rounding.h"
#include "antigrasp/export/wall_thickness.h"
#include "antigrasp/mesh/inspect.h"
#include "antigrasp/mesh/place.h"
#include "antigrasp/mesh/stable_poses.h"

namespace antigrasp {
namespace {

// Overhangs nearer to each other than this share of the surface, and contact areas nearer than this
// share of the larger, are equal: facets of one round side must not win by rounding.
constexpr double kEqualOverhang = 0.005;
constexpr double kEqualContact = 0.01;
// Probabilities nearer than this share, and upward axes nearer than this, differ by rounding.
constexpr double kEqualPose = 1e-4;
// Rounding is named in the notes when it leaves more than this share of the thinnest wall open.
constexpr double kMuchRounding = 0.05;

struct Candidate {
  StablePose pose;
  Overhang overhang;
};

TriangleMesh Turned(const TriangleMesh& mesh, const Eigen::Matrix3d& rotation) {
  TriangleMesh turned = mesh;
  for (Eigen::Vector3d& v : turned.vertices) v = rotation * v;
  return turned;
}

// Keeps the candidates whose value is at least that of the best less `slack`.
template <typename Value>
void KeepBest(double slack, const Value& value, std::vector<Candidate>* candidates) {
  double best = value(candidates->front());
  for (const Candidate& c : *candidates) best = std::max(best, value(c));
  std::erase_if(*candidates, [&](const Candidate& c) { return value(c) < best - slack; });
}

bool FirstInOrder(const StablePose& a, const StablePose& b) {
  for (int k = 0; k < 3; ++k) {
    const double difference = a.table_from_object(2, k) - b.table_from_object(2, k);
    if (std::abs(difference) > kEqualPose) return difference < 0.0;
  }
  return false;
}

// The likeliest among those that nothing else tells apart. The poses of a symmetric object are
// equally likely but for rounding, which must not choose.
Candidate BestPose(std::vector<Candidate> candidates) {
  KeepBest(
      kEqualOverhang, [](const Candidate& c) { return -c.overhang.share; }, &candidates);
  double contact = 0.0;
  for (const Candidate& c : candidates) contact = std::max(contact, c.overhang.contact_area);
  KeepBest(
      kEqualContact * contact, [](const Candidate& c) { return c.overhang.contact_area; },
      &candidates);
  Candidate best = *std::min_element(
      candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) {
        return a.pose.com_height < b.pose.com_height * (1.0 - kEqualContact);
      });
  const StablePose likeliest = best.pose;
  for (const Candidate& c : candidates) {
    const bool equal = std::abs(c.pose.com_height / likeliest.com_height - 1.0) < kEqualPose &&
                       std::abs(c.pose.probability / likeliest.probability - 1.0) < kEqualPose;
    if (equal && FirstInOrder(c.pose, best.pose)) best = c;
  }
  return best;
}

std::string Text(const char* format, double first, double second = 0.0) {
  char text[200];
  std::snprintf(text, sizeof text, format, first, second);
  return text;
}

std::vector<std::string> Notes(const PrintCheck& check, const PrintOptions& options) {
  std::vector<std::string> notes;
  if (!check.why_not_solid.empty()) notes.push_back("Not a solid: " + check.why_not_solid + ".");
  if (check.voids > 0) {
    notes.push_back(
        (check.voids == 1 ? std::string("A void is") : std::to_string(check.voids) + " voids are") +
        " closed in: powder, resin or support stays inside.");
  }
  if (check.thin) {
    notes.push_back(
        Text("The thinnest wall is %.2g mm, below %g mm; ", *check.wall_mm, options.min_wall_mm) +
        Text("%.1f %% of the surface belongs to such walls.", 100.0 * check.thin_share));
  }
  if (check.pose_probability <= 0.0) notes.emplace_back("No stable pose: shown as it is.");
  if (check.overhang_share > options.max_overhang) {
    notes.push_back(
        Text("%.0f %% of the surface hangs over by more than %g degrees and needs "
             "support.",
             100.0 * check.overhang_share, options.overhang_angle));
  }
  const double least = std::sqrt(options.min_contact_mm2);
  if (std::sqrt(check.contact_mm2) < least - LengthSlack(least, check.rounding_mm)) {
    notes.push_back(Text("Only %.2g mm2 lie on the plate: print it on a raft.", check.contact_mm2));
  }
  const double open = LengthSlack(0.0, check.rounding_mm);
  if (open > kMuchRounding * options.min_wall_mm) {
    notes.push_back(
        Text("Lengths are known to %.2g mm: single precision, far from the origin.", open));
  }
  return notes;
}

}  // namespace

void Bind(OptionTable* table, PrintOptions* o) {
  table->Add("print.min_wall_mm", &o->min_wall_mm, 0.0, 1000.0,
             "walls below this are named in the notes, mm");
  table->Add("print.overhang_angle", &o->overhang_angle, 0.0, 90.0,
             "steepest underside that is printed without support, degrees from vertical");
  table->Add("print.max_overhang", &o->max_overhang, 0.0, 1.0,
             "share of the surface that may hang over before the notes name it");
  table->Add("print.layer_mm", &o->layer_mm, 0.0, 10.0,
             "what lies within the first layer rests on the plate, mm");
  table->Add("print.opposite_angle", &o->opposite_angle, 0.0, 89.0,
             "how far the two sides of a wall may be from parallel, degrees");
  table->Add("print.min_probability", &o->min_probability, 0.0, 1.0,
             "likelier stable poses are considered for printing");
  table->Add("print.min_contact_mm2", &o->min_contact_mm2, 0.0, 1e6,
             "area on the plate below which the notes ask for a raft, mm2");
}

PrintCheck CheckPrint(const TriangleMesh& as_it_lies, double size_mm, const PrintOptions& options) {
  const Eigen::Vector3d place = RoundPlace(as_it_lies);
  const TriangleMesh mesh = Transformed(as_it_lies, 1.0, Eigen::Vector3d::Zero() - place);
  const double rounding = RoundedBy(as_it_lies);
  const Eigen::Vector3d extent = Bounds(mesh).Extent();
  AG_CHECK(extent.maxCoeff() > 0.0, "a mesh with a positive extent");
  PrintCheck check;
  check.mm_per_unit = size_mm / extent.maxCoeff();
  check.size_mm = check.mm_per_unit * extent;
  check.rounding_mm = check.mm_per_unit * rounding;
  const MeshReport report = Inspect(mesh);
  check.watertight = report.closed && report.outward;
  check.why_not_solid = WhyNotSolid(report);
  check.voids = report.voids;

  WallOptions wall_options;
  wall_options.opposite_angle = options.opposite_angle;
  const double thin_mm = options.min_wall_mm - LengthSlack(options.min_wall_mm, check.rounding_mm);
  wall_options.thin = thin_mm / check.mm_per_unit;
  wall_options.rounding = rounding;
  const WallThickness walls = MeasureWalls(mesh, wall_options);
  if (walls.smallest) check.wall_mm = *walls.smallest * check.mm_per_unit;
  check.thin = walls.smallest && *walls.smallest < wall_options.thin;
  check.wall_at = walls.at + place;
  check.thin_share = walls.thin_share;

  std::vector<Candidate> candidates;
  const auto consider = [&](const StablePose& pose) {
    candidates.push_back({pose, MeasureOverhang(mesh, pose.table_from_object.row(2).transpose(),
                                                options.overhang_angle,
                                                options.layer_mm / check.mm_per_unit, rounding)});
  };
  double least_likely = options.min_probability;  // always the likeliest, and what equals it
  for (const StablePose& pose : StablePoses(mesh, CenterOfMass(mesh))) {
    if (candidates.empty()) least_likely = std::min(least_likely, pose.probability);
    if (pose.probability >= (1.0 - kEqualPose) * least_likely) consider(pose);
  }
  if (candidates.empty()) consider(StablePose());
  const Candidate best = BestPose(std::move(candidates));
  check.table_from_object = best.pose.table_from_object;
  check.pose_probability = best.pose.probability;
  check.overhang_share = best.overhang.share;
  check.contact_mm2 = best.overhang.contact_area * check.mm_per_unit * check.mm_per_unit;
  check.print_size_mm = check.mm_per_unit * Bounds(Turned(mesh, check.table_from_object)).Extent();
  check.notes = Notes(check, options);
  return check;
}

TriangleMesh PlacedForPrint(const TriangleMesh& mesh, const PrintCheck& check,
                            const Eigen::Matrix3d& table_from_object) {
  const TriangleMesh turned = Turned(mesh, table_from_object);
  const BoundingBox box = Bounds(turned);
  const Eigen::Vector3d stand(box.Center().x(), box.Center().y(), box.min.z());
  return Transformed(turned, check.mm_per_unit, -check.mm_per_unit * stand);
}

}  // namespace antigrasp
