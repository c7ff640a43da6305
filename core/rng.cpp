#include "antigrasp/core/rng.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "antigrasp/core/check.h"
#include "antigrasp/core/normal_pairs.h"

namespace antigrasp {
namespace {

// splitmix64's finaliser (Steele et al. 2014): a bijection whose output bits all depend on all
// input bits.
std::uint64_t Mix(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15ULL;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
  return x ^ (x >> 31);
}

}  // namespace

std::uint64_t HashOf(std::string_view text) {
  std::uint64_t hash = 0xcbf29ce484222325ULL;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3ULL;
  return hash;
}

std::array<std::uint32_t, 4> Philox(std::array<std::uint32_t, 4> counter,
                                    std::array<std::uint32_t, 2> key) {
  constexpr std::uint64_t kM0 = 0xD2511F53, kM1 = 0xCD9E8D57;
  for (int round = 0; round < 10; ++round) {
    const std::uint64_t p0 = kM0 * counter[0];
    const std::uint64_t p1 = kM1 * counter[2];
    counter = {
        static_cast<std::uint32_t>(p1 >> 32) ^ counter[1] ^ key[0], static_cast<std::uint32_t>(p1),
        static_cast<std::uint32_t>(p0 >> 32) ^ counter[3] ^ key[1], static_cast<std::uint32_t>(p0)};
    key[0] += 0x9E3779B9;
    key[1] += 0xBB67AE85;
  }
  return counter;
}

RngStream::RngStream(std::uint64_t seed, std::string_view domain, std::uint64_t a,
                     std::uint64_t b) {
  const std::uint64_t key = Mix(Mix(seed) ^ HashOf(domain));
  const std::uint64_t item = Mix(Mix(a) + b) ^ Mix(key + a);
  key_ = {static_cast<std::uint32_t>(key), static_cast<std::uint32_t>(key >> 32)};
  // The low half of the counter counts blocks, the high half names the work item.
  counter_ = {0, 0, static_cast<std::uint32_t>(item), static_cast<std::uint32_t>(item >> 32)};
}

std::uint32_t RngStream::NextU32() {
  if (used_ == 4) {
    block_ = Philox(counter_, key_);
    if (++counter_[0] == 0) ++counter_[1];
    used_ = 0;
  }
  return block_[static_cast<std::size_t>(used_++)];
}

std::uint64_t RngStream::NextU64() {
  const std::uint64_t low = NextU32();
  return low | (static_cast<std::uint64_t>(NextU32()) << 32);
}

double RngStream::Uniform() { return static_cast<double>(NextU64() >> 11) * 0x1.0p-53; }

double RngStream::Uniform(double low, double high) { return low + (high - low) * Uniform(); }

double RngStream::Normal() {
  if (has_normal_) {
    has_normal_ = false;
    return normal_;
  }
  const double radius = std::sqrt(-2.0 * std::log(1.0 - Uniform()));
  const double angle = 2.0 * std::numbers::pi * Uniform();
  normal_ = radius * std::sin(angle);
  has_normal_ = true;
  return radius * std::cos(angle);
}

void RngStream::Normals(std::span<double> out) {
  std::size_t done = 0;
  if (has_normal_ && !out.empty()) out[done++] = Normal();
  while (used_ == 4 && out.size() - done >= 2) {
    constexpr std::size_t kPairs = 64;
    const std::size_t pairs = std::min(kPairs, (out.size() - done) / 2);
    double uniform[2 * kPairs];
    PhiloxUniforms(counter_, key_, static_cast<int>(pairs), uniform);
    BoxMuller(uniform, static_cast<int>(pairs), &out[done]);
    const std::uint64_t next =
        (counter_[0] | static_cast<std::uint64_t>(counter_[1]) << 32) + pairs;
    counter_[0] = static_cast<std::uint32_t>(next);
    counter_[1] = static_cast<std::uint32_t>(next >> 32);
    done += 2 * pairs;
  }
  while (done < out.size()) out[done++] = Normal();
}

std::uint64_t RngStream::Below(std::uint64_t n) {
  AG_CHECK(n > 0, "Below needs a positive bound");
  // Values under 2^64 mod n would make the small remainders likelier.
  const std::uint64_t biased = (0 - n) % n;
  std::uint64_t value = NextU64();
  while (value < biased) value = NextU64();
  return value % n;
}

}  // namespace antigrasp
