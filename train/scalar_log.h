#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace antigrasp {

struct ScalarEvent {
  double wall_time = 0.0;  // seconds since 1970
  std::int64_t step = 0;
  std::string tag;  // "loss/generator"
  float value = 0.0F;
};

// Scalars in a file that TensorBoard reads: TFRecord frames (length, data, masked CRC-32C of both)
// around Event messages (tensorflow/core/util/event.proto, protocol buffers by hand). Appended to
// as the run goes, because TensorBoard follows a file by its name and length.
class ScalarLog {
 public:
  // Begins the file or goes on with it: what a run wrote after `last_step`, before it was resumed
  // from there, is dropped, and so is a record that a crash left half-written. InputError when the
  // folder is not there.
  ScalarLog(std::filesystem::path path, std::int64_t last_step);

  // One event; values that are not finite are left out.
  void Add(std::int64_t step, const std::vector<std::pair<std::string, double>>& values);

 private:
  std::filesystem::path path_;
};

// Every scalar of the file. InputError for a frame whose check sum is wrong or that is cut short.
std::vector<ScalarEvent> ReadScalarEvents(const std::filesystem::path& path);

}  // namespace antigrasp
