// The page and figure 4 of a run whose shape model is not the GAN: spheres known on paper.
#include "antigrasp/report/run_report.h"

#include <gtest/gtest.h>
#include <torch/types.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "antigrasp/core/atomic_file.h"
#include "antigrasp/core/error.h"
#include "antigrasp/report/figure_inputs.h"
#include "antigrasp/report/page/payload.h"
#include "antigrasp/train/cem_run.h"
#include "tests/support/temp_folder.h"
#include "tests/train/sphere_model.h"
#include "tests/train/tiny_run.h"

namespace antigrasp {
namespace {

using nlohmann::json;
using shapes::MakeSpheres;
using shapes::StoppingObserver;
using shapes::TempFolder;

// Spheres of radius 0.25 make the prior set, so that those of every episode lie about 0.25.
RunConfig StartSpheres(const TempFolder& folder) {
  RunConfig config = shapes::Tiny();
  config.prior_file = (folder / "spheres.h5").string();
  config.cem.episodes = 1;
  config.cem.prior_iterations = 40;
  config.cem.iterations = 10;
  config.cem.control = true;
  ShapeSet set;
  set.kind = "import";
  for (int i = 0; i < 4; ++i) {
    SdfGrid grid = UnitCubeGrid();
    const torch::Tensor values = 0.25 - shapes::Radii(grid.n);
    grid.values.assign(values.data_ptr<float>(), values.data_ptr<float>() + values.numel());
    set.names.push_back("sphere-" + std::to_string(i));
    set.grids.push_back(grid);
  }
  WriteShapeSet(config.prior_file, set);
  StoppingObserver observer;
  StartRun(config, folder / "run", &observer, MakeSpheres);
  return config;
}

ReportSettings Settings() {
  ReportSettings settings;
  settings.per_stage = 4;
  settings.threads = 2;
  return settings;
}

TEST(RunReport, OfAnotherShapeModelHasItsScalarsAndTheObjectsItScored) {
  const TempFolder folder;
  StartSpheres(folder);
  StoppingObserver observer;
  const Report report = RunReport(RunFolder{folder / "run"}, Settings(), &observer, MakeSpheres);
  EXPECT_TRUE(report.missing.empty()) << report.missing.front();  // every object scores as it did
  const json data = json::parse(EncodeReport(report, {}).json);
  ASSERT_EQ(data["run"]["losses"].size(), 3U);  // episodes 0 and 1, and 1 of the control
  for (const json& losses : data["run"]["losses"]) {
    std::vector<std::string> names;
    for (const auto& [name, values] : losses["columns"].items()) names.push_back(name);
    std::sort(names.begin(), names.end());
    EXPECT_EQ(names, (std::vector<std::string>{"gap", "radius", "step"}));
  }
  EXPECT_EQ(data["run"]["losses"][0]["columns"]["step"], json::parse("[10, 20, 30, 40]"));
  ASSERT_EQ(data["groups"].size(), 3U);
  ASSERT_EQ(data["objects"].size(), 12U);
  for (const json& object : data["objects"]) {
    EXPECT_EQ(object["status"], "ok") << object["name"];
    // Radius 0.25 in the prior set, 0.25 (1 + tanh(z) / 5) in episode 0, once more that far from
    // the elites of it in episode 1.
    const double extent = object["mesh"]["extent"];
    EXPECT_NEAR(extent, 0.5,
                object["group"] == 0   ? 0.01
                : object["group"] == 1 ? 0.11
                                       : 0.23)
        << object["name"];
  }
}

TEST(RunReport, ByTheGanOfARunOfSpheresShowsItsTablesAndSaysWhatItCannot) {
  const TempFolder folder;
  StartSpheres(folder);
  StoppingObserver observer;
  const Report report = RunReport(RunFolder{folder / "run"}, Settings(), &observer);
  ASSERT_EQ(report.missing.size(), 2U);
  EXPECT_TRUE(report.missing[0].starts_with("episode 0: networks of another shape model ("))
      << report.missing[0];
  EXPECT_TRUE(report.missing[1].ends_with("its objects cannot be shown.")) << report.missing[1];
  ASSERT_EQ(report.groups.size(), 1U);
  EXPECT_EQ(report.groups[0].id, "prior");
  EXPECT_EQ(report.run->stages.size(), 4U);
  EXPECT_EQ(report.run->losses.size(), 3U);
}

TEST(RunFigure, OfAnotherShapeModelShowsItsSamples) {
  const TempFolder folder;
  StartSpheres(folder);
  StoppingObserver observer;
  const RowFigure figure = RunFigure(folder / "run", {}, 2, 2, &observer, MakeSpheres);
  ASSERT_EQ(figure.rows.size(), 3U);
  for (const FigureRow& row : figure.rows) {
    ASSERT_EQ(row.examples.size(), 2U) << row.label;
    for (const FigureExample& example : row.examples) {
      EXPECT_NEAR(Bounds(example.mesh).Extent().maxCoeff(), 0.5, 0.23);
    }
  }
  EXPECT_THROW(RunFigure(folder / "run", {}, 2, 2, &observer), OtherShapeModel);
}

}  // namespace
}  // namespace antigrasp
