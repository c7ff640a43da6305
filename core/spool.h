#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>

#include "antigrasp/core/atomic_file.h"

namespace antigrasp {

// Bytes set aside on disk for a later step of the same work, in a hidden file beside the one that
// is to be written. It goes when this object goes.
class Spool {
 public:
  explicit Spool(const std::filesystem::path& beside);
  ~Spool();
  // The place of the bytes, to read them by. One thread at a time. RuntimeFailure when the disk is
  // full.
  std::uint64_t Append(const void* bytes, std::size_t size);
  void Read(std::uint64_t place, void* bytes, std::size_t size) const;  // any thread

 private:
  AtomicFile file_;  // never committed
  std::uint64_t size_ = 0;
  int reading_ = -1;
};

}  // namespace antigrasp
