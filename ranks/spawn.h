#pragma once

#include <sys/types.h>

#include <cstdint>
#include <vector>

namespace antigrasp {

// The other processes of a job on this machine (--processes N): this one is rank 0.
class SpawnedRanks {
 public:
  // From here on LaunchOfEnvironment says rank 0 of `processes`, on a port that is still free.
  explicit SpawnedRanks(int processes);
  ~SpawnedRanks();  // waits for them; those that do not end within ten seconds are killed
  SpawnedRanks(const SpawnedRanks&) = delete;
  SpawnedRanks& operator=(const SpawnedRanks&) = delete;

  // Starts them: this program with these arguments, told where rank 0 listens. They do not hear
  // Ctrl-C. RuntimeFailure where no process can be made.
  void Start(std::uint16_t port, char** arguments);
  // RuntimeFailure where one of them has ended.
  void Check();

 private:
  int processes_;
  std::vector<pid_t> ranks_;
};

}  // namespace antigrasp
