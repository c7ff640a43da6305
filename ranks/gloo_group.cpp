// RankGroup on c10d. The one file that knows that LibTorch 1.13 and 2.x differ here.
#include <torch/csrc/distributed/c10d/PrefixStore.hpp>
#include <torch/csrc/distributed/c10d/ProcessGroupGloo.hpp>
#include <torch/csrc/distributed/c10d/TCPStore.hpp>

#include <chrono>
#include <cstdlib>
#include <exception>
#include <map>
#include <stdexcept>
#include <thread>
#include <utility>

#include "antigrasp/core/error.h"
#include "antigrasp/ranks/rank_group.h"
#include "antigrasp/ranks/signs_of_life.h"

namespace antigrasp {
namespace {

using Clock = std::chrono::steady_clock;
using StorePtr = c10::intrusive_ptr<c10d::Store>;

constexpr std::chrono::seconds kSayEvery(10);
// Of one collective: rank 0 may score, choose and save for long between two. Who is dead is
// noticed by SignsOfLife.
constexpr std::chrono::hours kLong(24);

constexpr double kPartingSeconds = 10.0;

double Since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

std::string Address(const Launch& launch) {
  return launch.host + ":" + std::to_string(launch.port);
}

std::vector<std::uint8_t> Bytes(const std::string& text) { return {text.begin(), text.end()}; }

// LibTorch 2.x asks for libuv's sockets by default; Debian's is built without them.
template <typename Options>
void TakeOwnSockets(Options* store) {
  if constexpr (requires { store->useLibUV; }) store->useLibUV = false;
}

// A connection to the store; tried again until it stands, and said every ten seconds.
c10::intrusive_ptr<c10d::TCPStore> Connect(const Launch& launch, bool serve,
                                           const JoinOptions& options) {
  const auto start = Clock::now();
  while (true) {
    c10d::TCPStoreOptions store;
    store.port = launch.port;
    store.isServer = serve;
    store.waitWorkers = false;
    TakeOwnSockets(&store);
    store.timeout = kSayEvery;
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
    if (Since(start) > options.patience_seconds) {
      throw RuntimeFailure(
          "rank 0 does not answer at " + Address(launch) +
          " (MASTER_ADDR, MASTER_PORT): does it run, and lets the network through?");
    }
    if (options.pause) options.pause();
    if (options.say) options.say("waiting for rank 0 at " + Address(launch));
  }
}

// What c10d throws is about sockets; whoever reads it wants to know who is missing.
template <typename Work>
auto ToOthers(const Work& work) {
  try {
    return work();
  } catch (const InputError&) {  // ours
    throw;
  } catch (const RuntimeFailure&) {
    throw;
  } catch (const Interrupted&) {
    throw;
  } catch (const c10::Error&) {
    throw RuntimeFailure("another process of the job is gone; what was saved stays");
  } catch (const std::runtime_error&) {
    throw RuntimeFailure("another process of the job is gone; what was saved stays");
  }
}

class GlooGroup : public RankGroup {
 public:
  GlooGroup(const Launch& launch, const JoinOptions& options);

  int rank() const override { return rank_; }
  int size() const override { return size_; }
  std::vector<torch::Tensor> AllOfFirst(int ranks, const torch::Tensor& mine) override;
  torch::Tensor ToEachOfFirst(int ranks, const torch::Tensor& slices) override;
  void FromLeader(torch::Tensor* tensor) override;
  std::int64_t TakeNext(const std::string& counter, std::int64_t count) override;
  void Put(const std::string& name, const std::string& bytes) override;
  std::string Wait(const std::string& name) override;
  bool Has(const std::string& name) override;

 private:
  StorePtr Prefixed(const Launch& launch, const StorePtr& store) const;
  void Meet(const JoinOptions& options);
  void Compare(const std::vector<std::string>& same);
  void PartFromOthers();
  void ConnectAll(const Launch& launch);
  c10d::ProcessGroupGloo* First(int ranks);

