#include "antigrasp/train/scalar_log.h"

#include <boost/crc.hpp>
#include <chrono>
#include <cmath>
#include <cstring>
#include <fstream>
#include <optional>
#include <string_view>

#include "antigrasp/core/atomic_file.h"
#include "antigrasp/core/error.h"

namespace antigrasp {
namespace {

// Fields of the messages: number << 3 | wire type.
constexpr char kWallTime = 0x09;     // Event 1, 64 bit
constexpr char kStep = 0x10;         // Event 2, varint
constexpr char kFileVersion = 0x1a;  // Event 3, bytes
constexpr char kSummary = 0x2a;      // Event 5, bytes
constexpr char kValue = 0x0a;        // Summary 1, bytes
constexpr char kTag = 0x0a;          // Summary.Value 1, bytes
constexpr char kSimpleValue = 0x15;  // Summary.Value 2, 32 bit

constexpr std::size_t kLengthSize = 8, kCrcSize = 4;

std::uint32_t MaskedCrc(std::string_view bytes) {
  boost::crc_optimal<32, 0x1EDC6F41, 0xFFFFFFFF, 0xFFFFFFFF, true, true> crc;  // Castagnoli
  crc.process_bytes(bytes.data(), bytes.size());
  const std::uint32_t sum = crc.checksum();
  return ((sum >> 15) | (sum << 17)) + 0xa282ead8U;
}

template <typename T>
std::string Raw(T value) {  // little endian, as every machine that LibTorch runs on
  std::string bytes(sizeof value, '\0');
  std::memcpy(bytes.data(), &value, sizeof value);
  return bytes;
}

template <typename T>
T FromRaw(std::string_view bytes) {
  T value;
  std::memcpy(&value, bytes.data(), sizeof value);
  return value;
}

std::string Varint(std::uint64_t value) {
  std::string bytes;
  for (; value >= 128; value >>= 7) bytes += static_cast<char>(value | 128);
  return bytes + static_cast<char>(value);
}

std::string Bytes(char field, const std::string& content) {
  return field + Varint(content.size()) + content;
}

std::string Frame(const std::string& data) {
  const std::string length = Raw<std::uint64_t>(data.size());
  return length + Raw(MaskedCrc(length)) + data + Raw(MaskedCrc(data));
}

std::string EventHead(std::int64_t step) {
  const std::chrono::duration<double> now = std::chrono::system_clock::now().time_since_epoch();
  std::string head = kWallTime + Raw(now.count());
  if (step != 0) head += kStep + Varint(static_cast<std::uint64_t>(step));  // 0 goes without saying
  return head;
}

// Takes a message apart field by field.
class Message {
 public:
  explicit Message(std::string_view bytes) : rest_(bytes) {}

  // The next field's key; nothing at the end. The content is in bytes() or number().
  std::optional<char> Next() {
    if (rest_.empty()) return std::nullopt;
    const char key = rest_[0];
    rest_.remove_prefix(1);
    switch (key & 7) {
      case 0:
        number_ = TakeVarint();
        break;
      case 1:
        bytes_ = Take(8);
        break;
      case 2:
        bytes_ = Take(TakeVarint());
        break;
      case 5:
        bytes_ = Take(4);
        break;
      default:
        throw InputError("unknown field", "event", "an event of TensorBoard");
    }
    return key;
  }
  std::string_view bytes() const { return bytes_; }
  std::uint64_t number() const { return number_; }

 private:
  std::string_view Take(std::uint64_t size) {
    if (size > rest_.size()) throw InputError("cut short", "event", "an event of TensorBoard");
    const std::string_view taken = rest_.substr(0, size);
    rest_.remove_prefix(size);
    return taken;
  }
  std::uint64_t TakeVarint() {
    std::uint64_t value = 0;
    for (int shift = 0; shift < 64; shift += 7) {
      const auto byte = static_cast<unsigned char>(Take(1)[0]);
      value |= static_cast<std::uint64_t>(byte & 127) << shift;
      if (byte < 128) break;
    }
    return value;
  }

