#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "antigrasp/core/atomic_file.h"
#include "antigrasp/train/cem_run.h"
#include "tests/train/tiny_run.h"

// What runs leave behind, and runs that are stopped.
namespace antigrasp::shapes {

inline std::map<std::string, std::string> FilesIn(const std::filesystem::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    // Events of TensorBoard and the provenance hold the time of day.
    if (entry.is_regular_file() && entry.path().parent_path().filename() != "tensorboard" &&
        entry.path().filename() != "provenance.toml") {
      files[std::filesystem::relative(entry.path(), folder).string()] = ReadFile(entry.path());
    }
  }
  return files;
}

inline void ExpectSameFiles(const std::filesystem::path& a, const std::filesystem::path& b) {
  const auto in_a = FilesIn(a);
  const auto in_b = FilesIn(b);
  for (const auto& [name, bytes] : in_a) {
    ASSERT_TRUE(in_b.contains(name)) << name;
    EXPECT_TRUE(in_b.at(name) == bytes) << name << " differs";
  }
  EXPECT_EQ(in_a.size(), in_b.size());
}

// A run is stopped in this phase after so many reports of progress since it went on.
struct Stop {
  int reports;
  std::string phase;
};

// Starts a run in `folder`, stops it again and again, and lets it end.
inline void RunWithStops(const RunConfig& config, const std::filesystem::path& folder,
                         const std::vector<Stop>& stops, const ShapeModelMaker& make = MakeGan) {
  for (const Stop& stop : stops) {
    StoppingObserver stopping(stop.reports);
    if (RunFolder{folder}.HoldsARun()) {
      EXPECT_THROW(ResumeRun(folder, &stopping, make), Interrupted) << stop.phase;
    } else {
      EXPECT_THROW(StartRun(config, folder, &stopping, make), Interrupted) << stop.phase;
    }
    EXPECT_EQ(stopping.phase(), stop.phase);
  }
  StoppingObserver never;
  ResumeRun(folder, &never, make);
}

}  // namespace antigrasp::shapes
