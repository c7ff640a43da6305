#include "antigrasp/quality/contact_table.h"

#include <Eigen/Geometry>
#include <cmath>
#include <cstdio>
#include <limits>

#include "antigrasp/core/csv_reader.h"
#include "antigrasp/core/csv_writer.h"
#include "antigrasp/core/error.h"
#include "antigrasp/core/format.h"
#include "antigrasp/quality/force_closure.h"

namespace antigrasp {
namespace {

using Eigen::Vector3d;

constexpr double kUnit = 1e-6;  // how far a given t1 may be from a unit vector across its normal

// The columns of a table and typed access to the fields of its current row.
class Table {
 public:
  explicit Table(const std::filesystem::path& path) : csv_(path), path_(path.string()) {
    std::string missing;
    for (const char* prefix : {"p1", "n1", "p2", "n2", "com"}) {
      for (const char* axis : {"x", "y", "z"}) {
        if (!Has(std::string(prefix) + axis)) missing += std::string(" ") + prefix + axis;
      }
    }
    if (!missing.empty()) {
      throw InputError("no column" + missing, path_, "p1x ... n2z and comx comy comz");
    }
    for (const char* prefix : {"in1", "in2", "t1c1_", "t1c2_", "wf", "wt"}) HasVector(prefix);
    if (HasVector("in1") != HasVector("in2")) {
      throw InputError("a closing direction of one contact", path_, "columns of in1 and in2");
    }
    if (Has("has_in_direction") && !HasVector("in1")) {
      throw InputError("column has_in_direction", path_, "columns in1x ... in2z beside it");
    }
  }

  bool Next() { return csv_.Next(); }
  bool Has(const std::string& name) const { return csv_.Column(name).has_value(); }

  bool HasVector(const std::string& prefix) const {
    const int found = Has(prefix + "x") + Has(prefix + "y") + Has(prefix + "z");
    if (found != 0 && found != 3) {
      throw InputError("columns of " + prefix, path_,
                       "all or none of " + prefix + "x, " + prefix + "y, " + prefix + "z");
    }
    return found == 3;
  }

  const std::string& Text(const std::string& name) const {
    return csv_.Field(csv_.Column(name).value());
  }

  double Number(const std::string& name, double low, double high) const {
    const std::optional<double> value = csv_.Number(csv_.Column(name).value());
    if (!value || !(*value >= low && *value <= high) || std::isinf(*value)) {
      const bool any = std::isinf(low) && std::isinf(high);
      Refuse(name, any ? "a finite number"
                       : "a number in [" + FormatDouble(low) + ", " + FormatDouble(high) + "]");
    }
    return *value;
  }
  double Number(const std::string& name, double low, double high, double otherwise) const {
    return Has(name) ? Number(name, low, high) : otherwise;
  }

  Vector3d Vector(const std::string& prefix) const {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    Vector3d v;
    for (int k = 0; k < 3; ++k) v[k] = Number(prefix + "xyz"[k], -kInfinity, kInfinity);
    return v;
  }

  // nullopt when nothing or nan stands in all three fields, or there are no such columns.
  std::optional<Vector3d> OptionalVector(const std::string& prefix) const {
    if (!HasVector(prefix)) return std::nullopt;
    for (const char axis : {'x', 'y', 'z'}) {
      const std::size_t column = csv_.Column(prefix + axis).value();
      const std::optional<double> value = csv_.Number(column);
      const bool absent = csv_.Field(column).empty() || (value && std::isnan(*value));
      if (!absent) return Vector(prefix);
    }
    return std::nullopt;
  }

  Vector3d Direction(const std::string& prefix, const Vector3d& v) const {
    if (!(v.stableNorm() > 0.0)) Refuse(prefix + "x", "a direction that is not zero");
    return v.stableNormalized();
  }

  [[noreturn]] void Refuse(const std::string& name, const std::string& expected) const {
    throw InputError(name + " = " + Text(name), csv_.Where(), expected);
  }

