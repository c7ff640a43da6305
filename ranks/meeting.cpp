#include "antigrasp/ranks/meeting.h"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <exception>
#include <numeric>
#include <string>
#include <thread>
#include <vector>

#include "antigrasp/core/error.h"
#include "antigrasp/core/exit_code.h"

namespace antigrasp {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kNap(20);
constexpr double kSayEvery = 10.0, kPartingSeconds = 10.0;
// For one that only has to tell the others why it does not take part.
constexpr double kFailedWait = 20.0;
// Of one operation: rank 0 may score, choose and save for long between two. Who is dead is noticed
// by SignsOfLife.
constexpr std::chrono::hours kLong(24);
constexpr const char *kMet = "met", *kVerdict = "verdict", *kAgreed = "agreed";
constexpr char kFails = '!', kDiffers = '?';

double Since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

double WaitOf(const Launch& launch, const JoinOptions& options) {
  return options.failure ? std::min(kFailedWait, launch.FirstWait()) : launch.FirstWait();
}

std::string Address(const Launch& launch) {
  return launch.host + ":" + std::to_string(launch.port);
}

std::string Of(const std::string& what, int rank) { return what + "/" + std::to_string(rank); }

std::vector<std::uint8_t> Bytes(const std::string& text) { return {text.begin(), text.end()}; }

std::string Text(c10d::Store* store, const std::string& key) {
  const std::vector<std::uint8_t> bytes = store->get(key);
  return {bytes.begin(), bytes.end()};
}

// LibTorch 2.x asks for libuv's sockets by default; Debian's is built without them.
template <typename Options>
void TakeOwnSockets(Options* store) {
  if constexpr (requires { store->useLibUV; }) store->useLibUV = false;
}

std::string Missing(const std::vector<int>& ranks, int size) {
  std::string text;
  for (std::size_t i = 0; i < std::min<std::size_t>(ranks.size(), 8); ++i) {
    text += (i == 0 ? "" : ", ") + std::to_string(ranks[i]);
  }
  if (ranks.size() > 8) text += " and " + std::to_string(ranks.size() - 8) + " more";
  return "waiting for rank " + text + " of " + std::to_string(size) + " (they count from 0)";
}

// Rank 0: returns when all are there; until then it says who is missing.
void AwaitOthers(const Launch& launch, c10d::Store* store, const JoinOptions& options) {
  std::vector<int> missing(static_cast<std::size_t>(launch.size));
  std::iota(missing.begin(), missing.end(), 0);
  const auto start = Clock::now();
  auto last_came = start;
  double said = 0.0;
  while (true) {
    if (std::erase_if(missing, [&](int r) { return store->check({Of("here", r)}); }) > 0) {
      last_came = Clock::now();
    }
    if (missing.empty()) break;
    const std::string text = Missing(missing, launch.size);
    if (Since(last_came) > WaitOf(launch, options)) {
      if (options.failure) throw RuntimeFailure(text);
      const int others = launch.size - 1 - static_cast<int>(missing.size());
      TellThatItEnds(store,
                     "gave up " + text + ": nobody came for " +
                         std::to_string(static_cast<int>(Since(last_came))) +
                         " s; ANTIGRASP_LOST_AFTER=300 waits longer",
                     others);
      throw SaidElsewhere(kExitFailure);
    }
    if (options.say && Since(start) - said > kSayEvery) {
      said = Since(start);
      options.say(text);
    }
    if (options.pause) options.pause();
    std::this_thread::sleep_for(kNap);
  }
  store->set(kMet, Bytes("1"));
}

void AwaitMeeting(const Launch& launch, c10d::Store* store, const JoinOptions& options) {
  const auto start = Clock::now();
  while (!store->check({kMet})) {
    if (options.failure && Since(start) > WaitOf(launch, options)) {
      throw RuntimeFailure("the others have not come");
    }
    if (options.pause) options.pause();
    std::this_thread::sleep_for(kNap);
  }
}

// "rank 1 has cem.keep = 7 ..." by the first line that differs.
std::string Difference(int rank, const std::string& theirs, const std::string& leader) {
  std::size_t at = 0;
  while (at < theirs.size() && at < leader.size() && theirs[at] == leader[at]) ++at;
  const auto line = [&](const std::string& text) {
    const std::size_t begin = at == 0 ? 0 : text.rfind('\n', at - 1) + 1;
    const std::string found = text.substr(begin, text.find('\n', begin) - begin);
    return found.empty() ? std::string("nothing") : found.substr(0, 200);
  };
  return InputError("rank " + std::to_string(rank) + " has " + line(theirs), "start of the job",
                    "what rank 0 has: " + line(leader))
      .what();
}

// What a rank shows to rank 0: what it has, or the exit code that it begins with.
std::string Shown(const JoinOptions& options) {
  if (options.failure) return kFails + std::to_string(options.failure->exit_code);
  std::string all;
  for (const std::string& line : options.same) all += line + "\n";
  return all;
}

// Rank 0: kAgreed where all have the same; else who fails, and with which exit code, or what
// differs.
std::string Verdict(c10d::Store* store, int size) {
  std::vector<std::string> shown;
  for (int rank = 0; rank < size; ++rank) {
    shown.push_back(Text(store, Of("same", rank)));
    if (shown.back().starts_with(kFails)) {
      return kFails + std::to_string(rank) + " " + shown.back().substr(1);
    }
  }
  for (int rank = 1; rank < size; ++rank) {
    const std::string& theirs = shown[static_cast<std::size_t>(rank)];
    if (theirs != shown[0]) return kDiffers + Difference(rank, theirs, shown[0]);
  }
  return kAgreed;
}

// All have seen why the job ends before rank 0 ends with the store that they read it from.
void PartFromOthers(const Launch& launch, c10d::Store* store) {
  store->set(Of("parted", launch.rank), Bytes("1"));
  if (!launch.leads()) return;
  const auto start = Clock::now();
  for (int other = 1; other < launch.size; ++other) {
    while (!store->check({Of("parted", other)}) && Since(start) < kPartingSeconds) {
      std::this_thread::sleep_for(kNap);
    }
  }
}

[[noreturn]] void EndBy(const std::string& verdict, const Launch& launch, c10d::Store* store,
                        const JoinOptions& options, SignsOfLife* life) {
  life->LetLeave();
  int exit_code = kExitBadInput;
  if (verdict.starts_with(kFails)) {
    char* end = nullptr;
    const long rank = std::strtol(verdict.c_str() + 1, &end, 10);
    exit_code = static_cast<int>(std::strtol(end, nullptr, 10));
    if (rank == launch.rank && options.failure) SayOfRank(options.failure->line);
  } else if (launch.leads()) {
    SayOfRank(verdict.substr(1));
  }
  PartFromOthers(launch, store);
  throw SaidElsewhere(exit_code);
}

}  // namespace

