#include "antigrasp/train/gan_trainer.h"

#include <torch/utils.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <tuple>
#include <utility>
#include <vector>

#include "antigrasp/core/check.h"
#include "antigrasp/core/error.h"
#include "antigrasp/core/rng.h"
#include "antigrasp/models/few_bends.h"
#include "antigrasp/models/number_discriminator.h"
#include "antigrasp/models/sdf_values.h"
#include "antigrasp/train/adam.h"
#include "antigrasp/train/averaged_generator.h"
#include "antigrasp/train/captured_gradients.h"
#include "antigrasp/train/flat_gradients.h"
#include "antigrasp/train/network_tensors.h"
#include "antigrasp/train/outline_fit.h"
#include "antigrasp/train/shape_model.h"

namespace antigrasp {
namespace {

// Said plainly, before the first tensor that another model has not.
void RequireGan(const NamedTensors& state, const std::string& origin) {
  for (const auto& [name, tensor] : state) {
    if (name.starts_with("average/")) return;
  }
  throw OtherShapeModel("networks of another shape model", origin,
                        "those of a GAN (average/..., discriminator/...)");
}

}  // namespace

struct GanTrainer::Impl {
  Impl(const ModelOptions& model_options, const GanOptions& gan_options, std::uint64_t base_seed,
       torch::Device torch_device);

  void RestartNetworks(int episode_index);
  bool Fits() const;
  StepReport FitStep(const torch::Tensor& shapes);
  std::vector<GanPart> OwnParts(int update) const;
  LossAndGradients OverParts(std::vector<GanPart>* parts, const std::vector<torch::Tensor>& like,
                             const std::function<LossAndGradients(GanPart*)>& of_part);
  void UpdateDiscriminator(const LossAndGradients& found, StepReport* report);
  void UpdateGenerator(const LossAndGradients& found, StepReport* report);
  std::pair<double, double> FiniteLossAndNorm(const torch::Tensor& loss,
                                              const std::vector<torch::Tensor>& gradients) const;
  double LearningRateFactor() const;
  double AverageDecay() const;
  NamedTensors State(const torch::Tensor& progress, const LatentMixture& mixture) const;
  torch::Tensor Progress() const;  // [3] int64: episode, iterations, step
  void SetProgress(const torch::Tensor& progress);
  LatentMixture MixtureToTake(const NamedTensors& state) const;
  torch::Tensor Faired(const torch::Tensor& drawn) const;
  NamedTensors Networks(
      const LatentMixture& mixture) const;  // without what only goes on training needs

