#include "antigrasp/models/shape_discriminator.h"

#include <limits>

#include "antigrasp/models/discriminator.h"
#include "antigrasp/models/number_discriminator.h"

namespace antigrasp {

double ShapeDiscriminator::LargestSigma() { return std::numeric_limits<double>::quiet_NaN(); }

std::shared_ptr<ShapeDiscriminator> MakeDiscriminator(const ModelOptions& options) {
  if (options.kind == ModelKind::kSolids && options.form == PartForm::kTurned) {
    return std::make_shared<NumberDiscriminatorImpl>(options);
  }
  return std::make_shared<DiscriminatorImpl>(options);
}

}  // namespace antigrasp
