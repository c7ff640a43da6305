#include "antigrasp/train/gan_gradients.h"

#include <torch/autograd.h>
#include <torch/utils.h>

#include <algorithm>

#include "antigrasp/models/elementwise.h"
#include "antigrasp/models/random_tensor.h"
#include "antigrasp/train/augment.h"
#include "antigrasp/train/gan_losses.h"
#include "antigrasp/train/symmetries.h"

namespace antigrasp {

GanGradients::GanGradients(const ModelOptions& model, const GanOptions& options,
                           ShapeGenerator* generator, ShapeDiscriminator* discriminator,
                           torch::Device device)
    : options_(options),
      latent_(model.latent),
      size_(options.batch / std::max(1, options.micro_batches)),
      device_(device),
      generator_(generator),
      discriminator_(discriminator),
      generator_parameters_(generator->parameters()),
      discriminator_parameters_(discriminator->Trained()) {}

torch::Tensor GanGradients::RandomShapes(const torch::Tensor& shapes, RngStream* rng) const {
  torch::Tensor indices = torch::empty({size_}, torch::kLong);
  auto* index = indices.data_ptr<std::int64_t>();
  for (std::int64_t i = 0; i < size_; ++i) {
    index[i] = static_cast<std::int64_t>(rng->Below(static_cast<std::uint64_t>(shapes.size(0))));
  }
  const torch::Tensor batch =
      shapes.index_select(0, indices.to(shapes.device())).to(device_, torch::kFloat);
  return RandomSymmetries(batch, options_.symmetries, rng);
}

void GanGradients::Draw(const torch::Tensor& shapes, GanPart* part) const {
  part->real = discriminator_->Judged(RandomShapes(shapes, &part->rng));
  part->z = NormalTensor({size_, latent_}, 1.0, &part->rng).to(device_);
}

torch::Tensor GanGradients::Seen(const torch::Tensor& shapes, GanPart* part) const {
  const bool grids = shapes.dim() == 5;  // numbers of outlines have no mirror and no shift
  return grids ? Augment(shapes, options_.augment, &part->rng) : shapes;
}

LossAndGradients GanGradients::OfDiscriminator(GanPart* part) {
  part->fake = generator_->ForwardJudged(part->z);
  const torch::AutoGradMode gradients(true);
  const torch::Tensor seen = Seen(Stacked(part->real, part->fake.detach()), part);
  const auto loss_of = [&](const torch::Tensor& score) {  // [2 batch / pack]
    const auto halves = score.chunk(2);
    return DiscriminatorLoss(options_.loss, halves[0], halves[1]);
  };
  if (!(options_.gradient_penalty > 0.0)) {
    const torch::Tensor loss = loss_of(discriminator_->Score(seen));
    return {loss, torch::autograd::grad({loss}, discriminator_parameters_)};
  }
  // Both forwards divide by the same singular values, or their difference would be that of these.
  const bool iterates = discriminator_->is_training();
  if (iterates) discriminator_->IterateSigma();
  discriminator_->eval();
  const torch::Tensor shapes = seen.detach().requires_grad_();
  const torch::Tensor score = discriminator_->Score(shapes);
  const Uphill uphill = StepUphill(shapes, score, discriminator_->SmallMove());
  const torch::Tensor loss =
      loss_of(score) + GradientPenalty(options_.gradient_penalty, score,
                                       discriminator_->Score(uphill.shapes), uphill.step);
  discriminator_->train(iterates);
  return {loss, torch::autograd::grad({loss}, discriminator_parameters_)};
}

// In two legs, so that the discriminator's own gradients are not computed.
LossAndGradients GanGradients::OfGenerator(GanPart* part) {
  const torch::Tensor input = part->fake.detach().requires_grad_();
  torch::Tensor loss;
  if (options_.loss == GanLoss::kHinge) {
    const torch::Tensor score = discriminator_->Score(Seen(input, part));
    loss = GeneratorLoss(options_.loss, {}, score);
  } else {
    const auto halves = discriminator_->Score(Seen(torch::cat({part->real, input}), part)).chunk(2);
    loss = GeneratorLoss(options_.loss, halves[0].detach(), halves[1]);
  }
  const auto by_input = torch::autograd::grad({loss}, {input});
  return {loss, torch::autograd::grad({part->fake}, generator_parameters_, by_input)};
}

}  // namespace antigrasp
