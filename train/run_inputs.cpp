#include "antigrasp/train/run_inputs.h"

#include <sstream>

#include "antigrasp/checkpoints/checkpoint.h"
#include "antigrasp/checkpoints/pretrained.h"
#include "antigrasp/core/error.h"
#include "antigrasp/datasets/prior_set.h"

namespace antigrasp {
namespace {

namespace fs = std::filesystem;

std::string ModelToml(ModelOptions model) {
  OptionTable table;
  Bind(&table, &model);
  return table.Dump();
}

// Networks to start from must be those the configuration describes.
void RequireSameModel(const RunConfig& config, const RunConfig& start) {
  std::istringstream ours_lines(ModelToml(config.model)), theirs_lines(ModelToml(start.model));
  for (std::string ours, other; std::getline(ours_lines, ours);) {
    std::getline(theirs_lines, other);
    if (ours != other) {
      const auto setting = [](const std::string& line) { return line.substr(0, line.find("  #")); };
      throw InputError("model." + setting(ours), config.start,
                       setting(other) + ", as these networks have it");
    }
  }
}

// The shapes that networks have learnt: a kind that antigrasp makes, whatever their number and
// seed, also from a file, or a file of others.
bool SamePrior(const RunConfig& config, const RunConfig& start) {
  if (!config.prior_file.empty() && config.prior_file == start.prior_file) return true;
  const std::string kind =
      config.prior_file.empty() ? config.prior.kind : ReadShapeSetInfo(config.prior_file).kind;
  return start.prior_file.empty() && kind == start.prior.kind;
}

// Networks that have not seen the prior set are no episode 0 of it, unless they are trained on.
void RequireSamePrior(const RunConfig& config, const RunConfig& start) {
  if (config.fine_tune || SamePrior(config, start)) return;
  const auto setting = [](const RunConfig& c) {
    return c.prior_file.empty() ? "prior.kind=" + c.prior.kind : "prior.file=" + c.prior_file;
  };
  throw InputError("networks of another prior set than " + setting(config),
                   "run.start = " + config.start,
                   "--fine-tune to train them on with it first, --from-scratch for new ones, or "
                   "--set " +
                       setting(start) + ", which they have learnt");
}

}  // namespace

ShapeSet PriorOf(const RunConfig& config, RunObserver* observer, const PriorMaker& make) {
  if (!config.prior_file.empty()) return ReadShapeSet(config.prior_file);
  PriorSetOptions options = config.prior;
  options.resolution = config.model.resolution;
  options.threads = config.threads;
  const ProgressFn progress =
      observer->Phase("making " + std::to_string(options.count) + " " + options.kind);
  return make ? make(options, progress) : MakePriorSet(options, progress);
}

void RequireFittingStart(const RunConfig& config) {
  if (config.start.empty()) return;
  const fs::path path = FindNetworks(config.start);
  const RunConfig start = NetworksFromToml(ReadCheckpoint(path).config, path.string());
  RequireSameModel(config, start);
  RequireSamePrior(config, start);
}

}  // namespace antigrasp
