#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

namespace antigrasp {

// Philox4x32-10 (Salmon et al., "Parallel random numbers: as easy as 1, 2, 3", SC 2011): maps a
// 128-bit counter and a 64-bit key to 128 random bits. Stateless, so a stream can start anywhere.
std::array<std::uint32_t, 4> Philox(std::array<std::uint32_t, 4> counter,
                                    std::array<std::uint32_t, 2> key);

// FNV-1a of 64 bits over the bytes: the same on every machine. Saved results depend on it.
std::uint64_t HashOf(std::string_view text);

// The random stream of one work item. Two streams with different (seed, domain, a, b) are
// independent; the same four give the same numbers on every machine and thread.
//   RngStream rng(seed, "grasp", episode, object);
class RngStream {
 public:
  RngStream(std::uint64_t seed, std::string_view domain, std::uint64_t a = 0, std::uint64_t b = 0);

  std::uint32_t NextU32();
  std::uint64_t NextU64();
  double Uniform();                         // [0, 1), 53 bits
  double Uniform(double low, double high);  // [low, high)
  double Normal();                          // mean 0, standard deviation 1 (Box-Muller)
  // As many calls of Normal: the same numbers, in less than half the time.
  void Normals(std::span<double> out);
  std::uint64_t Below(std::uint64_t n);  // {0, ..., n-1} without bias; n > 0

 private:
  std::array<std::uint32_t, 2> key_;
  std::array<std::uint32_t, 4> counter_;
  std::array<std::uint32_t, 4> block_{};
  int used_ = 4;
  bool has_normal_ = false;
  double normal_ = 0.0;
};

}  // namespace antigrasp