  ModelOptions model;
  GanOptions options;
  std::uint64_t seed;
  torch::Device device;
  std::shared_ptr<ShapeGenerator> generator;
  AveragedGenerator average;
  std::shared_ptr<ShapeDiscriminator> discriminator;
  Adam adam_generator, adam_discriminator;
  CapturedGradients gradients;
  std::unique_ptr<OutlineFit> fit;  // of turned solids
  LatentMixture latent;
  int episode = 0;
  std::int64_t iterations = 0, step = 0;
  WholeBatch alone;
  BatchShare* share = &alone;
};

GanTrainer::Impl::Impl(const ModelOptions& model_options, const GanOptions& gan_options,
                       std::uint64_t base_seed, torch::Device torch_device)
    : model(model_options),
      options(gan_options),
      seed(base_seed),
      device(torch_device),
      generator(MakeGenerator(model_options)),
      average(model_options, base_seed, torch_device),
      discriminator(MakeDiscriminator(model_options)),
      adam_generator((generator->to(device), generator->parameters()), options.beta1,
                     options.beta2),
      adam_discriminator((discriminator->to(device), discriminator->Trained()), options.beta1,
                         options.beta2),
      gradients(GanGradients(model, options, generator.get(), discriminator.get(), device), options,
                device),
      latent(StandardNormal(model.latent)) {
  if (auto* numbers = dynamic_cast<NumberDiscriminatorImpl*>(discriminator.get())) {
    fit = std::make_unique<OutlineFit>(model, numbers->encoder());
  }
  RestartNetworks(0);
}

void GanTrainer::Impl::RestartNetworks(int episode_index) {
  RngStream rng(seed, "networks", static_cast<std::uint64_t>(episode_index));
  generator->Initialize(&rng);
  discriminator->Initialize(&rng);
}

// Updates of the encoder come first, where it is not fitted: the first of an episode.
bool GanTrainer::Impl::Fits() const { return fit && !fit->encoder()->IsFitted(); }

StepReport GanTrainer::Impl::FitStep(const torch::Tensor& shapes) {
  const auto updates =
      std::max<std::int64_t>(std::llround(options.fit_share * static_cast<double>(iterations)), 1);
  auto& solids = dynamic_cast<SolidGeneratorImpl&>(*generator);
  const auto of_part = [&](GanPart* part) {
    return fit->Gradients(gradients.launched().RandomShapes(shapes, &part->rng), &solids);
  };
  const bool in_parts = options.micro_batches > 0;
  std::vector<GanPart> parts;
  if (in_parts) {
    parts = OwnParts(0);
  } else {
    parts.push_back({RngStream(seed, "outlines", static_cast<std::uint64_t>(episode),
                               static_cast<std::uint64_t>(step)),
                     {},
                     {}});
  }
  const LossAndGradients found =
      in_parts ? OverParts(&parts, fit->adam().parameters(), of_part) : of_part(&parts.front());
  StepReport report;
  std::tie(report.loss_discriminator, report.gradient_discriminator) =
      FiniteLossAndNorm(found.loss, found.gradients);
  report.loss_discriminator = std::sqrt(report.loss_discriminator);
  const double left = static_cast<double>(updates - step) / static_cast<double>(updates);
  report.rate_discriminator = fit->Take(found.gradients, left);
  if (step + 1 < updates) return report;
  fit->encoder()->FittedTo(shapes);
  solids.Standardise(fit->encoder()->mean(), fit->encoder()->deviation());
  CopyModule(*generator, *average.network());
  return report;
}

// In one piece the random numbers are those of the step; parts have some each.
std::vector<GanPart> GanTrainer::Impl::OwnParts(int update) const {
  const auto stage = static_cast<std::uint64_t>(episode);
  std::vector<GanPart> parts;
  for (int part = share->rank(); part < options.micro_batches; part += share->size()) {
    const std::int64_t number =
        (step * options.discriminator_steps + update) * options.micro_batches + part;
    parts.push_back(
        {RngStream(seed, "gan part", stage, static_cast<std::uint64_t>(number)), {}, {}});
  }
  return parts;
}

// The mean over all parts of a batch, of which this process computes some. The discriminator makes
// its power iteration once, as for a batch in one piece.
LossAndGradients GanTrainer::Impl::OverParts(
    std::vector<GanPart>* parts, const std::vector<torch::Tensor>& like,
    const std::function<LossAndGradients(GanPart*)>& of_part) {
  discriminator->IterateSigma();
  discriminator->eval();
  std::vector<torch::Tensor> rows;
  std::int64_t numbers = 1;
  for (const torch::Tensor& parameter : like) numbers += parameter.numel();
  for (GanPart& part : *parts) {
    const LossAndGradients found = of_part(&part);
    rows.push_back(FlatRow(found.loss, found.gradients));
  }
  discriminator->train();
  const torch::Tensor own = rows.empty() ? torch::empty({0, numbers}) : torch::stack(rows);
  const torch::Tensor sum = share->SumInOrder(own, options.micro_batches);
  return FromFlatRow(sum / options.micro_batches, like);
}

void GanTrainer::Impl::UpdateDiscriminator(const LossAndGradients& found, StepReport* report) {
  std::tie(report->loss_discriminator, report->gradient_discriminator) =
      FiniteLossAndNorm(found.loss, found.gradients);
  if (report->loss_discriminator < options.rest_below) return;
  report->rate_discriminator = options.learning_rate_d * LearningRateFactor();
  adam_discriminator.Step(found.gradients, report->rate_discriminator);
}

void GanTrainer::Impl::UpdateGenerator(const LossAndGradients& found, StepReport* report) {
  std::tie(report->loss_generator, report->gradient_generator) =
      FiniteLossAndNorm(found.loss, found.gradients);
  report->rate_generator = options.learning_rate_g * LearningRateFactor();
  adam_generator.Step(found.gradients, report->rate_generator);
}

// Asked before the update, so that the weights stay finite; one wait for the device.
std::pair<double, double> GanTrainer::Impl::FiniteLossAndNorm(
    const torch::Tensor& loss, const std::vector<torch::Tensor>& gradients) const {
  torch::NoGradGuard no_grad;
  const torch::Tensor norm = torch::stack(at::_foreach_norm(gradients)).norm();
  const torch::Tensor both = torch::stack({loss, norm}).to(torch::kCPU, torch::kDouble);
  const double* values = both.data_ptr<double>();
  for (int i = 0; i < 2; ++i) {
    if (std::isfinite(values[i])) continue;
    throw RuntimeFailure("training diverged: a " + std::string(i == 0 ? "loss" : "gradient") +
                         " is not finite at step " + std::to_string(step) + " of episode " +
                         std::to_string(episode) +
                         " (lower gan.learning_rate_g and gan.learning_rate_d)");
  }
  return {values[0], values[1]};
}

double GanTrainer::Impl::LearningRateFactor() const {
  const double start = episode > 0 ? options.later_rate : 1.0;
  const double total = static_cast<double>(iterations);
  const double decay_steps = total * options.lr_decay_fraction;
  const double left = total - static_cast<double>(step);
  return left < decay_steps ? start * left / decay_steps : start;
}

double GanTrainer::Impl::AverageDecay() const {
  // A window much shorter than the episode, or the average would remember the episode before.
  const double target = options.ema > 0.0
                            ? options.ema
                            : std::clamp(1.0 - 4.0 / static_cast<double>(iterations), 0.9, 0.999);
  const double t = static_cast<double>(step);
  return std::min(target, (1.0 + t) / (10.0 + t));
}

NamedTensors GanTrainer::Impl::State(const torch::Tensor& progress,
                                     const LatentMixture& mixture) const {
  NamedTensors state;
  AppendModule("generator/", *generator, &state);
  AppendModule("discriminator/", *discriminator, &state);
  AppendModule("average/", *average.network(), &state);
  AppendAdam("adam_generator/", adam_generator, &state);
  AppendAdam("adam_discriminator/", adam_discriminator, &state);
  if (fit) AppendAdam("adam_encoder/", fit->adam(), &state);
  AppendMixture("latent/", mixture, &state);
  state.emplace_back("progress", progress);
  return state;
}

torch::Tensor GanTrainer::Impl::Progress() const {
  return torch::tensor(std::vector<std::int64_t>{episode, iterations, step});
}

void GanTrainer::Impl::SetProgress(const torch::Tensor& progress) {
  episode = static_cast<int>(progress[0].item<std::int64_t>());
  iterations = progress[1].item<std::int64_t>();
  step = progress[2].item<std::int64_t>();
  average.WeightsChanged();
}

torch::Tensor GanTrainer::Impl::Faired(const torch::Tensor& drawn) const {
  if (!(options.fairing > 0.0)) return drawn;
  const double cells = model.resolution;  // along the cube's side
  const FewBends fairing{.weight = options.fairing, .power = options.fairing_power};
  const torch::Tensor distances = Distances(drawn.cpu().to(torch::kFloat), model) * cells;
  return NetworkValues(WithFewBends(distances, fairing) / cells, model);
}

// As large as that of the state, with numbers of parts or without; what it lacks is refused when
// it is taken.
LatentMixture GanTrainer::Impl::MixtureToTake(const NamedTensors& state) const {
  const torch::Tensor* weights = FindTensor(state, "latent/weights");
  const std::int64_t n = weights != nullptr && weights->dim() == 1 ? weights->size(0) : 1;
  const torch::Tensor* means = FindTensor(state, "latent/means");
  const std::int64_t all = model.latent + generator->PartNumbers();
  const bool parts = means != nullptr && means->dim() == 2 && means->size(1) == all;
  const std::int64_t numbers = parts ? all : model.latent;
  return {torch::empty({n}), torch::empty({n, numbers}), torch::empty({n, numbers})};
}

NamedTensors GanTrainer::Impl::Networks(const LatentMixture& mixture) const {
  NamedTensors networks;
  AppendModule("discriminator/", *discriminator, &networks);
  AppendModule("average/", *average.network(), &networks);
  AppendMixture("latent/", mixture, &networks);
  return networks;
}

GanTrainer::GanTrainer(const ModelOptions& model, const GanOptions& options, std::uint64_t seed,
                       torch::Device device)
    : impl_(std::make_unique<Impl>(model, options, seed, device)) {
  BeginEpisode(0, 1, false);
}

GanTrainer::GanTrainer(GanTrainer&& other) noexcept = default;
GanTrainer::~GanTrainer() = default;

void GanTrainer::BeginEpisode(int episode, std::int64_t iterations, bool restart_networks) {
  AG_CHECK(iterations > 0, "an episode has at least one iteration");
  Impl& t = *impl_;
  if (restart_networks) {
    t.RestartNetworks(episode);
  }
  t.adam_generator.Restart();
  t.adam_discriminator.Restart();
  if (t.fit) t.fit->Restart();
  t.episode = episode;
  t.iterations = iterations;
  t.step = 0;
  t.latent = StandardNormal(t.model.latent);
  t.average.Follow(*t.generator, /*decay=*/0.0);
  if (t.fit) CopyModule(*t.generator, *t.average.network());  // what its numbers stand for, too
}

void GanTrainer::BeginFixedEpisode(int episode, const LatentMixture& latent) {
  impl_->episode = episode;
  impl_->iterations = impl_->step = 0;
  impl_->latent = latent;
}

StepReport GanTrainer::Step(const torch::Tensor& shapes) {
  Impl& t = *impl_;
  AG_CHECK(t.step < t.iterations, "the episode is over");
  AG_CHECK(shapes.dim() == 5 && shapes.size(0) > 0, "shapes must be [N, 1, r, r, r], N > 0");
  const bool in_parts = t.options.micro_batches > 0;
  t.generator->train();
  t.discriminator->train();
  if (t.Fits()) {
    const StepReport fitted = t.FitStep(shapes);
    ++t.step;
    return fitted;
  }
  StepReport report;
  std::vector<GanPart> parts;
  if (!in_parts) {
    parts.push_back({RngStream(t.seed, "gan", static_cast<std::uint64_t>(t.episode),
                               static_cast<std::uint64_t>(t.step)),
                     {},
                     {}});
  }
  // The last discriminator update and the generator's share one forward of G: the discriminator
  // sees the fakes detached, then the generator is judged on the same fakes by the updated D.
  for (int k = 0; k < t.options.discriminator_steps; ++k) {
    const torch::AutoGradMode gradients(k + 1 == t.options.discriminator_steps);
    if (in_parts) parts = t.OwnParts(k);
    const auto of_part = [&](GanPart* part) {
      t.gradients.Draw(shapes, part);
      return t.gradients.OfDiscriminator(part);
    };
    t.UpdateDiscriminator(in_parts ? t.OverParts(&parts, t.adam_discriminator.parameters(), of_part)
                                   : of_part(&parts.front()),
                          &report);
  }
  const auto of_part = [&](GanPart* part) { return t.gradients.OfGenerator(part); };
  t.UpdateGenerator(in_parts ? t.OverParts(&parts, t.adam_generator.parameters(), of_part)
                             : of_part(&parts.front()),
                    &report);
  // Every process has run other parts; nobody reads the statistics of the newest generator.
  if (in_parts && t.generator->HasStatistics()) t.generator->RestartStatistics();
  t.average.Follow(*t.generator, t.AverageDecay());
  ++t.step;
  return report;
}

void GanTrainer::ShareBatches(BatchShare* share) { impl_->share = share; }

double GanTrainer::LargestSigma() const { return impl_->discriminator->LargestSigma(); }

std::int64_t GanTrainer::step() const { return impl_->step; }
std::int64_t GanTrainer::iterations() const { return impl_->iterations; }
int GanTrainer::episode() const { return impl_->episode; }
torch::Device GanTrainer::device() const { return impl_->device; }

torch::Tensor GanTrainer::Latents(std::uint64_t seed, std::int64_t first,
                                  std::int64_t count) const {
  return SampleLatents(impl_->latent, seed, first, count);
}

torch::Tensor GanTrainer::Sample(std::uint64_t seed, std::int64_t first, std::int64_t count) {
  return impl_->Faired(impl_->average.Sample(impl_->latent, seed, first, count));
}

torch::Tensor GanTrainer::Draw(const torch::Tensor& latents) {
  return impl_->Faired(impl_->average.Draw(latents));
}

std::int64_t GanTrainer::PartNumbers() const { return impl_->generator->PartNumbers(); }

const LatentMixture& GanTrainer::latent() const { return impl_->latent; }

NamedTensors GanTrainer::Networks() const {
  NamedTensors networks = impl_->Networks(impl_->latent);
  for (auto& [name, tensor] : networks) {
    if (tensor.is_floating_point()) tensor = tensor.to(torch::kHalf);
  }
  networks.emplace_back("progress", impl_->Progress());
  return networks;
}

void GanTrainer::LoadNetworks(const NamedTensors& state, const std::string& origin) {
  RequireGan(state, origin);
  const LatentMixture mixture = impl_->MixtureToTake(state);
  NamedTensors networks = impl_->Networks(mixture);
  const torch::Tensor progress = torch::zeros({3}, torch::kLong);
  networks.emplace_back("progress", progress);
  TakeTensors(state, origin, networks);
  impl_->latent = mixture;
  impl_->SetProgress(progress);
  CopyModule(*impl_->average.network(), *impl_->generator);
}

void GanTrainer::TakeFolded(GanTrainer* other) {
  Impl &t = *impl_, &from = *other->impl_;
  t.average.TakeFolded(&from.average);
  CopyModule(*t.average.network(), *t.generator);
  CopyModule(*from.discriminator, *t.discriminator);
  t.latent = from.latent;
  t.SetProgress(from.Progress());
}

NamedTensors GanTrainer::State() const { return impl_->State(impl_->Progress(), impl_->latent); }

void GanTrainer::Load(const NamedTensors& state, const std::string& origin) {
  RequireGan(state, origin);
  const torch::Tensor progress = torch::zeros({3}, torch::kLong);
  const LatentMixture mixture = impl_->MixtureToTake(state);
  TakeTensors(state, origin, impl_->State(progress, mixture));
  impl_->latent = mixture;
  impl_->SetProgress(progress);
}

}  // namespace antigrasp
