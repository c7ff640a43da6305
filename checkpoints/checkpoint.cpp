#include "antigrasp/checkpoints/checkpoint.h"

#include <torch/serialize/archive.h>
#include <torch/types.h>

#include <sstream>

#include "antigrasp/core/atomic_file.h"
#include "antigrasp/core/error.h"
#include "antigrasp/core/file_kind.h"

namespace antigrasp {
namespace {

namespace fs = std::filesystem;

constexpr const char* kFormat = "antigrasp.checkpoint";
const std::string kExpected =
    "an antigrasp checkpoint of version " + std::to_string(Checkpoint::kVersion);

template <class T>
T Read(torch::serialize::InputArchive* archive, const std::string& key, const fs::path& path) {
  c10::IValue value;
  if (!archive->try_read(key, value)) {
    throw InputError("no entry '" + key + "' in checkpoint", path.string(), kExpected);
  }
  try {
    return value.to<T>();
  } catch (const c10::Error&) {
    throw InputError("entry '" + key + "' has another type", path.string(), kExpected);
  }
}

// Opens the archive and checks format and version.
torch::serialize::InputArchive Open(const fs::path& path) {
  RequireFile(path, kExpected);
  torch::serialize::InputArchive archive;
  try {
    archive.load_from(path.string());
  } catch (const std::exception&) {
    RefuseOtherKind(path, FileKind::kZip, "a checkpoint", kExpected);
    throw InputError(IsZip(path) ? "truncated or damaged checkpoint" : "not a checkpoint",
                     path.string(), kExpected);
  }
  if (Read<std::string>(&archive, "format", path) != kFormat) {
    throw InputError("another kind of archive", path.string(), kExpected);
  }
  const auto version = Read<std::int64_t>(&archive, "version", path);
  if (version != Checkpoint::kVersion) {
    throw InputError("checkpoint version " + std::to_string(version), path.string(), kExpected);
  }
  return archive;
}

}  // namespace

void WriteCheckpoint(const fs::path& path, const Checkpoint& checkpoint) {
  torch::serialize::OutputArchive archive;
  archive.write("format", c10::IValue(std::string(kFormat)));
  archive.write("version", c10::IValue(static_cast<std::int64_t>(Checkpoint::kVersion)));
  archive.write("config", c10::IValue(checkpoint.config));
  archive.write("statistics", c10::IValue(checkpoint.statistics));
  archive.write("finished", c10::IValue(checkpoint.finished));
  archive.write("shapes", checkpoint.shapes, /*is_buffer=*/true);
  archive.write("losses", checkpoint.losses, /*is_buffer=*/true);
  torch::serialize::OutputArchive networks(archive.compilation_unit());
  for (const auto& [name, tensor] : checkpoint.networks) {
    networks.write(name, tensor.detach().cpu(), /*is_buffer=*/true);
  }
  archive.write("networks", networks);
  // Through memory: written to a path, the archive would carry the temporary file's name.
  std::ostringstream bytes;
  archive.save_to(bytes);
  WriteFileAtomic(path, std::move(bytes).str());
}

Checkpoint ReadCheckpoint(const fs::path& path) {
  torch::serialize::InputArchive archive = Open(path);
  Checkpoint checkpoint;
  checkpoint.config = Read<std::string>(&archive, "config", path);
  checkpoint.statistics = Read<std::string>(&archive, "statistics", path);
  checkpoint.finished = Read<bool>(&archive, "finished", path);
  checkpoint.shapes = Read<torch::Tensor>(&archive, "shapes", path);
  checkpoint.losses = Read<torch::Tensor>(&archive, "losses", path);
  torch::serialize::InputArchive networks;
  if (!archive.try_read("networks", networks)) {
    throw InputError("no entry 'networks' in checkpoint", path.string(), kExpected);
  }
  for (const std::string& name : networks.keys()) {
    checkpoint.networks.emplace_back(name, Read<torch::Tensor>(&networks, name, path));
  }
  return checkpoint;
}

bool IsCheckpoint(const fs::path& path) {
  try {
    Open(path);
    return true;
  } catch (const std::exception&) {
    return false;
  }
}

}  // namespace antigrasp
