#pragma once

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace antigrasp {

// How often each word came, in the order in which they came up first: "10 ok, 2 late".
class WordCount {
 public:
  void Add(const std::string& word) {
    const auto known = Find(word);
    if (known != counts_.end()) {
      ++known->second;
    } else {
      counts_.emplace_back(word, 1);
    }
    ++total_;
  }
  int Of(const std::string& word) const {
    const auto known = std::find_if(counts_.begin(), counts_.end(),
                                    [&](const auto& one) { return one.first == word; });
    return known != counts_.end() ? known->second : 0;
  }
  int total() const { return total_; }
  std::string Text() const {
    std::string text;
    for (const auto& [word, count] : counts_) {
      text += (text.empty() ? "" : ", ") + std::to_string(count) + " " + word;
    }
    return text;
  }

 private:
  std::vector<std::pair<std::string, int>>::iterator Find(const std::string& word) {
    return std::find_if(counts_.begin(), counts_.end(),
                        [&](const auto& one) { return one.first == word; });
  }

  std::vector<std::pair<std::string, int>> counts_;
  int total_ = 0;
};

}  // namespace antigrasp
