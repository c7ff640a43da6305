#pragma once

#include <string>

#include "antigrasp/perturb/polyhedra.h"

namespace antigrasp {

// MakeAdversarialPolyhedron, or InputError where options.phi is out of reach: for any closed solid,
// or for this one, with the best that was reached.
AdversarialPolyhedron RequestedPolyhedron(Polyhedron kind, const PolyhedronOptions& options,
                                          int threads = 0, const ProgressFn& progress = nullptr);

// What there is to check of a solid, millimetres, for people: how large it is as a mesh, its
// smallest antipodality angle beside `phi`, which was asked for, whether it is convex, closed and
// printable, how far it is from the plain solid.
std::string CertificateText(const AdversarialPolyhedron& solid, double phi);

}  // namespace antigrasp
