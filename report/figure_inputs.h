#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "antigrasp/core/observer.h"
#include "antigrasp/quality/metric_options.h"
#include "antigrasp/report/figures/grasp_figure.h"
#include "antigrasp/report/figures/row_figure.h"
#include "antigrasp/report/figures/sdf_figure.h"
#include "antigrasp/report/figures/trial_figure.h"
#include "antigrasp/train/make_gan.h"

namespace antigrasp {

// What the commands `figure 1` to `figure 4` and `figure trial` draw, read from what other commands
// wrote. Bad input is an InputError; a number that is missing or none is a gap.

// Objects with their grasps, all under the same random numbers. Objects of one name are told apart
// by their folders. `labels`: instead of the names, none or one an object.
std::vector<GraspedObject> GraspedObjects(const std::vector<std::string>& inputs,
                                          const std::vector<std::string>& labels,
                                          const MetricOptions& metric, std::uint64_t seed,
                                          int threads, RunObserver* observer);
// "25 most robust of 100 sampled grasps, friction cone of 26.6 degrees", of figure 1.
std::string GraspCaption(int shown, const MetricOptions& metric);
// perturb's history.csv, one history an object, in the file's order.
std::vector<PairHistory> ReadHistories(const std::filesystem::path& path);

// The one object of the input in the unit cube, centred, and on a grid of so many nodes a side.
SdfFigure SdfFigureOf(const std::string& input, int resolution, int threads);

// One row a folder that `antigrasp perturb` wrote: so many objects before and after, those whose
// change is nearest to the median, and all graspabilities divided by the originals' mean.
RowFigure PerturbFigure(const std::vector<std::string>& folders,
                        const std::vector<std::string>& labels, int examples);

// One row a stage of a run that `antigrasp train` wrote: the first so many usable objects (made
// again from the stage's checkpoint) and all graspabilities divided by the mean of episode 0, or of
// the prior set while there is no episode 0. `episodes`: those shown; empty = all that the run is
// to have. Stages that are not there yet are gaps. `make`: the shape model that the run was started
// with.
RowFigure RunFigure(const std::filesystem::path& run, std::vector<int> episodes, int examples,
                    int threads, RunObserver* observer, const ShapeModelMaker& make = MakeGan);

// Folders that `antigrasp trial --out` wrote by one judge: all grasps, at each friction, load and
// kind of mass.
TrialFigure TriedFigure(const std::vector<std::string>& folders);

}  // namespace antigrasp
