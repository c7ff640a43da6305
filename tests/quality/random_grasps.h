#pragma once

#include "antigrasp/core/rng.h"
#include "antigrasp/quality/epsilon.h"
#include "tests/support/random_draws.h"

namespace antigrasp {

struct RandomGrasp {
  std::array<Contact, 2> contacts;
  Eigen::Vector3d com;
  WrenchModel model;
};

// Two contacts about 4 cm apart whose inward normals make angles up to `spread` * atan(friction)
// with the contact line; friction, forces, lengths and the centre of mass vary.
RandomGrasp DrawRandomGrasp(double spread, int cone_edges, RngStream* rng);

}  // namespace antigrasp
