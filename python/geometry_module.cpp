// antigrasp._geometry: all that needs no network. The package antigrasp is what people import.
#include "antigrasp/core/kernels.h"
#include "antigrasp/core/version.h"
#include "antigrasp/python/bindings.h"
#include "antigrasp/python/errors.h"

PYBIND11_MODULE(_geometry, module) {
  using namespace antigrasp::python;
  TranslateErrors();
  module.attr("version") = antigrasp::ProgramVersion();
  module.attr("commit") = antigrasp::ProgramCommit();
  module.def("ask_for_the_same_kernels_everywhere", &antigrasp::AskForTheSameKernelsEverywhere);
  BindMesh(module);
  BindGrid(module);
  BindMetric(module);
  BindEvaluate(module);
  BindGivenGrasps(module);
  BindEpsilon(module);
  BindTrial(module);
  BindPerturb(module);
  BindShapes(module);
  BindCompare(module);
}
