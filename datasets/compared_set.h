#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "antigrasp/core/parallel.h"
#include "antigrasp/datasets/objects.h"
#include "antigrasp/mesh/length_unit.h"
#include "antigrasp/mesh/triangle_mesh.h"

namespace antigrasp {

// One side of a comparison on surfaces: the usable objects of an input, metres.
struct ComparedSet {
  std::string input;
  std::vector<TriangleMesh> meshes;
  std::vector<std::uint64_t> streams;  // of each one's random draws, by its name
  int left_out = 0;                    // no solid, or without an area
  std::string counts;                  // CountByStatus of all
};

// The objects of an input, a mesh, a folder or an SDF file, whose coordinates are in `units`: of an
// SDF file the side of its cube, in which a set and the samples of a network trained on it lie.
ComparedSet ReadComparedSet(const std::string& input, LengthUnit units, int threads,
                            const ProgressFn& progress = nullptr);

// The same of objects that are there already, in that unit; `input`: what messages call them.
ComparedSet ComparedSetOf(std::string input, std::vector<InputObject> objects, LengthUnit units);
// InputError for a set of fewer shapes.
void RequireShapes(const ComparedSet& set, std::size_t least);

// Leaves `count` of the shapes at random, in their order: the first ones of a folder may be of one
// kind. Each draws a lot by its name, and the lowest stay, in whatever order they come. `number`
// tells the sides of a comparison apart.
void KeepAtRandom(std::size_t count, std::uint64_t seed, std::uint64_t number, ComparedSet* set);

// The same of both sides, as many as both have and at most `most`; returns their number.
std::size_t KeepAsMany(int most, std::uint64_t seed, ComparedSet* samples, ComparedSet* reference);

}  // namespace antigrasp
