#include "antigrasp/ranks/follow.h"

#include <sstream>

#include "antigrasp/core/background_process.h"
#include "antigrasp/core/error.h"
#include "antigrasp/core/version.h"
#include "antigrasp/ranks/job.h"
#include "antigrasp/ranks/made_together.h"
#include "antigrasp/ranks/ranked_model.h"
#include "antigrasp/ranks/ranked_scorer.h"
#include "antigrasp/ranks/ranked_share.h"
#include "antigrasp/train/gan_model.h"

namespace antigrasp {
namespace {

// A rank that repeats what rank 0's model does.
class Follower {
 public:
  Follower(RankGroup* group, WorkShare* work, const JudgeMaker& make_judge,
           const MeshRefiner& refine)
      : group_(group), work_(work), make_judge_(make_judge), refine_(refine), share_(group) {}

  // Whether there is more to do.
  bool Obey() {
    const OrderHeader heard = TellOrHear(group_, {});
    switch (heard.order) {
      case Order::kModel:
        Make(group_->TextFromLeader(""));
        break;
      case Order::kBeginEpisode:
        model_->BeginEpisode(static_cast<int>(heard.a), heard.b, heard.c != 0);
        break;
      case Order::kLoad:
        model_->Load(StateFromLeader(group_, {}), "rank 0");
        break;
      case Order::kShapes:
        shapes_ = group_->TensorFromLeader({}).to(model_->device());
        break;
      case Order::kStep:
        if (group_->rank() < config_.gan.micro_batches) model_->Step(shapes_);
        break;
      case Order::kSample:
        SampleTogether(group_, model_.get(), static_cast<std::uint64_t>(heard.a), heard.b, heard.c);
        break;
      case Order::kScore:
        ScoreTogether(work_, heard.a, group_->TensorFromLeader({}), config_, JudgeOf(), nullptr);
        break;
      case Order::kPrior:
        HelpWithPrior(work_);
        break;
      case Order::kRefine:
        HelpRefining(work_, refine_, config_);
        break;
      case Order::kEnd:
        return false;
    }
    return true;
  }

 private:
  void Make(const std::string& toml) {
    config_ = FromToml(toml, "rank 0");
    model_ = SharingGan(config_, &share_);
    judge_.reset();
  }

  Judge* JudgeOf() {
    if (config_.cem.score == kEpsilonScore) return nullptr;
    if (judge_ == nullptr) judge_ = make_judge_(config_);
    return judge_.get();
  }

  RankGroup* group_;
  WorkShare* work_;
  const JudgeMaker& make_judge_;
  const MeshRefiner& refine_;
  SharedBatch share_;
  RunConfig config_;
  std::unique_ptr<ShapeModel> model_;
  std::unique_ptr<Judge> judge_;
  torch::Tensor shapes_;
};

}  // namespace

std::unique_ptr<ShapeModel> SharingGan(const RunConfig& config, BatchShare* share) {
  GanTrainer trainer = MakeTrainer(config);
  trainer.ShareBatches(share);
  return std::make_unique<GanModel>(std::move(trainer));
}

Leader::Leader(RankGroup* group) : group_(group), share_(std::make_unique<SharedBatch>(group)) {}

Leader::~Leader() {
  try {
    TellOrHear(group_, {Order::kEnd});
  } catch (const std::exception&) {  // they are gone already
  }
}

ShapeModelMaker Leader::maker() {
  return [this](const RunConfig& config) -> std::unique_ptr<ShapeModel> {
    std::unique_ptr<ShapeModel> model = SharingGan(config, share_.get());  // refuses first
    TellOrHear(group_, {Order::kModel});
    group_->TextFromLeader(ToToml(config));
    return std::make_unique<RankedModel>(std::move(model), group_, config.gan.micro_batches);
  };
}

void FollowRanks(RankGroup* group, WorkShare* work, const JudgeMaker& make_judge,
                 const MeshRefiner& refine) {
  Follower follower(group, work, make_judge, refine);
  while (follower.Obey()) {
  }
}

namespace {

// This program again, which goes on with a run.
class RunInBackground : public RunBeside {
 public:
  explicit RunInBackground(const std::filesystem::path& folder)
      : process_("/proc/self/exe", {"antigrasp", "train", "--resume", folder.string()}) {}
  bool Ended() override { return process_.Ended(); }
  std::string WhyEnded() const override { return process_.end().text; }

 private:
  BackgroundProcess process_;
};

void Lead(RankGroup* group, RankedShare* work, const RunFn& run, const RunParts& parts) {
  Leader leader(group);
  try {
    run(leader.maker(), parts);
  } catch (...) {  // said before the others are told the end
    work->LeaveWith(std::current_exception());
  }
}

void Follow(RankGroup* group, RankedShare* work, const JudgeMaker& make_judge,
            const MeshRefiner& refine) {
  try {
    FollowRanks(group, work, make_judge, refine);
  } catch (const WorkOver&) {
  } catch (...) {
    work->LeaveWith(std::current_exception());
  }
}

}  // namespace

void RunAsJob(int processes, const std::function<std::vector<std::string>()>& same,
              const std::function<void()>& pause, const JudgeMaker& make_judge,
              const MeshRefiner& refine, const RunFn& run) {
  const std::unique_ptr<Ranks> ranks = JoinRanks(processes, same, pause);
  if (ranks == nullptr) {
    const BesideStarter beside = [](const std::filesystem::path& folder) {
      return std::make_unique<RunInBackground>(folder);
    };
    return run(MakeGan, {make_judge, InThreads(refine), {}, {}, beside});
  }
  RankGroup* const group = &ranks->group();
  RankedShare work(group);
  if (!group->leads()) return Follow(group, &work, make_judge, refine);
  Lead(group, &work, run,
       {make_judge, RankedRefiner(group, &work, refine), RankedScorer(group, &work),
        RankedPrior(group, &work)});
  SayOfRank(ranks->group().SentText());
}

std::vector<std::string> SameForAll(const RunConfig& config) {
  std::vector<std::string> same = {"antigrasp " + ProgramVersion() + " (" + ProgramCommit() + ")"};
  std::istringstream lines(ToToml(config));
  std::string section;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("[")) section = line.substr(1, line.find(']') - 1) + ".";
    const std::string setting = line.substr(0, line.find("  #"));
    if (setting.find('=') != std::string::npos) same.push_back(section + setting);
  }
  return same;
}

}  // namespace antigrasp
