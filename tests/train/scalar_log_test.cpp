#include "antigrasp/train/scalar_log.h"

#include <gtest/gtest.h>

#include <cmath>

#include "antigrasp/core/atomic_file.h"
#include "antigrasp/core/error.h"
#include "tests/support/temp_folder.h"

namespace antigrasp {
namespace {

using shapes::TempFolder;

TEST(ScalarLog, ComesBackAsItWasWritten) {
  const TempFolder folder;
  const auto path = folder / "events.out.tfevents.1.test";
  ScalarLog log(path, 0);
  log.Add(10, {{"loss/generator", -0.25}, {"loss/discriminator", 1.5}});
  log.Add(1234567890123, {{"kappa", 0.8}, {"left out", std::nan("")}});
  const auto events = ReadScalarEvents(path);
  ASSERT_EQ(events.size(), 3u);
  EXPECT_EQ(events[0].tag, "loss/generator");
  EXPECT_EQ(events[0].value, -0.25F);
  EXPECT_EQ(events[0].step, 10);
  EXPECT_EQ(events[1].tag, "loss/discriminator");
  EXPECT_EQ(events[2].step, 1234567890123);
  EXPECT_EQ(events[2].value, 0.8F);
  EXPECT_GT(events[2].wall_time, 1.7e9);  // after 2023
}

TEST(ScalarLog, FramesAreTensorBoardsByteForByte) {
  // The first record but for its time, as TensorFlow writes it: every event file begins with the
  // length 24 and its masked CRC-32C, a3 7f 4b 22.
  const TempFolder folder;
  const auto path = folder / "events";
  const ScalarLog log(path, 0);
  const std::string bytes = ReadFile(path);
  ASSERT_EQ(bytes.size(), 8u + 4 + 24 + 4);
  EXPECT_EQ(bytes.substr(0, 12), std::string("\x18\0\0\0\0\0\0\0\xa3\x7f\x4b\x22", 12));
  EXPECT_EQ(bytes[12], '\x09');
  EXPECT_EQ(bytes.substr(21, 15),
            "\x1a\x0d"
            "brain.Event:2");
}

TEST(ScalarLog, EventsAreTensorBoardsByteForByte) {
  // Event: wall_time (field 1, 64 bit), step (2, varint: 300 = ac 02), summary (5) of a value (1)
  // with tag (1) and simple_value (2, float: 1.5 = 3fc00000).
  const TempFolder folder;
  const auto path = folder / "events";
  ScalarLog log(path, 0);
  const std::size_t before = ReadFile(path).size();
  log.Add(300, {{"ab", 1.5}});
  const std::string record = ReadFile(path).substr(before);
  const std::string body(
      "\x10\xac\x02\x2a\x0b\x0a\x09\x0a\x02"
      "ab\x15\0\0\xc0\x3f",
      16);
  ASSERT_EQ(record.size(), 8U + 4 + 9 + body.size() + 4);
  EXPECT_EQ(record.substr(0, 8), std::string("\x19\0\0\0\0\0\0\0", 8));
  EXPECT_EQ(record[12], '\x09');
  EXPECT_EQ(record.substr(12 + 9, body.size()), body);
}

TEST(ScalarLog, DropsWhatCameAfterTheStateItGoesOnFromAndATornRecord) {
  const TempFolder folder;
  const auto path = folder / "events";
  {
    ScalarLog log(path, 0);
    for (const int step : {10, 20, 30}) log.Add(step, {{"a", step}});
  }
  const std::string whole = ReadFile(path);
  WriteFileAtomic(path, whole.substr(0, whole.size() - 3));
  EXPECT_THROW(ReadScalarEvents(path), InputError);
  ScalarLog(path, 30).Add(40, {{"a", 40}});
  auto events = ReadScalarEvents(path);
  ASSERT_EQ(events.size(), 3u);  // 10, 20 and 40: 30 was torn
  EXPECT_EQ(events[2].step, 40);
  ScalarLog(path, 15).Add(16, {{"a", 16}});
  events = ReadScalarEvents(path);
  ASSERT_EQ(events.size(), 2u);
  EXPECT_EQ(events[0].step, 10);
  EXPECT_EQ(events[1].step, 16);
}

TEST(ScalarLog, ADamagedByteIsFound) {
  const TempFolder folder;
  const auto path = folder / "events";
  ScalarLog(path, 0).Add(1, {{"a", 1.0}});
  const std::string whole = ReadFile(path);
  for (std::size_t i = 0; i < whole.size(); ++i) {
    std::string damaged = whole;
    damaged[i] = static_cast<char>(damaged[i] ^ 1);
    WriteFileAtomic(path, damaged);
    EXPECT_THROW(ReadScalarEvents(path), InputError) << i;
  }
  EXPECT_THROW(ScalarLog(folder / "none/events", 0), InputError);
}

}  // namespace
}  // namespace antigrasp
