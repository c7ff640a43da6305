#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace antigrasp {

// Which of several processes of one job this one is, as whoever started them says it in the
// environment.
struct Launch {
  int rank = 0;            // 0 leads: it alone reads, writes and shows progress
  int size = 1;            // processes, > 0
  int local = 1;           // of them on this machine
  std::string host;        // where rank 0 listens
  std::uint16_t port = 0;  // 0: rank 0 takes a free one (--processes)
  // torchrun listens itself, also for its workers; each of its restarts is told by a prefix.
  bool store_is_there = false;
  std::string prefix;
  double lost_after = 30.0;  // seconds without a sign of it: a rank is gone

  bool leads() const { return rank == 0; }
  // Seconds for the next of the others to come at the beginning, where one that is gone cannot be
  // told from one that is on its way.
  double FirstWait() const { return 1.5 * lost_after; }
};

using ReadVariable = std::function<const char*(const char* name)>;  // getenv

// nullopt: this process is alone. From what was set by torchrun (RANK, WORLD_SIZE,
// LOCAL_WORLD_SIZE, MASTER_ADDR, MASTER_PORT), by Slurm (SLURM_PROCID, SLURM_NTASKS,
// SLURM_NTASKS_PER_NODE; the first host of SLURM_JOB_NODELIST, a port from SLURM_JOB_ID) or by
// OpenMPI (OMPI_COMM_WORLD_RANK, _SIZE, _LOCAL_SIZE); MASTER_ADDR and MASTER_PORT go before what
// the last two say. ANTIGRASP_LOST_AFTER is lost_after. InputError for what is no number or out of
// range, and where nobody says where rank 0 listens.
std::optional<Launch> LaunchOfEnvironment(const ReadVariable& read);
std::optional<Launch> LaunchOfEnvironment();

// Whether nobody else shows progress and says what is to be said: false of ranks other than 0.
bool LeadsJob();

// How many of the job's processes are on this machine; 1 for a process that is alone.
int ProcessesHere();

// This process's environment, NAME=VALUE each, without what would make a program that it starts a
// rank of its job.
std::vector<std::string> EnvironmentAlone();

std::string HostName();

// Who says something: "antigrasp", of several processes "antigrasp (rank 2 on node07)".
std::string Speaker();

// A line to standard error that says whose it is.
void SayOfRank(const std::string& line);

// The first host of a Slurm list: "node[03-05,9],gpu1" -> "node03".
std::string FirstHost(const std::string& list);

}  // namespace antigrasp
