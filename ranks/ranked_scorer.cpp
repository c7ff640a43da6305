#include "antigrasp/ranks/ranked_scorer.h"

#include <algorithm>
#include <chrono>
#include <memory>
#include <numeric>
#include <optional>
#include <set>
#include <thread>
#include <utility>

#include "antigrasp/core/bytes.h"
#include "antigrasp/core/error.h"
#include "antigrasp/core/parallel.h"
#include "antigrasp/ranks/ranked_model.h"

namespace antigrasp {
namespace {

constexpr std::int64_t kBeyondAll = std::int64_t{1} << 40;

// Ends the sharing on the way out: the others find nothing left to take.
class TakeTheRest {
 public:
  TakeTheRest(WorkShare* share, std::string counter)
      : share_(share), counter_(std::move(counter)) {}
  ~TakeTheRest() {
    try {
      share_->TakeNext(counter_, kBeyondAll);
    } catch (const std::exception&) {  // the store is gone, and with it who would ask
    }
  }
  TakeTheRest(const TakeTheRest&) = delete;
  TakeTheRest& operator=(const TakeTheRest&) = delete;

 private:
  WorkShare* share_;
  std::string counter_;
};

// Enough for every thread, and a small part of the whole, so that all end at about one time.
std::int64_t ChunkOf(std::int64_t count, const RunConfig& config, int ranks) {
  const std::int64_t threads = config.threads > 0 ? config.threads : HardwareThreads();
  return std::clamp<std::int64_t>(count / (16 * ranks), 2 * threads, 64 * threads);
}

ScoredStage ScoreChunk(const torch::Tensor& values, std::int64_t first, std::int64_t count,
                       const RunConfig& config, Judge* judge) {
  std::vector<std::int64_t> indices(static_cast<std::size_t>(count));
  std::iota(indices.begin(), indices.end(), first);
  const torch::Tensor chunk = values.slice(0, first, first + count);
  if (judge != nullptr) return JudgeSamples(judge, chunk, indices, config, nullptr);
  return ScoreSamples(chunk, indices, config, nullptr);
}

std::string NameOf(const std::string& counter, std::int64_t first) {
  return counter + "/" + std::to_string(first);
}

}  // namespace

std::string BytesOf(const ScoredStage& stage) {
  ByteWriter bytes;
  bytes.Put(static_cast<std::uint64_t>(stage.objects.size()));
  for (std::size_t i = 0; i < stage.objects.size(); ++i) {
    const RemeshResult& object = stage.objects[i];
    const Graspability& score = stage.scores[i];
    bytes.Put(object.status);
    std::vector<double> numbers;
    for (const Eigen::Vector3d& v : object.mesh.vertices)
      numbers.insert(numbers.end(), v.data(), v.data() + 3);
    bytes.PutAll(numbers);
    bytes.PutAll(object.mesh.faces);
    bytes.Put(stage.graspabilities[i]);
    bytes.Put(score.status);
    for (const double x : {score.value, score.ci_low, score.ci_high, score.mean,
                           score.fraction_nonzero, score.scale, score.seconds}) {
      bytes.Put(x);
    }
    bytes.Put(score.attempts);
    bytes.Put(static_cast<std::uint64_t>(score.grasps.size()));
  }
  return bytes.Take();
}

void TakeScored(const std::string& bytes, std::int64_t first, ScoredStage* all) {
  ByteReader reader(bytes);
  const auto count = reader.Get<std::uint64_t>();
  const auto begin = static_cast<std::size_t>(first);
  if (count > all->objects.size() - begin)
    throw RuntimeFailure("another process sent too many scores");
  for (std::size_t i = begin; i < begin + count; ++i) {
    RemeshResult& object = all->objects[i];
    Graspability& score = all->scores[i];
    object.status = reader.Get<RemeshStatus>();
    const std::vector<double> numbers = reader.GetAll<double>();
    object.mesh.vertices.resize(numbers.size() / 3);
    for (std::size_t v = 0; v < object.mesh.vertices.size(); ++v) {
      object.mesh.vertices[v] = Eigen::Map<const Eigen::Vector3d>(&numbers[3 * v]);
    }
    object.mesh.faces = reader.GetAll<std::array<std::int32_t, 3>>();
    if (!IsFinite(object.mesh)) throw RuntimeFailure("another process sent a mesh that is none");
    all->graspabilities[i] = reader.Get<double>();
    score.status = reader.Get<GraspabilityStatus>();
    for (double* x : {&score.value, &score.ci_low, &score.ci_high, &score.mean,
                      &score.fraction_nonzero, &score.scale, &score.seconds}) {
      *x = reader.Get<double>();
    }
    score.attempts = reader.Get<int>();
    const auto grasps = reader.Get<std::uint64_t>();
    if (grasps > 1000000) throw RuntimeFailure("another process sent too many grasps");
    score.grasps.resize(grasps);
  }
  reader.End();
}

ScoredStage ScoreTogether(WorkShare* share, std::int64_t job, const torch::Tensor& values,
                          const RunConfig& config, Judge* judge, const ProgressFn& progress) {
  const std::string counter = "score" + std::to_string(job);
  const std::int64_t count = values.size(0);
  const std::int64_t chunk = ChunkOf(count, config, share->size());
  ScoredStage all;
  if (share->leads()) {
    all.values = values;
    all.objects.resize(static_cast<std::size_t>(count));
    all.scores.resize(static_cast<std::size_t>(count));
    all.graspabilities.resize(static_cast<std::size_t>(count));
  }
  std::unique_ptr<TakeTheRest> rest;
  if (share->leads()) rest = std::make_unique<TakeTheRest>(share, counter);
  std::set<std::int64_t> own;
  std::int64_t shown = 0;
  const auto show = [&](std::int64_t done) {
    shown = done;
    if (progress) progress(done, count);
  };
  for (std::int64_t first = share->TakeNext(counter, chunk); first < count;
       first = share->TakeNext(counter, chunk)) {
    const std::int64_t taken = std::min(chunk, count - first);
    const std::string bytes = BytesOf(ScoreChunk(values, first, taken, config, judge));
    if (!share->leads()) {
      share->Put(NameOf(counter, first), bytes);
      continue;
    }
    TakeScored(bytes, first, &all);
    own.insert(first);
    show(first + taken);  // the others have taken those before
  }
  if (!share->leads()) return all;
  for (std::int64_t first = 0; first < count; first += chunk) {
    if (own.count(first) > 0) continue;
    std::optional<std::string> theirs;
    while (!(theirs = share->TakeIfThere(NameOf(counter, first)))) {
      if (shown > 0) show(shown);  // hears Ctrl-C
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    TakeScored(*theirs, first, &all);
  }
  show(count);
  return all;
}

ScorerMaker RankedScorer(RankGroup* group, WorkShare* share) {
  const auto jobs = std::make_shared<std::int64_t>(0);
  return [group, share, jobs](const RunConfig& config, Judge* judge, RunObserver* observer) {
    return [=, &config](const torch::Tensor& values, const std::string& name) {
      const std::int64_t job = (*jobs)++;
      TellOrHear(group, {Order::kScore, job});
      const torch::Tensor told = group->TensorFromLeader(values);
      return ScoreTogether(share, job, told, config, judge, PhaseOf(observer, name));
    };
  };
}

}  // namespace antigrasp
