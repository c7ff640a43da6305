#include "antigrasp/app/console.h"

#include <spdlog/spdlog.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <cstdio>

#include "antigrasp/core/error.h"
#include "antigrasp/core/format.h"
#include "antigrasp/core/launch.h"

namespace antigrasp {
namespace {

using Clock = std::chrono::steady_clock;

volatile std::sig_atomic_t g_interrupted = 0;

extern "C" void OnSignal(int signal) {
  if (g_interrupted) {
    std::signal(signal, SIG_DFL);
    std::raise(signal);
  }
  g_interrupted = 1;
}

double SecondsSince(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

}  // namespace

void InstallSignalHandlers() {
  std::signal(SIGINT, OnSignal);
  std::signal(SIGTERM, OnSignal);
}

bool InterruptRequested() { return g_interrupted != 0; }

struct ConsoleObserver::Bar {
  std::string label;
  std::string detail;
  bool terminal = isatty(STDERR_FILENO) != 0, leads = LeadsJob();
  std::int64_t first = -1;  // items done when the bar began (a resumed phase starts in the middle)
  Clock::time_point start = Clock::now();
  Clock::time_point shown{};

  void Report(std::int64_t done, std::int64_t total) {
    if (!leads) return;
    if (first < 0) first = done - 1;
    const bool last = done == total;
    const double wait = terminal ? 0.1 : 10.0;
    if (!last && SecondsSince(shown) < wait && shown != Clock::time_point{}) return;
    if (!last && !terminal && SecondsSince(start) < wait) return;
    shown = Clock::now();
    const double elapsed = SecondsSince(start);
    const double rate = double(done - first) / std::max(elapsed, 1e-9);
    char numbers[96];
    std::snprintf(numbers, sizeof numbers, "%lld/%lld  %3.0f %%  %.3g/s", (long long)done,
                  (long long)total, 100.0 * double(done) / double(total), rate);
    std::string line = label + "  " + numbers;
    line += last ? "  took " + FormatDuration(elapsed)
                 : "  left " + FormatDuration(double(total - done) / rate);
    if (!detail.empty()) line += "  " + detail;
    std::fprintf(stderr, terminal ? (last ? "\r\033[K%s\n" : "\r\033[K%s") : "%s\n", line.c_str());
    std::fflush(stderr);
  }
};

ConsoleObserver::ConsoleObserver() : bar_(std::make_shared<Bar>()) {}

ProgressFn ConsoleObserver::Phase(const std::string& label) {
  bar_ = std::make_shared<Bar>();
  bar_->label = label;
  return [bar = bar_](std::int64_t done, std::int64_t total) {
    bar->Report(done, total);
    ThrowIfInterrupted();
  };
}

void ConsoleObserver::Detail(const std::string& text) { bar_->detail = text; }

void ConsoleObserver::Note(const std::string& text) {
  if (bar_->terminal) std::fputs("\r\033[K", stderr);
  spdlog::info("{}", text);
}

bool ConsoleObserver::StopRequested() const { return InterruptRequested(); }

void ThrowIfInterrupted() {
  if (InterruptRequested()) throw Interrupted();
}

void Warn(const std::string& text) { spdlog::warn("{}", text); }

}  // namespace antigrasp