  int rank_, size_;
  StorePtr store_;
  std::unique_ptr<SignsOfLife> life_;
  c10::intrusive_ptr<c10d::ProcessGroupGloo::Options> options_;
  // By the number of ranks; the whole group from the beginning, others when they are asked for.
  std::map<int, c10::intrusive_ptr<c10d::ProcessGroupGloo>> first_;
};

GlooGroup::GlooGroup(const Launch& launch, const JoinOptions& options)
    : rank_(launch.rank), size_(launch.size) {
  Launch at = launch;
  const bool serves = launch.leads() && !launch.store_is_there;
  const auto tcp = Connect(launch, serves, options);
  at.port = tcp->getPort();
  if (serves && options.listening) options.listening(at.port);
  store_ = Prefixed(launch, tcp);
  life_ = std::make_unique<SignsOfLife>(Prefixed(launch, Connect(at, false, options)), rank_, size_,
                                        options.lost_after_seconds);
  ToOthers([&] {
    Meet(options);
    Compare(options.same);
    return true;
  });
  ConnectAll(launch);
}

StorePtr GlooGroup::Prefixed(const Launch& launch, const StorePtr& store) const {
  return c10::make_intrusive<c10d::PrefixStore>(launch.prefix + "/antigrasp", store);
}

// All are there; until then rank 0 says who is missing.
void GlooGroup::Meet(const JoinOptions& options) {
  const auto here = [](int rank) { return "here/" + std::to_string(rank); };
  store_->set(here(rank_), Bytes("1"));
  const auto start = Clock::now();
  double said = 0.0;
  while (true) {
    std::string missing;
    int count = 0;
    for (int other = 0; other < size_; ++other) {
      if (store_->check({here(other)})) continue;
      if (++count <= 8) missing += (missing.empty() ? "" : ", ") + std::to_string(other);
    }
    if (count == 0) return;
    if (count > 8) missing += " and " + std::to_string(count - 8) + " more";
    const std::string text =
        "waiting for rank " + missing + " of " + std::to_string(size_) + " (they count from 0)";
    const double waited = Since(start);
    if (waited > options.patience_seconds) {
      throw RuntimeFailure("gave up after " + std::to_string(static_cast<int>(waited)) + " s " +
                           text);
    }
    if (rank_ == 0 && options.say && waited - said > static_cast<double>(kSayEvery.count())) {
      said = waited;
      options.say(text);
    }
    if (options.pause) options.pause();
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
}

// Every rank shows what it has; every rank refuses where one has another.
void GlooGroup::Compare(const std::vector<std::string>& same) {
  const auto name = [](int rank) { return "same/" + std::to_string(rank); };
  std::string all;
  for (const std::string& line : same) all += line + "\n";
  store_->set(name(rank_), Bytes(all));
  const auto of = [&](int rank) {
    const std::vector<std::uint8_t> bytes = store_->get(name(rank));
    return std::string(bytes.begin(), bytes.end());
  };
  const std::string leader = of(0);
  for (int other = 1; other < size_; ++other) {
    const std::string theirs = of(other);
    if (theirs == leader) continue;
    std::size_t at = 0;
    while (at < theirs.size() && at < leader.size() && theirs[at] == leader[at]) ++at;
    const auto line = [&](const std::string& text) {
      const std::size_t begin = at == 0 ? 0 : text.rfind('\n', at - 1) + 1;
      const std::string found = text.substr(begin, text.find('\n', begin) - begin);
      return found.empty() ? std::string("nothing") : found.substr(0, 200);
    };
    PartFromOthers();
    throw InputError("rank " + std::to_string(other) + " has " + line(theirs), "start of the job",
                     "what rank 0 has: " + line(leader));
  }
}

// All have seen why the job ends before rank 0 ends with the store that they read it from.
void GlooGroup::PartFromOthers() {
  life_.reset();
  const auto parted = [](int rank) { return "parted/" + std::to_string(rank); };
  store_->set(parted(rank_), Bytes("1"));
  if (rank_ != 0) return;
  const auto start = Clock::now();
  for (int other = 1; other < size_; ++other) {
    while (!store_->check({parted(other)}) && Since(start) < kPartingSeconds) {
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
  }
}

void GlooGroup::ConnectAll(const Launch& launch) {
  options_ = c10d::ProcessGroupGloo::Options::create(
      std::chrono::duration_cast<std::chrono::milliseconds>(std::chrono::minutes(2)));
  const char* interface = std::getenv("GLOO_SOCKET_IFNAME");
  try {
    if (interface != nullptr && *interface != '\0') {
      options_->devices.push_back(c10d::ProcessGroupGloo::createDeviceForInterface(interface));
    } else if (launch.local == launch.size || launch.host == "127.0.0.1" ||
               launch.host == "localhost") {
      options_->devices.push_back(c10d::ProcessGroupGloo::createDeviceForHostname("127.0.0.1"));
    } else {
      options_->devices.push_back(c10d::ProcessGroupGloo::createDefaultDevice());
    }
    First(size_);
  } catch (const std::exception& error) {
    throw RuntimeFailure("the ranks do not reach each other (" +
                         std::string(error.what()).substr(0, 120) +
                         "): GLOO_SOCKET_IFNAME names the one network interface to use");
  }
}

c10d::ProcessGroupGloo* GlooGroup::First(int ranks) {
  auto& group = first_[ranks];
  if (!group) {
    const auto store =
        c10::make_intrusive<c10d::PrefixStore>("first" + std::to_string(ranks), store_);
    group = c10::make_intrusive<c10d::ProcessGroupGloo>(store, rank_, ranks, options_);
  }
  return group.get();
}

std::vector<torch::Tensor> GlooGroup::AllOfFirst(int ranks, const torch::Tensor& mine) {
  std::vector<torch::Tensor> in = {mine.contiguous()};
  std::vector<std::vector<torch::Tensor>> out(1);
  for (int r = 0; r < ranks; ++r) out[0].push_back(torch::empty_like(in[0]));
  c10d::AllgatherOptions options;
  options.timeout = kLong;
  ToOthers([&] { return First(ranks)->allgather(out, in, options)->wait(); });
  Count(static_cast<std::int64_t>(in[0].nbytes()) * (ranks - 1));
  return out[0];
}

torch::Tensor GlooGroup::ToEachOfFirst(int ranks, const torch::Tensor& slices) {
  torch::Tensor in = slices.contiguous(), out = torch::empty_like(in);
  std::vector<std::int64_t> equal;
  c10d::AllToAllOptions options;
  options.timeout = kLong;
  ToOthers([&] { return First(ranks)->alltoall_base(out, in, equal, equal, options)->wait(); });
  Count(static_cast<std::int64_t>(in.nbytes()) * (ranks - 1) / ranks);
  return out;
}

void GlooGroup::FromLeader(torch::Tensor* tensor) {
  // As bytes: Gloo in some builds of LibTorch knows no half precision.
  std::vector<torch::Tensor> tensors = {tensor->view({-1}).view(at::kByte)};
  c10d::BroadcastOptions options;
  options.rootRank = 0;
  options.timeout = kLong;
  ToOthers([&] { return First(size_)->broadcast(tensors, options)->wait(); });
  if (leads()) Count(static_cast<std::int64_t>(tensor->nbytes()) * (size_ - 1));
}

std::int64_t GlooGroup::TakeNext(const std::string& counter, std::int64_t count) {
  Count(static_cast<std::int64_t>(counter.size()));
  return ToOthers([&] { return store_->add("next/" + counter, count); }) - count;
}

void GlooGroup::Put(const std::string& name, const std::string& bytes) {
  Count(static_cast<std::int64_t>(bytes.size()));
  ToOthers([&] {
    store_->set("put/" + name, Bytes(bytes));
    return true;
  });
}

std::string GlooGroup::Wait(const std::string& name) {
  const std::vector<std::uint8_t> bytes = ToOthers([&] { return store_->get("put/" + name); });
  store_->deleteKey("put/" + name);
  return {bytes.begin(), bytes.end()};
}

bool GlooGroup::Has(const std::string& name) {
  return ToOthers([&] { return store_->check({"put/" + name}); });
}

}  // namespace

bool CanJoin() { return true; }

std::unique_ptr<RankGroup> RankGroup::Join(const Launch& launch, const JoinOptions& options) {
  return std::make_unique<GlooGroup>(launch, options);
}

}  // namespace antigrasp
