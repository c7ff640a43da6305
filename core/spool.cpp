#include "antigrasp/core/spool.h"

#include <fcntl.h>
#include <unistd.h>

#include <string>
#include <string_view>

#include "antigrasp/core/error.h"

namespace antigrasp {

Spool::Spool(const std::filesystem::path& beside) : file_(beside.string() + ".spool") {
  file_.Append("");
  reading_ = ::open(file_.temp_path().c_str(), O_RDONLY | O_CLOEXEC);
  if (reading_ < 0) throw RuntimeFailure("cannot read " + file_.temp_path().string());
}

Spool::~Spool() { ::close(reading_); }

std::uint64_t Spool::Append(const void* bytes, std::size_t size) {
  const std::uint64_t place = size_;
  file_.Append(std::string_view(static_cast<const char*>(bytes), size));
  size_ += size;
  return place;
}

void Spool::Read(std::uint64_t place, void* bytes, std::size_t size) const {
  for (std::size_t done = 0; done < size;) {
    const ssize_t count = ::pread(reading_, static_cast<char*>(bytes) + done, size - done,
                                  static_cast<off_t>(place + done));
    if (count <= 0) throw RuntimeFailure("cannot read " + file_.temp_path().string());
    done += static_cast<std::size_t>(count);
  }
}

}  // namespace antigrasp
