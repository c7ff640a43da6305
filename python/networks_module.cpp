// antigrasp._networks: what needs LibTorch. The package loads it when it is asked for.
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>
#include <torch/types.h>

#include "antigrasp/checkpoints/pretrained.h"
#include "antigrasp/core/kernels.h"
#include "antigrasp/judge/make_judge.h"
#include "antigrasp/models/sdf_values.h"
#include "antigrasp/perturb/hold_descent.h"
#include "antigrasp/python/arrays.h"
#include "antigrasp/python/errors.h"
#include "antigrasp/python/python_judge.h"
#include "antigrasp/python/step_observer.h"
#include "antigrasp/train/run_request.h"
#include "antigrasp/train/sample_set.h"
#include "antigrasp/train/statistics_table.h"
#include "antigrasp/train/stepped_run.h"

namespace antigrasp::python {
namespace {

using Released = py::call_guard<py::gil_scoped_release>;

// What ShapeSet is made of: values [N, n, n, n] and keywords.
py::tuple ShapesOfGrids(const std::vector<SdfGrid>& grids, const ShapeSet& about) {
  const py::ssize_t n = grids.empty() ? 0 : grids.front().n;
  py::array_t<float> values({static_cast<py::ssize_t>(grids.size()), n, n, n});
  float* to = values.mutable_data();
  for (const SdfGrid& grid : grids) to = std::copy(grid.values.begin(), grid.values.end(), to);
  py::dict more;
  more["names"] = about.names;
  more["kind"] = about.kind;
  more["seed"] = about.seed;
  more["provenance"] = about.provenance;
  more["truncation"] = about.truncation;
  return py::make_tuple(values, more);
}

py::tuple SampleNetworks(SampledNetworks* self, std::int64_t count, std::uint64_t seed,
                         std::int64_t first) {
  if (count < 1 || count > 1'000'000 || first < 0) {
    throw InputError("count = " + std::to_string(count) + ", first = " + std::to_string(first),
                     "sample", "whole numbers in [1, 1000000] and from 0");
  }
  std::vector<SdfGrid> grids;
  ShapeSet about = self->About(seed);
  {
    const py::gil_scoped_release released;
    constexpr std::int64_t kAtATime = 64;
    for (std::int64_t done = 0; done < count; done += kAtATime) {
      for (SdfGrid& grid : self->Sample(seed, first + done, std::min(kAtATime, count - done))) {
        grids.push_back(std::move(grid));
        about.names.push_back(SampleName(first + std::ssize(about.names)));
      }
      ThrowIfPythonWasInterrupted();
    }
  }
  return ShapesOfGrids(grids, about);
}

// A run, its observer and its judge, in the order in which they go.
struct RunObject {
  std::shared_ptr<StepObserver> observer;
  std::unique_ptr<Judge> judge;
  std::unique_ptr<SteppedRun> run;
  const Episode* episode = nullptr;  // the last one
};

std::unique_ptr<Judge> JudgeOfRun(const RunConfig& config, const py::object& function) {
  if (!function.is_none()) return JudgeOfFunction(function)();
  if (config.cem.score == kEpsilonScore) return nullptr;
  constexpr std::string_view kProgram = "judge:";
  std::string name = config.cem.score;
  if (name.starts_with(kProgram)) name.erase(0, kProgram.size());
  return MakeJudge(name, {config.metric,
                          AtEqualMass(),
                          {},
                          config.seed,
                          config.threads,
                          &ThrowIfPythonWasInterrupted});
}

TriangleMesh RefinedElite(const TriangleMesh& mesh, const RunConfig& config,
                          const BoundingBox& within, std::uint64_t seed) {
  DescentOptions options;
  options.steps = config.cem.refine_steps;
  options.budget.hausdorff = config.cem.refine_hausdorff;
  return RefinedSolid(mesh, config.metric, options, within, seed);
}

std::unique_ptr<RunObject> BeginRun(const std::string& config_file,
                                    const std::vector<std::string>& settings,
                                    const std::string& gripper, const std::string& start,
                                    bool fine_tune, const py::object& judge,
                                    const py::object& progress) {
  RunRequest request;
  request.config = config_file;
  request.overrides = settings;
  request.gripper = gripper;
  request.start = start;
  request.fine_tune = fine_tune;
  auto run = std::make_unique<RunObject>();
  run->observer = std::make_shared<StepObserver>(progress);
  const RunConfig config = ConfigOf(request);
  run->judge = JudgeOfRun(config, judge);
  const py::gil_scoped_release released;
  run->run =
      std::make_unique<SteppedRun>(config, run->observer.get(), run->judge.get(), &RefinedElite);
  return run;
}

// (number, values and keywords of the samples, scores, elites); None after the last.
py::object NextEpisode(RunObject* self) {
  {
    const py::gil_scoped_release released;
    self->episode = self->run->Next();
  }
  if (self->episode == nullptr) return py::none();
  const Episode& episode = *self->episode;
  const RunConfig& config = self->run->config();
  std::vector<SdfGrid> grids;
  ShapeSet about{.kind = "samples", .seed = StageSeed(config, episode.row.stage)};
  about.truncation = LargestDistance(config.model);
  about.provenance = "antigrasp.train, episode " + std::to_string(episode.row.stage);
  for (std::int64_t i = 0; i < episode.scored.values.size(0); ++i) {
    grids.push_back(GridOf(episode.scored.values[i], config.model));
    about.names.push_back(SampleName(i));
  }
  const py::tuple shapes = ShapesOfGrids(grids, about);
  return py::make_tuple(episode.row.stage, shapes[0], shapes[1],
                        ArrayOf(episode.scored.graspabilities), episode.selection.elites);
}

void BindRun(py::module_& module) {
  py::class_<RunObject>(module, "Run")
      .def("next", &NextEpisode)
      .def(
          "statistics", [](const RunObject& self) { return StatisticsToCsv(self.run->rows()); },
          "statistics.csv of the stages so far")
      .def("config", [](const RunObject& self) { return ToToml(self.run->config()); })
      .def(
          "save",
          [](const RunObject& self, const std::filesystem::path& path) { self.run->Save(path); },
          Released(), py::arg("path"));
  module.def("begin", &BeginRun, py::arg("config"), py::arg("settings"), py::arg("gripper"),
             py::arg("start"), py::arg("fine_tune"), py::arg("judge"), py::arg("progress"));
}

}  // namespace
}  // namespace antigrasp::python

PYBIND11_MODULE(_networks, module) {
  using namespace antigrasp;
  using namespace antigrasp::python;
  pybind11::module_::import("antigrasp._geometry");  // whose Mesh judges are shown
  TranslateErrors();
  pybind11::class_<SampledNetworks>(module, "Networks")
      .def(pybind11::init([](const std::string& networks, const std::string& device, int threads,
                             double fairing, double fairing_power) {
             SampleRequest request;
             request.networks = networks;
             request.device = device;
             request.threads = threads;
             request.fairing = fairing;
             request.fairing_power = fairing_power;
             return std::make_unique<SampledNetworks>(request);
           }),
           pybind11::arg("networks"), pybind11::arg("device"), pybind11::arg("threads"),
           pybind11::arg("fairing"), pybind11::arg("fairing_power"), Released())
      .def("path", &SampledNetworks::path)
      .def("config", [](const SampledNetworks& self) { return ToToml(self.config()); })
      .def("sample", &SampleNetworks, pybind11::arg("count"), pybind11::arg("seed"),
           pybind11::arg("first"));
  module.def("pretrained", [] { return PretrainedNames(); });
  BindRun(module);
}
