#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

namespace antigrasp {

// The processes of a job that share the loops of one command (core/shared_stream.h). All of them
// run it, and read what it reads. Rank 0 alone writes; the others (Helps) return behind their last
// loop.
class WorkShare {
 public:
  virtual ~WorkShare() = default;
  virtual int rank() const = 0;  // 0 leads
  virtual int size() const = 0;  // processes
  bool leads() const { return rank() == 0; }

  // Rank 0's text, on all, in the order of its calls. Others leave by WorkOver when rank 0 has come
  // to its end.
  virtual std::string Told(const std::string& text) = 0;

  // Any thread may call these.
  // Takes the next `count` numbers of a counter that all share, from 0: the first of them.
  virtual std::int64_t TakeNext(const std::string& counter, std::int64_t count) = 0;
  virtual void Put(const std::string& name, const std::string& bytes) = 0;
  // What somebody has put, once; throws, as it was there, what another rank failed with.
  virtual std::optional<std::string> TakeIfThere(const std::string& name) = 0;
};

// Rank 0 has no more for the others to do: no failure.
struct WorkOver {};

// Whether this process is of a job and not its rank 0.
inline bool Helps(const WorkShare* share) { return share != nullptr && !share->leads(); }

inline int RanksOf(const WorkShare* share) { return share == nullptr ? 1 : share->size(); }

// How a command is run that can share its loops: `run` gets nullptr where the process is alone.
// `processes`: on this machine, as the command line has it.
using SharedRun = std::function<void(WorkShare* share)>;
using JobRunner = std::function<void(int processes, const SharedRun& run)>;

}  // namespace antigrasp
