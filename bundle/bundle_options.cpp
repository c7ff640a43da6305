#include "antigrasp/bundle/bundle_options.h"

namespace antigrasp {

void Bind(OptionTable* table, BundleOptions* options) {
  table->Add("bundle.parts", &options->parts, 1, kMostParts, "convex parts of an object, at most");
  table->Add("bundle.density", &options->density, 1.0, 1e5, "kg/m3");
  table->Add("bundle.mass", &options->mass, 0.0, 1e3, "kg, of every object; 0: by the density");
  table->Add("bundle.friction", &options->friction, 0.0, 10.0,
             "coefficient that a pair with the object has");
  table->Add("bundle.min_extent", &options->min_extent, 1e-4, 10.0,
             "smallest extent after rescaling, m");
}

}  // namespace antigrasp
