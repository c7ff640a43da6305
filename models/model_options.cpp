#include "antigrasp/models/model_options.h"

#include <bit>

#include "antigrasp/core/check.h"
#include "antigrasp/core/error.h"

namespace antigrasp {

void Bind(OptionTable* table, ModelOptions* options) {
  table->Add("model.kind", &options->kind,
             "generator: transposed convolutions (sngan), or a union of solids with flat faces");
  table->Add("model.parts", &options->parts, 1, 32,
             "solids in a union, or frusta of a turned solid (model.kind = solids)");
  table->Add(
      "model.form", &options->form,
      "what its solids are: begun as boxes or as cylinders; or turned, one outline about an axis");
  table->Add("model.width", &options->width, 1, 256,
             "channels of the generator's last hidden layer (16^3); 8 for two cores, 64 for a GPU");
  table->Add("model.latent", &options->latent, 1, 4096, "length of the noise vector z");
  table->Add("model.resolution", &options->resolution, 16, 128, "nodes along one side of the grid");
  table->Add(
      "model.spectral_norm", &options->spectral_norm,
      "divide the discriminator's weights by their largest singular value (not if form = turned)");
  table->Add("model.pack", &options->pack, 1, 64,
             "shapes that the discriminator judges together (PacGAN); divides gan.batch");
  table->Add(
      "model.pack_at", &options->pack_at,
      "where they meet: channels of the first layer, or the deviation of features at 4^3 (turned "
      "solids: of features always)");
  table->Add("model.width_d", &options->width_d, 0, 256,
             "width of the discriminator; 0 = model.width");
  table->Add(
      "model.block", &options->block,
      "residual: a 3^3 convolution beside every resolution but 2^3, in both networks or in one");
  table->Add("model.batch_norm", &options->batch_norm, "batch normalisation in the generator");
  table->Add("model.output_blur", &options->output_blur,
             "smooth the generator's output with [1 2 1]/4 along each axis, before tanh");
  table->Add("model.edge_gain", &options->edge_gain, 0, 100,
             "the discriminator sees x - edge_gain * Laplacian(x), so that bumps stand out; 0 = x");
  table->Add("model.depth", &options->depth, 0, 1,
             "the discriminator sees distances inside as at most this, unit cube; 0 = as they are");
  table->Add("model.squash", &options->squash, "how distances beyond the truncation are cut off");
  table->Add("model.truncation", &options->truncation, 0, 1,
             "distance that a network value of 1 stands for, unit cube; 0 = raw distances");
  table->Add("model.raw_scale", &options->raw_scale, 0.01, 100,
             "network value per unit of distance when truncation = 0");
  table->Add("model.precision", &options->precision,
             "of the convolutions' products; bfloat16 for CUDA: CPUs are faster with float32");
}

void CheckResolution(const ModelOptions& options, const std::string& origin) {
  if (std::has_single_bit(static_cast<unsigned>(options.resolution))) return;
  throw InputError("model.resolution = " + std::to_string(options.resolution), origin,
                   "a power of two");
}

int HiddenLevels(const ModelOptions& options) {
  const auto resolution = static_cast<unsigned>(options.resolution);
  AG_CHECK(std::has_single_bit(resolution) && resolution >= 8, "a resolution of networks");
  return std::countr_zero(resolution) - 2;
}

}  // namespace antigrasp