  std::string_view rest_, bytes_;
  std::uint64_t number_ = 0;
};

void AppendValue(std::string_view bytes, ScalarEvent event, std::vector<ScalarEvent>* events) {
  Message value(bytes);
  while (const auto key = value.Next()) {
    if (*key == kTag) event.tag = value.bytes();
    if (*key == kSimpleValue) event.value = FromRaw<float>(value.bytes());
  }
  events->push_back(event);
}

std::vector<ScalarEvent> ScalarsOf(std::string_view data) {
  std::vector<ScalarEvent> events;
  ScalarEvent head;
  Message message(data);
  while (const auto key = message.Next()) {
    if (*key == kWallTime) head.wall_time = FromRaw<double>(message.bytes());
    if (*key == kStep) head.step = static_cast<std::int64_t>(message.number());
    if (*key != kSummary) continue;
    Message summary(message.bytes());
    while (summary.Next() == kValue) AppendValue(summary.bytes(), head, &events);
  }
  return events;
}

// The data of the frame at the front of `bytes`, and `bytes` without the frame; nothing, and
// `bytes` as they were, when the frame is damaged or cut short.
std::optional<std::string_view> TakeFrame(std::string_view* bytes) {
  constexpr std::size_t kFrame = kLengthSize + 2 * kCrcSize;
  if (bytes->size() < kFrame) return std::nullopt;
  const std::string_view length = bytes->substr(0, kLengthSize);
  const auto size = FromRaw<std::uint64_t>(length);
  if (FromRaw<std::uint32_t>(bytes->substr(kLengthSize)) != MaskedCrc(length)) return std::nullopt;
  if (size > bytes->size() - kFrame) return std::nullopt;
  const std::string_view data = bytes->substr(kLengthSize + kCrcSize, size);
  if (FromRaw<std::uint32_t>(bytes->substr(kLengthSize + kCrcSize + size)) != MaskedCrc(data)) {
    return std::nullopt;
  }
  bytes->remove_prefix(kFrame + size);
  return data;
}

}  // namespace

ScalarLog::ScalarLog(std::filesystem::path path, std::int64_t last_step) : path_(std::move(path)) {
  std::string kept;
  if (std::filesystem::exists(path_)) {
    const std::string old = ReadFile(path_);
    std::string_view rest = old;
    while (const auto data = TakeFrame(&rest)) {
      const std::vector<ScalarEvent> events = ScalarsOf(*data);
      if (events.empty() || events[0].step <= last_step) kept += Frame(std::string(*data));
    }
  }
  if (kept.empty()) kept = Frame(EventHead(0) + Bytes(kFileVersion, "brain.Event:2"));
  WriteFileAtomic(path_, kept);
}

void ScalarLog::Add(std::int64_t step, const std::vector<std::pair<std::string, double>>& values) {
  std::string summary;
  for (const auto& [tag, value] : values) {
    if (!std::isfinite(value)) continue;
    summary += Bytes(kValue, Bytes(kTag, tag) + kSimpleValue + Raw(static_cast<float>(value)));
  }
  std::ofstream file(path_, std::ios::binary | std::ios::app);
  file << Frame(EventHead(step) + Bytes(kSummary, summary));
  file.flush();
  if (!file) throw RuntimeFailure("cannot write " + path_.string());
}

std::vector<ScalarEvent> ReadScalarEvents(const std::filesystem::path& path) {
  const std::string bytes = ReadFile(path);
  std::string_view rest = bytes;
  std::vector<ScalarEvent> events;
  while (!rest.empty()) {
    const auto data = TakeFrame(&rest);
    if (!data) {
      throw InputError("damaged record at byte " + std::to_string(bytes.size() - rest.size()),
                       path.string(), "an event file of TensorBoard");
    }
    for (const ScalarEvent& event : ScalarsOf(*data)) events.push_back(event);
  }
  return events;
}

}  // namespace antigrasp
