#include "antigrasp/train/run_folder.h"

#include <optional>
#include <vector>

#include "antigrasp/train/run_lock.h"

namespace antigrasp {

namespace fs = std::filesystem;

std::vector<fs::path> RunFolder::Episodes() const {
  std::vector<fs::path> folders;
  for (const auto& entry : fs::directory_iterator(root)) {
    if (entry.path().filename().string().starts_with("episode_")) folders.push_back(entry.path());
  }
  return folders;
}

void RunFolder::Remove() const {
  const RunLock lock(*this);
  std::optional<RunLock> of_control;  // of a run that was killed a process may still be there
  if (fs::is_directory(Control())) of_control.emplace(RunFolder{Control()});
  std::vector<fs::path> written = {Provenance(), Prior(), PriorScores(), Latest(),
                                   Statistics(), Stl(),   Control(),     Events().parent_path()};
  for (const fs::path& episode : Episodes()) written.push_back(episode);
  written.push_back(Config());  // last: until then the folder still holds a run
  for (const fs::path& path : written) fs::remove_all(path);
}

}  // namespace antigrasp
