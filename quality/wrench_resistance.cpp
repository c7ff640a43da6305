#include "antigrasp/quality/wrench_resistance.h"

#include <vector>

#include "antigrasp/quality/limited_least_squares.h"

namespace antigrasp {
namespace {

// Keeps the quality finite where nothing has to be resisted.
constexpr double kNoForce = 1e-9;

// The contact whose limit each column of GraspMatrix counts against, or -1.
std::vector<int> ContactOfColumn(Eigen::Index columns, int edges, bool limit_cone_only) {
  std::vector<int> contact;
  for (int column = 0; column < columns; ++column) {
    const int torsion = column - 2 * edges;  // +T1, +T2, -T1, -T2
    contact.push_back(torsion < 0 ? column / edges : limit_cone_only ? -1 : torsion % 2);
  }
  return contact;
}

}  // namespace

WrenchResistance ResistWrench(const std::array<Contact, 2>& contacts, const Eigen::Vector3d& com,
                              const WrenchModel& model, const Wrench& target,
                              const WrenchResistanceOptions& options,
                              const std::optional<TangentFrames>& frames) {
  WrenchResistance result;
  if (!(contacts[0].normal_force > 0.0 && contacts[1].normal_force > 0.0)) return result;
  const auto wrenches = GraspMatrix(contacts, com, model, frames);
  Wrench wanted = target;
  if (options.metric_torque) wanted.tail<3>() *= model.torque_scale;
  if (options.oppose_target) wanted = -wanted;
  if (!wrenches.allFinite() || !wanted.allFinite()) return result;

  result.coefficients =
      Solve({wrenches, wanted, options.regularizer,
             ContactOfColumn(wrenches.cols(), model.cone_edges, options.limit_cone_only),
             options.force_limit});
  result.coefficient_norm = result.coefficients.norm();
  result.residual2 = (wrenches * result.coefficients - wanted).squaredNorm();
  result.resisted = result.residual2 < options.tolerance;
  if (result.resisted) {
    result.quality = 1.0 / (result.coefficient_norm + kNoForce) - 1.0 / (2.0 * options.force_limit);
  }
  return result;
}

void Bind(OptionTable* table, WrenchResistanceOptions* options) {
  WrenchResistanceOptions& o = *options;
  table->Add("wrench.force_limit", &o.force_limit, 1e-9, 1e9,
             "largest sum of a contact's force coefficients, N, without a column force_limit");
  table->Add("wrench.tolerance", &o.tolerance, 0.0, 1e9,
             "a wrench is resisted when the squared rest is below");
  table->Add("wrench.regularizer", &o.regularizer, 1e-14, 1.0,
             "weight of the squared coefficients against the squared rest");
  table->Add("wrench.oppose_target", &o.oppose_target,
             "the contacts give minus the target wrench, so as to hold against it "
             "(Dex-Net: plus)");
  table->Add("wrench.metric_torque", &o.metric_torque,
             "the target's torque is force times length (Dex-Net: that times the torque scale)");
  table->Add("wrench.limit_cone_only", &o.limit_cone_only,
             "torsion does not count against the force limit (Dex-Net: it does)");
}

}  // namespace antigrasp