c10::intrusive_ptr<c10d::TCPStore> ConnectToStore(const Launch& launch, bool serve,
                                                  const JoinOptions& options) {
  const auto start = Clock::now();
  while (true) {
    const double left = WaitOf(launch, options) - Since(start);
    c10d::TCPStoreOptions store;
    store.port = launch.port;
    store.isServer = serve;
    store.waitWorkers = false;
    TakeOwnSockets(&store);
    store.timeout =
        std::chrono::milliseconds(static_cast<int>(1000.0 * std::clamp(left, 1.0, kSayEvery)));
    try {
      auto tcp = c10::make_intrusive<c10d::TCPStore>(launch.host, store);
      tcp->setTimeout(std::chrono::duration_cast<std::chrono::milliseconds>(kLong));
      return tcp;
    } catch (const std::exception& error) {
      if (serve) {
        throw RuntimeFailure("rank 0 cannot listen on port " + std::to_string(launch.port) +
                             " (MASTER_PORT): " + std::string(error.what()).substr(0, 120));
      }
    }
    if (Since(start) >= WaitOf(launch, options)) {
      throw RuntimeFailure("rank 0 does not answer at " + Address(launch) +
                           " (MASTER_ADDR, MASTER_PORT): does it run, and lets the network "
                           "through? ANTIGRASP_LOST_AFTER=300 waits longer");
    }
    if (options.pause) options.pause();
    if (options.say) options.say("waiting for rank 0 at " + Address(launch));
  }
}

void MeetAll(const Launch& launch, c10d::Store* store, const JoinOptions& options,
             SignsOfLife* life) {
  store->set(Of("same", launch.rank), Bytes(Shown(options)));
  store->set(Of("here", launch.rank), Bytes("1"));
  if (launch.leads()) {
    AwaitOthers(launch, store, options);
    store->set(kVerdict, Bytes(Verdict(store, launch.size)));
  } else {
    AwaitMeeting(launch, store, options);
  }
  const std::string verdict = Text(store, kVerdict);
  if (verdict != kAgreed) EndBy(verdict, launch, store, options, life);
}

}  // namespace antigrasp
