#include "antigrasp/doctor/network_facts.h"

#include <ATen/Version.h>
#include <cairo.h>
#include <dlfcn.h>
#include <torch/cuda.h>
#include <torch/version.h>

#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <string>

#include "antigrasp/checkpoints/pretrained.h"
#include "antigrasp/doctor/build_facts.h"
#include "antigrasp/doctor/library_versions.h"

namespace antigrasp {
namespace {

// The file that LibTorch was loaded from, whose name has its version: its own functions do not
// tell.
std::string TorchFile() {
  Dl_info info{};
  const bool found = dladdr(reinterpret_cast<const void*>(&at::show_config), &info) != 0;
  return found && info.dli_fname != nullptr ? std::string(" (") + info.dli_fname + ")" : "";
}

// What LibTorch says of itself behind this word, to the end of the line; "" when it does not.
std::string OwnWords(const std::string& word) {
  std::istringstream lines(at::show_config());
  for (std::string line; std::getline(lines, line);) {
    const std::size_t place = line.find(word);
    if (place != std::string::npos) return line.substr(place + word.size());
  }
  return {};
}

// "OpenBLAS 0.3.21 ... DYNAMIC_ARCH ... Haswell MAX_THREADS=64": its version and kernels.
std::string Blas() {
  void* const config = dlsym(RTLD_DEFAULT, "openblas_get_config");
  return config == nullptr ? "another BLAS than OpenBLAS"
                           : reinterpret_cast<const char* (*)()>(config)();
}

std::string Kernels() {
  const std::string capability = OwnWords("CPU capability usage: ");
  return (capability.empty() ? "" : "LibTorch " + capability + "; ") + OwnWords("Intel(R) ") +
         "; " + Blas();
}

std::string Devices() {
  const auto found = torch::cuda::device_count();
  const std::string runtime = OwnWords("CUDA Runtime ");
  if (found > 0) return "cpu, " + std::to_string(found) + " x cuda (CUDA " + runtime + ")";
  return runtime.empty() ? "cpu; this LibTorch has no CUDA"
                         : "cpu; no device for CUDA " + runtime + " was found";
}

std::string Pretrained() {
  std::string names, where;
  for (const std::string& name : PretrainedNames()) {
    names += (names.empty() ? "" : ", ") + name;
    const std::string folder = FindNetworks(name).parent_path().string();
    if (where.find(folder) == std::string::npos) where += (where.empty() ? "" : ", ") + folder;
  }
  return names.empty() ? "none was found" : names + " (" + where + ")";
}

// Of a folder that was asked for and is none, or nothing.
std::string MissingFolder() {
  const char* const asked = std::getenv("ANTIGRASP_PRETRAINED");
  if (asked == nullptr || std::filesystem::is_directory(asked)) return "";
  return FactLine("", std::string("not in ANTIGRASP_PRETRAINED, which is no folder: ") + asked);
}

}  // namespace

std::string NetworkFacts() {
  const std::string cairo =
      LibrariesText({{"Cairo", CAIRO_VERSION_STRING, cairo_version_string()}});
  return FactLine("networks", "LibTorch " TORCH_VERSION + TorchFile() + ", " + cairo) +
         FactLine("kernels", Kernels()) + FactLine("devices", Devices()) +
         FactLine("networks found", Pretrained()) + MissingFolder();
}

}  // namespace antigrasp
