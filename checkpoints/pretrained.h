#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace antigrasp {

// Networks that come with the program (checkpoints/pretrained/NAME.pt), wherever it was built or
// installed.

// The file of a checkpoint, of a run's folder (its last checkpoint), or of pretrained networks by
// name: "cylinders-adversarial". InputError that lists the names when there is neither.
std::filesystem::path FindNetworks(const std::string& path_or_name);

std::vector<std::string> PretrainedNames();  // ascending

}  // namespace antigrasp
