#include "antigrasp/ranks/run_shared.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <memory>
#include <sstream>

#include "antigrasp/core/atomic_file.h"
#include "antigrasp/core/format.h"
#include "antigrasp/core/rng.h"
#include "antigrasp/core/version.h"
#include "antigrasp/ranks/job.h"
#include "antigrasp/ranks/ranked_share.h"

namespace antigrasp {
namespace {

namespace fs = std::filesystem;

// Each with one value.
constexpr std::array kOfOneRank = {"--out", "--report", "--grasps", "--threads", "--processes"};
constexpr std::uintmax_t kSmallFile = 1 << 20;

bool IsOfOneRank(const std::string& option) {
  return std::find(kOfOneRank.begin(), kOfOneRank.end(), option) != kOfOneRank.end();
}

// An option, but no negative number.
bool IsOption(const std::string& word) {
  return word.size() > 1 && word[0] == '-' && word.find_first_of("0123456789.") != 1;
}

// "3 files, 5120 bytes, 1f00ba12" of a file or folder; empty where there is none.
std::string Held(const fs::path& path) {
  std::error_code error;
  std::vector<std::string> found;
  std::uintmax_t bytes = 0;
  const auto add = [&](const fs::path& file) {
    const std::uintmax_t size = fs::file_size(file, error);
    if (error) return;
    bytes += size;
    std::string line = file.lexically_relative(path).string() + " " + std::to_string(size);
    if (size <= kSmallFile && file == path) line += " " + ReadFile(file);
    found.push_back(line);
  };
  if (fs::is_regular_file(path, error)) {
    add(path);
  } else if (fs::is_directory(path, error)) {
    const auto options = fs::directory_options::skip_permission_denied |
                         fs::directory_options::follow_directory_symlink;
    for (auto it = fs::recursive_directory_iterator(path, options, error);
         !error && it != fs::recursive_directory_iterator(); it.increment(error)) {
      if (it->is_regular_file(error)) add(it->path());
    }
  }
  if (found.empty()) return "";
  std::sort(found.begin(), found.end());
  std::string all;
  for (const std::string& line : found) all += line + "\n";
  std::ostringstream text;
  text << found.size() << (found.size() == 1 ? " file, " : " files, ") << bytes << " bytes, "
       << std::hex << HashOf(all);
  return text.str();
}

}  // namespace

std::vector<std::string> SameCall(const std::vector<std::string>& words) {
  std::vector<std::string> same = {"antigrasp " + ProgramVersion() + " (" + ProgramCommit() + ")"};
  std::vector<std::string> held;
  std::string line;
  const auto end_line = [&] {
    if (!line.empty()) same.push_back(line);
    line.clear();
  };
  for (std::size_t i = 1; i < words.size(); ++i) {
    const std::string option = words[i].substr(0, words[i].find('='));
    if (IsOption(option)) end_line();
    if (IsOfOneRank(option)) {
      i += option == words[i] ? 1 : 0;
      continue;
    }
    line += (line.empty() ? "" : " ") + words[i];
    const std::string what = i > 1 ? Held(words[i]) : "";  // not of the command's name
    if (!what.empty()) held.push_back(words[i] + ": " + what);
  }
  end_line();
  same.insert(same.end(), held.begin(), held.end());
  return same;
}

void RunShared(int processes, const std::function<void()>& pause, const SharedRun& run) {
  const std::unique_ptr<Ranks> ranks = JoinRanks(
      processes, [] { return SameCall(OwnArguments()); }, pause);
  if (ranks == nullptr) return run(nullptr);
  {
    RankedShare share(&ranks->group());
    try {
      run(&share);
    } catch (const WorkOver&) {
    } catch (...) {
      share.LeaveWith(std::current_exception());
    }
  }
  if (ranks->group().leads()) SayOfRank(ranks->group().SentText());
}

}  // namespace antigrasp
