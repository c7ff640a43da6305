#include "antigrasp/train/run_folder.h"

#include <vector>

namespace antigrasp {

namespace fs = std::filesystem;

void RunFolder::Remove() const {
  std::vector<fs::path> written = {Provenance(), Prior(), PriorScores(), Latest(),
                                   Statistics(), Stl(),   Control(),     Events().parent_path()};
  for (const auto& entry : fs::directory_iterator(root)) {
    if (entry.path().filename().string().starts_with("episode_")) written.push_back(entry.path());
  }
  written.push_back(Config());  // last: until then the folder still holds a run
  for (const fs::path& path : written) fs::remove_all(path);
}

}  // namespace antigrasp
