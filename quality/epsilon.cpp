#include "antigrasp/quality/epsilon.h"

#include <cmath>

#include "antigrasp/core/check.h"
#include "antigrasp/quality/epsilon_closed_form.h"
#include "antigrasp/quality/epsilon_general.h"
#include "antigrasp/quality/wrench_dual.h"

namespace antigrasp {
namespace {

// The torsion pairs put the origin on the hull even without force closure: a distance below this is
// rounding, not a grasp.
constexpr double kInsideDepth = 1e-10;

}  // namespace

double Epsilon(const std::array<Contact, 2>& contacts, const Eigen::Vector3d& com,
               const WrenchModel& model, const std::optional<TangentFrames>& frames) {
  AG_CHECK(model.cone_edges >= 3, "a friction cone needs at least 3 edges");
  const auto map = MakeDualMap(
      contacts, com, model,
      frames ? *frames
             : TangentFrames{TangentFrame(-contacts[0].normal), TangentFrame(-contacts[1].normal)});
  if (!map) return 0.0;
  std::optional<double> norm2 = MaxNorm2ClosedForm(*map);
  if (!norm2) norm2 = MaxNorm2General(MakeWrenchDual(*map));
  if (!norm2 || !(*norm2 > 0.0)) return 0.0;
  const double epsilon = 1.0 / std::sqrt(*norm2);
  return epsilon > kInsideDepth ? epsilon : 0.0;
}

}  // namespace antigrasp
