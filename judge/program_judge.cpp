#include "antigrasp/judge/program_judge.h"

#include <stdlib.h>  // mkdtemp

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <list>
#include <nlohmann/json.hpp>
#include <optional>
#include <system_error>

#include "antigrasp/core/error.h"
#include "antigrasp/core/format.h"
#include "antigrasp/datasets/object_names.h"
#include "antigrasp/judge/line_program.h"
#include "antigrasp/mesh/mesh_file.h"
#include "antigrasp/quality/object_size.h"

namespace antigrasp {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;
using Json = nlohmann::ordered_json;

constexpr double kTick = 0.2;        // seconds
constexpr int kNoSuchCommand = 127;  // of the shell
constexpr std::size_t kShown = 60;   // characters of a line that is no answer

struct Answer {
  std::uint64_t id;
  Verdict verdict;
};

// Python and JavaScript write numbers that JSON has not.
std::string WithWordsQuoted(std::string text) {
  for (const std::string word : {"-Infinity", "Infinity", "NaN"}) {
    const std::string quoted = "\"nan\"";
    for (std::size_t at = 0; (at = text.find(word, at)) != std::string::npos; at += quoted.size()) {
      text.replace(at, word.size(), quoted);
    }
  }
  return text;
}

std::optional<Answer> ReadAnswer(const std::string& line) {
  Json json = Json::parse(line, nullptr, false);
  if (json.is_discarded()) json = Json::parse(WithWordsQuoted(line), nullptr, false);
  if (!json.is_object() || !json.contains("id") || !json["id"].is_number_unsigned()) {
    return std::nullopt;
  }
  Answer answer{json["id"].get<std::uint64_t>(), Verdict::None("not a finite number")};
  if (!json.contains("score")) return answer;
  if (json["score"].is_null()) answer.verdict = Verdict::None("no score");
  if (json["score"].is_number()) answer.verdict = Verdict::Of(json["score"].get<double>());
  return answer;
}

double Since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

}  // namespace

