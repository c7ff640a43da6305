#include "antigrasp/ranks/ranked_share.h"

#include <thread>
#include <utility>

#include "antigrasp/core/error.h"

namespace antigrasp {
namespace {

constexpr char kText = 'T', kEnd = 'E';                     // what rank 0 tells
constexpr char kInput = 'I', kRuntime = 'R';                // what others fail with
constexpr const char *kLeft = "left", *kFailed = "failed";  // counters

// Of another rank, in its words.
class ToldInputError : public InputError {
 public:
  explicit ToldInputError(std::string line) : InputError("", "", ""), line_(std::move(line)) {}
  const char* what() const noexcept override { return line_.c_str(); }

 private:
  std::string line_;
};

std::string Failure(std::int64_t number) { return "failure/" + std::to_string(number); }

std::string ToldTo(int rank, std::int64_t number) {
  return "told/" + std::to_string(rank) + "/" + std::to_string(number);
}

}  // namespace

RankedShare::~RankedShare() {
  try {
    if (!leads()) {
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

void RankedShare::Fail(const std::exception_ptr& error) {
  std::string failure;
  try {
    std::rethrow_exception(error);
  } catch (const InputError& input) {
    failure = kInput + std::string(input.what());
  } catch (const std::exception& other) {
    failure = kRuntime + std::string(other.what());
  }
  group_->Put(Failure(group_->TakeNext(kFailed, 1)), failure);
}

}  // namespace antigrasp
