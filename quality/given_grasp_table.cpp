#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "antigrasp/core/csv_reader.h"
#include "antigrasp/core/error.h"
#include "antigrasp/quality/given_grasps.h"

namespace antigrasp {
namespace {

using Eigen::Vector3d;

// Columns of a vector: "axis_x" or "p1x".
using Columns = std::array<std::size_t, 3>;

class Rows {
 public:
  explicit Rows(const std::filesystem::path& path) : csv_(path), path_(path.string()) {
    const auto first = Find("p1"), second = Find("p2");
    const bool has_contacts = first && second;
    if (has_contacts) contacts_ = {*first, *second};
    center_ = Find("center_");
    axis_ = Find("axis_");
    approach_ = Find("approach_");
    if (!has_contacts && (!center_ || !axis_)) {
      throw InputError(std::string("no columns ") + (center_ ? "axis_x axis_y axis_z" : kCenter),
                       path_, "a centre and an axis, or the contacts p1x ... p2z");
    }
    if (csv_.Column("metres_per_unit") && !csv_.Column("frame")) {
      throw InputError("no column frame", path_,
                       "frame (mesh or metres), as evaluate --grasps writes it since it says so");
    }
  }

  bool Next() { return csv_.Next(); }

  GivenGrasp Row(std::map<std::string, std::uint64_t>* rows_of) const {
    GivenGrasp grasp;
    grasp.object = Text("object").value_or("");
    const std::uint64_t number = (*rows_of)[grasp.object]++;
    grasp.id = Text("grasp").value_or(std::to_string(number));
    grasp.frame = Frame();
    if (csv_.Column("metres_per_unit")) grasp.metres_per_unit = Number("metres_per_unit");
    grasp.says_scale = csv_.Column("metres_per_unit") && grasp.metres_per_unit > 0.0 &&
                       std::isfinite(grasp.metres_per_unit);
    const Vector3d p1 = contacts_ ? Vector(contacts_->first) : Vector3d::Zero();
    const Vector3d p2 = contacts_ ? Vector(contacts_->second) : Vector3d::Zero();
    grasp.center = center_ ? Vector(*center_) : Vector3d(0.5 * (p1 + p2));
    grasp.axis = axis_ ? Vector(*axis_) : Vector3d(p2 - p1);
    if (approach_ && !Empty(*approach_)) grasp.approach = Vector(*approach_);
    grasp.width = Given("width") ? Number("width") : (p2 - p1).norm();
    grasp.of_a_candidate = Given("candidate");
    grasp.candidate = grasp.of_a_candidate ? Whole("candidate") : number;
    return grasp;
  }

 private:
  static constexpr const char* kCenter = "center_x center_y center_z";

  std::optional<Columns> Find(const std::string& head) const {
    Columns columns{};
    std::string there, missing;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::string name = head + "xyz"[k];
      const auto column = csv_.Column(name);
      (column ? there : missing) += " " + name;
      columns[k] = column.value_or(0);
    }
    if (missing.empty()) return columns;
    if (there.empty()) return std::nullopt;
    throw InputError("column" + there + " without" + missing, path_, "all three, or none");
  }
  std::optional<std::string> Text(const char* name) const {
    const auto column = csv_.Column(name);
    if (!column) return std::nullopt;
    return csv_.Field(*column);
  }
  // An empty cell is a number that was not given, "nan" one that is none.
  bool Given(const char* name) const { return !Text(name).value_or("").empty(); }
  bool Empty(const Columns& columns) const {
    return std::all_of(columns.begin(), columns.end(),
                       [this](std::size_t column) { return csv_.Field(column).empty(); });
  }
  double Number(const char* name) const { return csv_.NumberOrGap(csv_.Column(name).value()); }
  Vector3d Vector(const Columns& columns) const {
    return {csv_.NumberOrGap(columns[0]), csv_.NumberOrGap(columns[1]),
            csv_.NumberOrGap(columns[2])};
  }
  GraspFrame Frame() const {
    const auto text = Text("frame");
    if (!text) return GraspFrame::kMesh;
    const auto frame = FindChoice<GraspFrame>(*text);
    if (frame) return *frame;
    throw InputError("frame = " + *text, csv_.Where(), Alternatives(ChoiceNames<GraspFrame>()));
  }
  std::uint64_t Whole(const char* name) const {
    const double value = Number(name);
    if (value >= 0.0 && value < 1e15 && value == std::floor(value)) {
      return static_cast<std::uint64_t>(value);
    }
    throw InputError(name + (" = " + *Text(name)), csv_.Where(), "a whole number");
  }

  CsvReader csv_;
  std::string path_;
  std::optional<Columns> center_, axis_, approach_;
  std::optional<std::pair<Columns, Columns>> contacts_;
};

}  // namespace

std::vector<GivenGrasp> ReadGivenGrasps(const std::filesystem::path& path) {
  Rows rows(path);
  std::vector<GivenGrasp> grasps;
  std::map<std::string, std::uint64_t> rows_of;
  while (rows.Next()) grasps.push_back(rows.Row(&rows_of));
  if (grasps.empty()) throw InputError("no grasps", path.string(), "a row for every grasp");
  return grasps;
}

}  // namespace antigrasp
