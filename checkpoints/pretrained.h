#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace antigrasp {

// Networks that come with the project (checkpoints/pretrained/NAME.pt), by name. They are looked
// for in this order: in `folder`, if one is given; in the folder that the environment variable
// ANTIGRASP_PRETRAINED names; where this library was configured to be installed
// (PREFIX/share/antigrasp/pretrained); in the sources it was built from.

// The file of a checkpoint, of a run's folder (its last checkpoint), or of pretrained networks by
// name: "cylinders-adversarial". InputError that lists the names when there is neither.
std::filesystem::path FindNetworks(const std::string& path_or_name,
                                   const std::filesystem::path& folder = {});

std::vector<std::string> PretrainedNames(const std::filesystem::path& folder = {});  // ascending

}  // namespace antigrasp
