#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "antigrasp/core/parallel.h"
#include "antigrasp/core/work_share.h"
#include "antigrasp/datasets/shape_set.h"

namespace antigrasp {

std::vector<std::string> PriorSetKinds();  // "cylinders", "prisms", "bottles"

struct PriorSetOptions {
  std::string kind = "cylinders";  // one of PriorSetKinds()
  int count = 1000;
  std::uint64_t seed = 1;
  int resolution = 32;
  int threads = 0;  // 0 = all; the set does not depend on it
  int grafts = 2;   // how many of a shape's two are left on it: 0 and 1 make sets of a known fault
};

// The synthetic sets of section VI (after Bousmalis et al. 2018): intersected cylinders (a large
// one with its axis along z and two smaller ones grafted at random poses), intersected prisms (all
// three sizes vary), bottles (surfaces of revolution of six families, for those without ShapeNet).
// Exact distances, surface inside the grid border, whole set scaled as VI-C says. Shape i depends
// on (kind, seed, i) only, and its large part lies where it lies with both grafts.
// The ranks of `share` make it together; one that helps gets a set without shapes.
ShapeSet MakePriorSet(const PriorSetOptions& options, const ProgressFn& progress = nullptr,
                      WorkShare* share = nullptr);

std::string PriorSetText(const PriorSetOptions& options);  // one line for people

// The same as an SDF file, shape by shape: memory does not grow with their number. One that helps
// writes none.
void WritePriorSet(const std::filesystem::path& path, const PriorSetOptions& options,
                   const ProgressFn& progress = nullptr, WorkShare* share = nullptr);

}  // namespace antigrasp