 private:
  CsvReader csv_;
  std::string path_;
};

WrenchModel ReadModel(const Table& table, const ContactTableOptions& defaults) {
  WrenchModel model;
  model.friction = table.Number("friction_coef", 0.0, 10.0, defaults.friction);
  const double edges = table.Number("num_cone_faces", 3.0, 64.0, defaults.cone_edges);
  if (edges != std::floor(edges)) table.Refuse("num_cone_faces", "a whole number");
  model.cone_edges = static_cast<int>(edges);
  model.finger_radius = table.Number("finger_radius", 0.0, 1e9, defaults.finger_radius);
  model.torque_scale = table.Number("torque_scaling", 1e-12, 1e12, defaults.torque_scale);
  model.torsion = defaults.torsion;
  return model;
}

std::array<Vector3d, 2> ReadFrame(const Table& table, const std::string& prefix,
                                  const Vector3d& inward) {
  const auto given = table.OptionalVector(prefix);
  if (!given) return TangentFrame(inward);
  if (std::abs(given->norm() - 1.0) > kUnit || std::abs(given->dot(inward)) > kUnit) {
    table.Refuse(prefix + "x", "a unit vector across the normal");
  }
  return {*given, inward.cross(*given)};
}

// The direction jaw i closes in; nullopt when the row gives none.
std::optional<Vector3d> ReadClosing(const Table& table, const std::string& prefix) {
  std::optional<Vector3d> direction = table.OptionalVector(prefix);
  if (table.Has("has_in_direction")) {
    const std::string& given = table.Text("has_in_direction");
    if (given != "0" && given != "1") table.Refuse("has_in_direction", "0 or 1");
    if (given == "0") return std::nullopt;
    if (!direction) direction = table.Vector(prefix);  // refuses what is missing
  }
  if (direction) direction = table.Direction(prefix, *direction);
  return direction;
}

ContactRow ReadRow(const Table& table, int number, const ContactTableOptions& options) {
  ContactRow row;
  row.id = table.Has("id") ? table.Text("id") : std::to_string(number);
  row.com = table.Vector("com");
  row.model = ReadModel(table, options);
  for (std::size_t i = 0; i < 2; ++i) {
    const std::string k = std::to_string(i + 1);
    Contact& contact = row.contacts[i];
    contact.point = table.Vector("p" + k);
    contact.normal = table.Direction("n" + k, table.Vector("n" + k));
    const Vector3d inward = -contact.normal;
    if (const auto closing = ReadClosing(table, "in" + k)) {
      const bool slips = Slips(inward, *closing, row.model.friction);
      contact.normal_force = slips ? 0.0 : std::max(closing->dot(inward), 0.0);
    }
    row.frames[i] = ReadFrame(table, "t1c" + k + "_", inward);
  }
  row.force_limit = table.Number("force_limit", 1e-9, 1e9, options.wrench.force_limit);
  if (table.HasVector("wf") || table.HasVector("wt")) {
    row.target.emplace(Wrench::Zero());
    if (table.HasVector("wf")) row.target->head<3>() = table.Vector("wf");
    if (table.HasVector("wt")) row.target->tail<3>() = table.Vector("wt");
  }
  return row;
}

}  // namespace

std::vector<ContactRow> ReadContactTable(const std::filesystem::path& path,
                                         const ContactTableOptions& options) {
  Table table(path);
  std::vector<ContactRow> rows;
  while (table.Next()) {
    rows.push_back(ReadRow(table, static_cast<int>(rows.size()) + 1, options));
  }
  return rows;
}

ContactRowQuality EvaluateContacts(const ContactRow& row, const WrenchResistanceOptions& options) {
  ContactRowQuality quality;
  quality.epsilon = Epsilon(row.contacts, row.com, row.model, row.frames);
  quality.force_closure = ForceClosure(row.contacts, row.model.friction, NormalSense::kLine);
  quality.force_closure_signed =
      ForceClosure(row.contacts, row.model.friction, NormalSense::kOutward);
  if (row.target) {
    WrenchResistanceOptions own = options;
    own.force_limit = row.force_limit;
    quality.resistance =
        ResistWrench(row.contacts, row.com, row.model, *row.target, own, row.frames);
  }
  return quality;
}

void Bind(OptionTable* table, ContactTableOptions* options) {
  ContactTableOptions& o = *options;
  table->Add("contact.friction", &o.friction, 0.0, 10.0,
             "friction coefficient, without a column friction_coef");
  table->Add("contact.cone_edges", &o.cone_edges, 3, 64,
             "edges of the friction pyramid, without a column num_cone_faces");
  table->Add("contact.finger_radius", &o.finger_radius, 0.0, 1e9,
             "soft finger contact radius, unit of length, without a column finger_radius");
  table->Add(
      "contact.torque_scale", &o.torque_scale, 1e-12, 1e12,
      "weight of torques against forces, 1 / unit of length, without a column torque_scaling");
  table->Add("contact.torsion", &o.torsion,
             "torsion of a contact: none, dexnet (pi r^2 mu) or uniform_pressure (2/3 r mu)");
  Bind(table, &o.wrench);
}

std::vector<ContactRowQuality> EvaluateAllContacts(const std::vector<ContactRow>& rows,
                                                   const WrenchResistanceOptions& options,
                                                   int threads, const ProgressFn& progress) {
  std::vector<ContactRowQuality> qualities(rows.size());
  ParallelFor(
      std::ssize(rows), threads,
      [&](std::int64_t i) {
        const auto slot = static_cast<std::size_t>(i);
        qualities[slot] = EvaluateContacts(rows[slot], options);
      },
      progress);
  return qualities;
}

std::string ContactCsv(const std::vector<ContactRow>& rows,
                       const std::vector<ContactRowQuality>& qualities) {
  CsvWriter csv({"id", "epsilon", "force_closure", "force_closure_signed", "wrench_resisted",
                 "wrench_resistance"});
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const ContactRowQuality& quality = qualities[i];
    csv.Text(rows[i].id).Number(quality.epsilon);
    csv.Count(quality.force_closure).Count(quality.force_closure_signed);
    if (quality.resistance) {
      csv.Count(quality.resistance->resisted).Number(quality.resistance->quality);
    } else {
      csv.Text("").Text("");
    }
    csv.EndRow();
  }
  return csv.text();
}

std::string ContactSummary(const std::vector<ContactRowQuality>& qualities) {
  int positive = 0, closed = 0, asked = 0, resisted = 0;
  for (const ContactRowQuality& quality : qualities) {
    positive += quality.epsilon > 0.0 ? 1 : 0;
    closed += quality.force_closure_signed ? 1 : 0;
    asked += quality.resistance ? 1 : 0;
    resisted += quality.resistance && quality.resistance->resisted ? 1 : 0;
  }
  char text[160];
  std::snprintf(
      text, sizeof text,
      "%zu grasps: %d with epsilon > 0, %d in force closure, %d of %d wrenches resisted\n",
      qualities.size(), positive, closed, resisted, asked);
  return text;
}

}  // namespace antigrasp
