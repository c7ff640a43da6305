#pragma once

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

namespace antigrasp::bench {

inline double Seconds(const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// One way of doing a job: `work` does it `repeats` times.
struct Contender {
  std::string name;
  std::function<void()> work;
  double repeats = 1.0;
};

// Median seconds per repeat of each contender. The rounds take turns, so that a slow spell of a
// shared machine meets all of them.
inline std::vector<double> MedianSeconds(const std::vector<Contender>& contenders, int rounds) {
  std::vector<std::vector<double>> seconds(contenders.size());
  for (int round = 0; round < rounds; ++round) {
    for (std::size_t i = 0; i < contenders.size(); ++i) {
      seconds[i].push_back(Seconds(contenders[i].work) / contenders[i].repeats);
    }
  }
  std::vector<double> medians;
  for (auto& of_one : seconds) {
    std::nth_element(of_one.begin(), of_one.begin() + rounds / 2, of_one.end());
    medians.push_back(of_one[static_cast<std::size_t>(rounds / 2)]);
  }
  return medians;
}

// One line a comparison; above 1 = better than the peer or the simple way.
inline void PrintRatio(const std::string& name, double value) {
  std::printf("ratio %s %.3g\n", name.c_str(), value);
  std::fflush(stdout);
}

// What a ratio was made of.
inline void PrintTime(const std::string& name, double seconds) {
  std::printf("time %s %.3g us\n", name.c_str(), 1e6 * seconds);
  std::fflush(stdout);
}

}  // namespace antigrasp::bench
