// RankGroup on c10d. LibTorch 1.13 and 2.x differ here and in meeting.cpp alone.
#include <torch/csrc/distributed/c10d/PrefixStore.hpp>
#include <torch/csrc/distributed/c10d/ProcessGroupGloo.hpp>

#include <chrono>
#include <cstdlib>
#include <exception>
#include <map>
#include <stdexcept>
#include <utility>

#include "antigrasp/core/error.h"
#include "antigrasp/core/exit_code.h"
#include "antigrasp/ranks/meeting.h"
#include "antigrasp/ranks/rank_group.h"
#include "antigrasp/ranks/signs_of_life.h"

namespace antigrasp {
namespace {

using StorePtr = c10::intrusive_ptr<c10d::Store>;

// Of one collective: rank 0 may score, choose and save for long between two. Who is dead is
// noticed by SignsOfLife.
constexpr std::chrono::hours kLong(24);

class GlooGroup : public RankGroup {
 public:
  GlooGroup(const Launch& launch, const JoinOptions& options);

  int rank() const override { return rank_; }
  int size() const override { return size_; }
  std::vector<torch::Tensor> AllOfFirst(int ranks, const torch::Tensor& mine) override;
  torch::Tensor ToEachOfFirst(int ranks, const torch::Tensor& slices) override;
  void FromLeader(torch::Tensor* tensor) override;
  void GiveLeader(const torch::Tensor& tensor) override;
  void TakeFrom(int rank, torch::Tensor* tensor) override;
  std::int64_t TakeNext(const std::string& counter, std::int64_t count) override;
  void Put(const std::string& name, const std::string& bytes) override;
  std::string Wait(const std::string& name) override;
  bool Has(const std::string& name) override;
  void Leave() override { life_->SayGoodbye(); }

 private:
  StorePtr Prefixed(const Launch& launch, const StorePtr& store) const;
  void ConnectAll(const Launch& launch);
  template <typename Work>
  auto ToOthers(const Work& work);
  c10d::ProcessGroupGloo* First(int ranks);

  int rank_, size_;
  StorePtr store_;
  std::unique_ptr<SignsOfLife> life_;
  c10::intrusive_ptr<c10d::ProcessGroupGloo::Options> options_;
  // By the number of ranks; the whole group from the beginning, others when they are asked for.
  std::map<int, c10::intrusive_ptr<c10d::ProcessGroupGloo>> first_;
};

// What c10d throws is about sockets; whoever reads it wants to know who is missing.
template <typename Work>
auto GlooGroup::ToOthers(const Work& work) {
  std::string broken;
  try {
    return work();
  } catch (const InputError&) {  // ours
    throw;
  } catch (const RuntimeFailure&) {
    throw;
  } catch (const Interrupted&) {
    throw;
  } catch (const c10::Error& error) {
    broken = error.what_without_backtrace();
  } catch (const std::runtime_error& error) {
    broken = error.what();
  }
  if (life_->FindWhoIsGone()) throw SaidElsewhere(kExitFailure);
  throw RuntimeFailure("a connection to another process of the job broke (" +
                       broken.substr(0, 120) + "); what was saved stays");
}

GlooGroup::GlooGroup(const Launch& launch, const JoinOptions& options)
    : rank_(launch.rank), size_(launch.size) {
  Launch at = launch;
  const bool serves = launch.leads() && !launch.store_is_there;
  const auto tcp = ConnectToStore(launch, serves, options);
  at.port = tcp->getPort();
  if (serves && options.listening) options.listening(at.port);
  store_ = Prefixed(launch, tcp);
  life_ =
      std::make_unique<SignsOfLife>(Prefixed(launch, ConnectToStore(at, false, options)), launch);
  ToOthers([&] {
    MeetAll(launch, store_.get(), options, life_.get());
    return true;
  });
  ConnectAll(launch);
  life_->LetLeave();
}

StorePtr GlooGroup::Prefixed(const Launch& launch, const StorePtr& store) const {
  return c10::make_intrusive<c10d::PrefixStore>(launch.prefix + "/antigrasp", store);
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
    if (life_->FindWhoIsGone()) throw SaidElsewhere(kExitFailure);
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

void GlooGroup::GiveLeader(const torch::Tensor& tensor) {
  std::vector<torch::Tensor> tensors = {tensor};
  ToOthers([&] { return First(size_)->send(tensors, 0, 0)->wait(kLong); });
  Count(static_cast<std::int64_t>(tensor.nbytes()));
}

void GlooGroup::TakeFrom(int rank, torch::Tensor* tensor) {
  std::vector<torch::Tensor> tensors = {*tensor};
  ToOthers([&] { return First(size_)->recv(tensors, rank, 0)->wait(kLong); });
}

std::int64_t GlooGroup::TakeNext(const std::string& counter, std::int64_t count) {
  Count(static_cast<std::int64_t>(counter.size()));
  return ToOthers([&] { return store_->add(CounterKey(counter), count); }) - count;
}

void GlooGroup::Put(const std::string& name, const std::string& bytes) {
  Count(static_cast<std::int64_t>(bytes.size()));
  ToOthers([&] {
    store_->set("put/" + name, {bytes.begin(), bytes.end()});
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
