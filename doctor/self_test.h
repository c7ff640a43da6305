#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "antigrasp/core/observer.h"

namespace antigrasp {

// A piece of work on two small objects, and a hash of the bytes that came of it: FNV-1a of 64 bits
// over the numbers as they lie in memory.
struct SelfTestStep {
  std::string name;
  std::uint64_t found = 0;
  // The same on every x86-64 with AVX2, for any number of threads. None is known where the library
  // that does the work is of another version.
  std::optional<std::uint64_t> expected;
  bool ok() const { return !expected || *expected == found; }
};

// Two cylinders of seed 1 are made ("made"), remeshed ("remeshed"), scored by the default metric
// ("scored"), perturbed at random ("perturbed") and, where physics is built, tried on ten grasps
// ("tried"). A second or two.
std::vector<SelfTestStep> RunSelfTest(int threads, RunObserver* observer);

bool AllOk(const std::vector<SelfTestStep>& steps);
// "made, remeshed, scored, perturbed, tried: the expected bytes"; what differs comes first, with
// both hashes, what has no known bytes last.
std::string SelfTestText(const std::vector<SelfTestStep>& steps);

// What is hashed.
class HashedBytes {
 public:
  template <typename T>
  void Add(const T* values, std::size_t count) {
    text_.append(reinterpret_cast<const char*>(values), count * sizeof(T));
  }
  template <typename T>
  void Add(const std::vector<T>& values) {
    Add(values.data(), values.size());
  }
  std::uint64_t Hash() const;

 private:
  std::string text_;
};

}  // namespace antigrasp
