#include "antigrasp/models/shape_generator.h"

#include "antigrasp/models/generator.h"
#include "antigrasp/models/solid_generator.h"

namespace antigrasp {

std::shared_ptr<ShapeGenerator> MakeGenerator(const ModelOptions& options) {
  if (options.kind == ModelKind::kSolids) return std::make_shared<SolidGeneratorImpl>(options);
  return std::make_shared<GeneratorImpl>(options);
}

}  // namespace antigrasp
