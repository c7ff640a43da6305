#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "antigrasp/core/options.h"
#include "antigrasp/core/parallel.h"
#include "antigrasp/quality/wrench_resistance.h"

namespace antigrasp {

// What a table of contacts need not say row by row, and how its wrenches are resisted. Lengths in
// the table's own unit.
struct ContactTableOptions {
  double friction = 0.5;         // without a column friction_coef
  int cone_edges = 8;            // num_cone_faces
  double finger_radius = 0.005;  // finger_radius
  double torque_scale = 1000.0;  // torque_scaling
  Torsion torsion = Torsion::kDexNet;
  WrenchResistanceOptions wrench;  // force_limit
};

// One grasp of a table.
struct ContactRow {
  std::string id;
  std::array<Contact, 2> contacts;  // normal_force 0 where the jaw slips
  Eigen::Vector3d com;
  WrenchModel model;
  TangentFrames frames;
  std::optional<Wrench> target;
  double force_limit = 0.0;
};

// Reads grasps of two contacts, columns found by name and others ignored. Needed: p1x ... p2z (the
// points), n1x ... n2z (OUTWARD normals of any length), comx comy comz. Optional: id (else the
// number of the row); friction_coef, num_cone_faces, finger_radius, torque_scaling, force_limit;
// in1x ... in2z (direction each jaw closes in, with has_in_direction 0 or 1 if there is such a
// column; a jaw that slips gives no force); t1c1_x ... t1c2_z (first edge of each friction pyramid;
// TangentFrame otherwise); wfx wfy wfz (force) and wtx wty wtz (torque, 0 otherwise) of the wrench
// to resist. In in* and t1c* nan or nothing means not given. InputError with file:line and column
// for anything else.
std::vector<ContactRow> ReadContactTable(const std::filesystem::path& path,
                                         const ContactTableOptions& options);

struct ContactRowQuality {
  double epsilon = 0.0;
  bool force_closure = false;                  // Dex-Net's: either sign of the normals
  bool force_closure_signed = false;           // outward normals
  std::optional<WrenchResistance> resistance;  // of rows with a target
};

// The row's force limit counts, not the one of the options.
ContactRowQuality EvaluateContacts(const ContactRow& row, const WrenchResistanceOptions& options);

// Of all rows, on `threads` threads (0 = all), which no value depends on.
std::vector<ContactRowQuality> EvaluateAllContacts(const std::vector<ContactRow>& rows,
                                                   const WrenchResistanceOptions& options,
                                                   int threads,
                                                   const ProgressFn& progress = nullptr);

// One row a grasp: what `quality` writes of it.
std::string ContactCsv(const std::vector<ContactRow>& rows,
                       const std::vector<ContactRowQuality>& qualities);
// "2 grasps: 2 with epsilon > 0, 2 in force closure, 1 of 2 wrenches resisted", one line.
std::string ContactSummary(const std::vector<ContactRowQuality>& qualities);

void Bind(OptionTable* table, ContactTableOptions* options);  // keys "contact.*", "wrench.*"

}  // namespace antigrasp
