#include "antigrasp/train/run_config.h"

#include "antigrasp/core/error.h"

namespace antigrasp {

void Bind(OptionTable* table, CemOptions* o) {
  table->Add("cem.mode", &o->mode,
             "what an episode adapts to the elites: the networks, or the distribution of z");
  table->Add("cem.episodes", &o->episodes, 0, 1000, "resampling rounds after episode 0");
  table->Add("cem.prior_iterations", &o->prior_iterations, 1, 1e8, "GAN updates in episode 0");
  table->Add("cem.iterations", &o->iterations, 1, 1e8, "GAN updates in every later episode");
  table->Add("cem.samples", &o->samples, 1, 1e6, "objects sampled per episode");
  table->Add("cem.keep", &o->keep, 1, 1e6, "elites kept per episode");
  table->Add("cem.variant", &o->variant,
             "elites: the least graspable of all, of every cell of the prior set, or those unlike "
             "all that are less graspable");
  table->Add("cem.cells", &o->cells, 1, 1e5, "cells of the stratified variant");
  table->Add("cem.neighbours", &o->neighbours, 1, 1e5,
             "less graspable samples that one of the diverse variant is compared with");
  table->Add("cem.spread", &o->spread, 0, 100,
             "keep no sample farther from the prior set than this percentage of its own shapes are "
             "from each other; 0 = any");
  table->Add("cem.step", &o->step, 1e-3, 1,
             "latent mode: standard deviation of z around an elite's; 1 forgets the elites");
  table->Add("cem.part_step", &o->part_step, 0, 10,
             "latent mode of solids: how far a refining trial moves the numbers of the parts");
  table->Add("cem.select", &o->select, "keep the least graspable, or random ones (the control)");
  table->Add(
      "cem.score", &o->score, {},
      "who scores samples: epsilon, settled, trial, trial:PROTOCOL or judge:COMMAND, a program");
  table->Add("cem.restart", &o->restart, "fresh networks each episode instead of going on");
  table->Add("cem.redistance", &o->redistance,
             "train on the exact distances to the elites' meshes, not on the generator's values");
  table->Add("cem.refine_steps", &o->refine_steps, 0, 1e6,
             "steps of the search that changes every elite before it is learnt from; latent mode: "
             "trials that move its parts; 0 = none");
  table->Add("cem.refine_niches", &o->refine_niches, 0, 1e6,
             "latent mode: shapes of the prior set by which elites compete in those trials, each "
             "in the niche of the nearest; 0 = each for itself");
  table->Add("cem.refine_admits", &o->refine_admits, 0, 100,
             "with niches: the percentile of the elites' scores up to which a trial comes in where "
             "there is room, beyond it only if it scores lower than what goes; 100 = whatever it "
             "scores");
  table->Add("cem.refine_hausdorff", &o->refine_hausdorff, 0.1, 50,
             "how far that may move its surface, percent of the bounding box's diagonal");
  table->Add("cem.prior_fraction", &o->prior_fraction, 0, 10,
             "prior shapes (latent mode: fresh z) mixed into the elites, as a share of them");
  table->Add("cem.check_self_intersection", &o->check_self_intersection,
             "test every mesh for self-intersection");
  table->Add("cem.control", &o->control, "also run the random-keep control from episode 0");
  table->Add("cem.prior_scored", &o->prior_scored, 0, 1e6,
             "prior shapes scored as the reference of kappa; 0 = all");
  table->Add("cem.compared", &o->compared, 2, 5000,
             "shapes per side behind coverage and near-duplicates");
  table->Add("cem.checkpoint_every", &o->checkpoint_every, 1, 1e8,
             "GAN updates between checkpoints");
}

void Bind(OptionTable* table, RunConfig* c) {
  table->Add("run.seed", &c->seed, "seed of every random stream");
  table->Add("run.threads", &c->threads, 0, 1024, "threads; 0 = all");
  table->Add(
      "run.torch_threads", &c->torch_threads, 0, 1024,
      "threads of training; 0 = run.threads; the same bytes for any number, but with residual "
      "blocks, bfloat16 and widths that 8 does not divide for the same number");
  table->Add("run.device", &c->device, {}, "device of the networks: cpu, cuda, cuda:1");
  table->Add("run.stl_count", &c->stl_count, 0, 10000, "least graspable objects exported as STL");
  table->Add("run.stl_size_mm", &c->stl_size_mm, 1, 10000, "their largest extent, mm");
  table->Add("run.start", &c->start, {},
             "checkpoint or name of pretrained networks in place of training episode 0");
  table->Add("run.fine_tune", &c->fine_tune,
             "train the networks of run.start on in episode 0, cem.prior_iterations updates");
  table->Add("prior.file", &c->prior_file, {}, "SDF file of the prior set; empty = make one");
  table->Add("prior.kind", &c->prior.kind, PriorSetKinds(), "set to make");
  table->Add("prior.count", &c->prior.count, 1, 1e6, "shapes to make");
  table->Add("prior.seed", &c->prior.seed, "seed of the set");
  Bind(table, &c->model);
  Bind(table, &c->gan);
  Bind(table, &c->cem);
  Bind(table, &c->metric);
}

std::string ToToml(const RunConfig& config) {
  RunConfig copy = config;
  OptionTable table;
  Bind(&table, &copy);
  return table.Dump();
}

RunConfig FromToml(const std::string& toml, const std::string& origin) {
  RunConfig config;
  OptionTable table;
  Bind(&table, &config);
  table.ApplyText(toml, origin);
  return config;
}

RunConfig NetworksFromToml(const std::string& toml, const std::string& origin) {
  RunConfig config;
  OptionTable table;
  Bind(&table, &config);
  int retired = 0;  // sized the mixture of z, which now has the size it was saved with
  table.Add("model.components", &retired, 1, 1000, "");
  table.ApplyKnown(toml, origin, "model.");
  CheckResolution(config.model, origin);
  return config;
}

namespace {

// What is judged of turned solids are numbers of outlines, which have no mirror and are never
// upside down.
void CheckTurned(const GanOptions& gan, const std::string& origin) {
  if (gan.augment != Augmentation::kNone) {
    throw InputError("gan.augment = " + ChoiceName(gan.augment) + " with model.form = turned",
                     origin, "none");
  }
  if (gan.symmetries == Symmetries::kAroundZAndUp) {
    throw InputError("gan.symmetries = " + ChoiceName(gan.symmetries) + " with model.form = turned",
                     origin, "none or around_z");
  }
}

}  // namespace

void Validate(const RunConfig& config, const std::string& origin) {
  CheckResolution(config.model, origin);
  if (config.fine_tune && config.start.empty()) {
    throw InputError("run.fine_tune without run.start", origin, "networks to start from (--from)");
  }
  const std::string& score = config.cem.score;
  if (score != kEpsilonScore && score != "settled" && score != "trial" &&
      !score.starts_with("trial:") && !score.starts_with("judge:")) {
    throw InputError("cem.score = " + score, origin,
                     "epsilon, settled, trial, trial:PROTOCOL or judge:COMMAND");
  }
  if (config.cem.keep > config.cem.samples) {
    throw InputError("cem.keep = " + std::to_string(config.cem.keep), origin,
                     "at most cem.samples = " + std::to_string(config.cem.samples));
  }
  const bool latent = config.cem.mode == EpisodeMode::kLatent;
  if (config.cem.part_step > 0.0 && !(latent && config.model.kind == ModelKind::kSolids)) {
    throw InputError("cem.part_step with cem.mode = " + ChoiceName(config.cem.mode) +
                         " and model.kind = " + ChoiceName(config.model.kind),
                     origin, "0, or cem.mode = latent and model.kind = solids");
  }
  if (config.cem.refine_steps > 0 && latent && !(config.cem.part_step > 0.0)) {
    throw InputError("cem.refine_steps with cem.mode = latent", origin,
                     "cem.mode = gan, or cem.part_step > 0: in latent mode parts are refined");
  }
  if (config.cem.refine_niches > 0 && !RefinesParts(config.cem)) {
    throw InputError(
        "cem.refine_niches = " + std::to_string(config.cem.refine_niches), origin,
        "0, or cem.mode = latent and cem.refine_steps > 0: they are for parts that are refined");
  }
  if (config.cem.refine_admits < 100.0 && config.cem.refine_niches == 0) {
    throw InputError("cem.refine_admits below 100", origin,
                     "100, or cem.refine_niches > 0: it says what a niche with room lets in");
  }
  if (config.model.kind == ModelKind::kSolids && config.model.form == PartForm::kTurned) {
    CheckTurned(config.gan, origin);
  }
  if (config.gan.batch % config.model.pack != 0) {
    throw InputError("model.pack = " + std::to_string(config.model.pack), origin,
                     "a divisor of gan.batch = " + std::to_string(config.gan.batch));
  }
  const int parts = config.gan.micro_batches;
  if (parts > 0 && config.gan.batch % (parts * config.model.pack) != 0) {
    throw InputError("gan.micro_batches = " + std::to_string(parts), origin,
                     "a divisor of gan.batch / model.pack = " +
                         std::to_string(config.gan.batch / config.model.pack));
  }
}

}  // namespace antigrasp
