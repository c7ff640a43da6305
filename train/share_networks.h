#pragma once

#include <string>

#include "antigrasp/checkpoints/checkpoint.h"

namespace antigrasp {

// The networks of a GAN's checkpoint alone, to share and to start from: without the shapes, which
// may be private and are large, and without the losses. `fold_batch_norm`: batch normalisation goes
// into the weights, with the same samples; InputError, naming `origin`, for networks without it or
// with other blocks than plain ones.
struct SharedNetworks {
  Checkpoint checkpoint;
  int episode = 0;  // that they are of
};
SharedNetworks NetworksToShare(Checkpoint checkpoint, const std::string& origin,
                               bool fold_batch_norm);

}  // namespace antigrasp