struct ProgramJudge::Folder {
  fs::path path;
  Folder() {
    std::string name = (fs::temp_directory_path() / "antigrasp-judge-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw RuntimeFailure(name + ": " + std::strerror(errno));
    path = name;
  }
  ~Folder() {
    std::error_code ignored;
    fs::remove_all(path, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
};

// What outlives a batch.
struct ProgramJudge::Talk {
  std::optional<LineProgram> program;
  std::uint64_t next_id = 0;
  bool answered = false;  // ever
  int silences = 0;       // time limits in a row without an answer
  int restarts = 0;
  std::string last_end;
  int no_answers = 0, strays = 0;
  std::string first_no_answer;
};

class ProgramJudge::Batch {
 public:
  Batch(ProgramJudge* judge, const std::vector<JudgedObject>& objects)
      : judge_(*judge), talk_(*judge->talk_), verdicts_(objects.size()) {
    for (std::size_t i = 0; i < objects.size(); ++i) {
      verdicts_[i] = Verdict::None("judge stopped");
      if (judge_.stopped_.empty()) waiting_.push_back(Request(i, objects[i]));
    }
  }

  std::vector<Verdict> Run() {
    if (!waiting_.empty()) Ask();
    while (!waiting_.empty() && judge_.stopped_.empty()) {
      const double left = judge_.limits_.seconds - Since(answered_);
      std::string line;
      switch (talk_.program->Wait(std::clamp(left, 0.0, kTick), &line)) {
        case LineProgram::Event::kLine:
          Take(line);
          break;
        case LineProgram::Event::kEnded:
          Died();
          continue;
        case LineProgram::Event::kNothing:
          if (judge_.tick_) judge_.tick_();
          break;
      }
      if (!waiting_.empty() && Since(answered_) >= judge_.limits_.seconds) Late();
    }
    for (const Waiting& one : waiting_) Remove(one.mesh);
    return std::move(verdicts_);
  }

 private:
  struct Waiting {
    std::size_t place;  // in the batch
    std::uint64_t id;
    fs::path mesh;
    std::string line;
    int deaths = 0;  // of judges, while it was the oldest
  };

  Waiting Request(std::size_t place, const JudgedObject& object) {
    Waiting one{place, talk_.next_id++, {}, {}};
    one.mesh =
        judge_.folder_->path / (std::to_string(one.id) + "-" + FileNameOf(object.name) + ".stl");
    WriteMesh(one.mesh, *object.mesh);
    const double metres = MetresPerUnit(judge_.metric_, Bounds(*object.mesh).Extent());
    // Names are bytes of a file system: what is no UTF-8 is replaced.
    one.line = Json({{"id", one.id},
                     {"name", object.name},
                     {"mesh", one.mesh.string()},
                     {"metres_per_unit", metres}})
                   .dump(-1, ' ', false, Json::error_handler_t::replace) +
               "\n";
    return one;
  }

  static void Remove(const fs::path& file) {
    std::error_code ignored;
    fs::remove(file, ignored);
  }

  // Whatever is unanswered, of a judge that is started when there is none.
  void Ask() {
    if (!talk_.program) talk_.program.emplace(judge_.command_);
    for (const Waiting& one : waiting_) talk_.program->Send(one.line);
    answered_ = Clock::now();
  }

  void Decide(std::list<Waiting>::iterator one, Verdict verdict) {
    verdicts_[one->place] = std::move(verdict);
    Remove(one->mesh);
    waiting_.erase(one);
  }

  void Take(const std::string& line) {
    const std::optional<Answer> answer = ReadAnswer(line);
    if (!answer || answer->id >= talk_.next_id) {
      if (talk_.no_answers++ == 0) talk_.first_no_answer = line.substr(0, kShown);
      return;
    }
    const auto one = std::find_if(waiting_.begin(), waiting_.end(),
                                  [&](const Waiting& other) { return other.id == answer->id; });
    if (one == waiting_.end()) {
      ++talk_.strays;
      return;
    }
    talk_.answered = true;
    talk_.silences = 0;
    answered_ = Clock::now();
    Decide(one, answer->verdict);
  }

  void Late() {
    Decide(waiting_.begin(), Verdict::None("late"));
    answered_ = Clock::now();
    if (++talk_.silences > 1) Restart("silent for " + FormatDuration(2.0 * judge_.limits_.seconds));
  }

  void Died() {
    const int code = talk_.program->exit_code();
    if (code == kNoSuchCommand && !talk_.answered) {
      throw InputError("no command " + judge_.command_, "--judge", kJudges);
    }
    if (++waiting_.front().deaths > 1) Decide(waiting_.begin(), Verdict::None("judge died"));
    Restart("ended with exit code " + std::to_string(code));
  }

  void Restart(const std::string& why) {
    talk_.program.reset();
    talk_.silences = 0;
    talk_.last_end = why;
    if (talk_.restarts == judge_.limits_.restarts) {
      judge_.stopped_ =
          judge_.command_ + ": " + why + " after " + std::to_string(talk_.restarts) + " restarts";
      return;
    }
    ++talk_.restarts;
    if (!waiting_.empty()) Ask();
  }

  ProgramJudge& judge_;
  Talk& talk_;
  std::vector<Verdict> verdicts_;
  std::list<Waiting> waiting_;  // oldest first
  Clock::time_point answered_;  // or asked, when nothing was answered since
};

ProgramJudge::ProgramJudge(std::string command, const MetricOptions& metric,
                           const ProgramLimits& limits, std::function<void()> tick)
    : command_(std::move(command)),
      metric_(metric),
      limits_(limits),
      tick_(std::move(tick)),
      folder_(std::make_unique<Folder>()),
      talk_(std::make_unique<Talk>()) {}

ProgramJudge::~ProgramJudge() = default;

std::vector<Verdict> ProgramJudge::Score(const std::vector<JudgedObject>& objects) {
  return Batch(this, objects).Run();
}

void ProgramJudge::TellSettings(const std::function<void(const OptionTable&)>& add) const {
  ProgramLimits limits = limits_;
  OptionTable table;
  table.Add("limit", &limits.seconds, 0.0, 1e6, "s without an answer, then an object is late");
  table.Add("restarts", &limits.restarts, 0, 1e6, "how often it is started again");
  add(table);
}

std::vector<std::string> ProgramJudge::Notes() const {
  std::vector<std::string> notes;
  if (talk_->restarts > 0) {
    notes.push_back("started again " + std::to_string(talk_->restarts) +
                    " times, last: " + talk_->last_end);
  }
  if (talk_->no_answers > 0) {
    notes.push_back(std::to_string(talk_->no_answers) +
                    " lines are no answer, the first: " + talk_->first_no_answer);
  }
  if (talk_->strays > 0) {
    notes.push_back(std::to_string(talk_->strays) + " answers came late or twice");
  }
  return notes;
}

}  // namespace antigrasp
