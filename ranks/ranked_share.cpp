#include "antigrasp/ranks/ranked_share.h"

#include <thread>
#include <utility>

#include "antigrasp/core/exit_code.h"
#include "antigrasp/core/launch.h"

namespace antigrasp {
namespace {

constexpr char kText = 'T', kEnd = 'E';                     // what rank 0 tells
constexpr char kInput = 'I', kRuntime = 'R';                // what others fail with
constexpr const char *kLeft = "left", *kFailed = "failed";  // counters
constexpr std::chrono::seconds kForRankZero(3);

bool IsSaidElsewhere(const std::exception_ptr& error) {
  try {
    std::rethrow_exception(error);
  } catch (const SaidElsewhere&) {
    return true;
  } catch (...) {
    return false;
  }
}

std::string Failure(std::int64_t number) { return "failure/" + std::to_string(number); }

std::string ToldTo(int rank, std::int64_t number) {
  return "told/" + std::to_string(rank) + "/" + std::to_string(number);
}

}  // namespace

RankedShare::~RankedShare() {
  try {
    if (!leads()) {
      group_->Leave();
      group_->TakeNext(kLeft, 1);
      return;
    }
    TellAll(kEnd, "");
    const auto start = std::chrono::steady_clock::now();
    while (group_->TakeNext(kLeft, 0) + 1 < size() &&
           std::chrono::steady_clock::now() - start < patience_) {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
  } catch (const std::exception&) {  // they are gone already
  }
}

void RankedShare::TellAll(char kind, const std::string& text) {
  for (int rank = 1; rank < size(); ++rank) group_->Put(ToldTo(rank, told_), kind + text);
  ++told_;
}

std::string RankedShare::Told(const std::string& text) {
  if (leads()) {
    TellAll(kText, text);
    return text;
  }
  const std::string told = group_->Wait(ToldTo(group_->rank(), told_++));
  if (told.empty() || (told.front() != kText && told.front() != kEnd)) {
    throw RuntimeFailure("rank 0 told what is none");
  }
  if (told.front() == kEnd) throw WorkOver();
  return told.substr(1);
}

std::int64_t RankedShare::TakeNext(const std::string& counter, std::int64_t count) {
  const std::lock_guard lock(mutex_);
  return group_->TakeNext(counter, count);
}

void RankedShare::Put(const std::string& name, const std::string& bytes) {
  const std::lock_guard lock(mutex_);
  group_->Put(name, bytes);
}

std::optional<std::string> RankedShare::TakeIfThere(const std::string& name) {
  const std::lock_guard lock(mutex_);
  if (group_->Has(name)) return group_->Wait(name);
  if (group_->TakeNext(kFailed, 0) == 0) return std::nullopt;
  const std::string failure = group_->Wait(Failure(0));
  if (!failure.empty() && failure.front() == kInput) throw ToldInputError(failure.substr(1));
  throw RuntimeFailure(failure.empty() ? "another rank failed" : failure.substr(1));
}

void RankedShare::LeaveWith(const std::exception_ptr& error) {
  int exit_code = ExitCodeOf(error);
  if (exit_code == kExitInterrupted) std::rethrow_exception(error);
  bool said = IsSaidElsewhere(error);
  try {
    if (leads() && said) {
      patience_ = std::chrono::seconds(0);  // the others know
      exit_code = FailedWith(exit_code);
    }
    if (!said) {
      if (!leads()) HandIn(error);
      said = group_->TakeNext(kSaid, 1) > 0;
    }
  } catch (const std::exception&) {  // rank 0 is gone, and nobody else can say it
  }
  if (said) throw SaidElsewhere(exit_code);
  std::rethrow_exception(error);
}

// Rank 0 is to speak; where it is in the middle of something for long, this rank will.
void RankedShare::HandIn(const std::exception_ptr& error) {
  std::string words;
  try {
    std::rethrow_exception(error);
  } catch (const std::exception& failure) {
    words = failure.what();
  } catch (...) {
    words = "unknown failure";
  }
  const char kind = ExitCodeOf(error) == kExitBadInput ? kInput : kRuntime;
  group_->Put(Failure(group_->TakeNext(kFailed, 1)),
              kind + ("rank " + std::to_string(rank()) + " on " + HostName() + ": " + words));
  const auto start = std::chrono::steady_clock::now();
  while (group_->TakeNext(kSaid, 0) == 0 &&
         std::chrono::steady_clock::now() - start < kForRankZero) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
}

// Rank 0 that has been left by another: the exit code of that one, if it failed.
int RankedShare::FailedWith(int otherwise) {
  if (group_->TakeNext(kFailed, 0) == 0) return otherwise;
  return group_->Wait(Failure(0)).starts_with(kInput) ? kExitBadInput : kExitFailure;
}

}  // namespace antigrasp
