#include "antigrasp/core/bytes.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace antigrasp {
namespace {

std::string Some() {
  ByteWriter bytes;
  bytes.Put(std::int16_t{-3});
  bytes.PutAll(std::vector<float>{1.5F, -2.0F});
  bytes.PutText(std::string("a\0b", 3));
  return bytes.Take();
}

TEST(Bytes, ComeBackInOrder) {
  const std::string bytes = Some();
  EXPECT_EQ(bytes.size(), 2U + (8U + 8U) + (8U + 3U));
  ByteReader reader(bytes);
  EXPECT_EQ(reader.Get<std::int16_t>(), -3);
  EXPECT_EQ(reader.GetAll<float>(), (std::vector<float>{1.5F, -2.0F}));
  EXPECT_EQ(reader.GetText(), std::string("a\0b", 3));
  reader.End();
}

TEST(Bytes, ThatEndEarlyOrLateAreRefused) {
  const std::string bytes = Some();
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    ByteReader reader(std::string_view(bytes).substr(0, size));
    EXPECT_THROW(
        {
          reader.Get<std::int16_t>();
          reader.GetAll<float>();
          reader.GetText();
        },
        RuntimeFailure)
        << size;
  }
  ByteReader reader(bytes);
  reader.Get<std::int16_t>();
  EXPECT_THROW(reader.End(), RuntimeFailure);
}

TEST(Bytes, AFalseLengthTakesNoMemory) {
  ByteWriter bytes;
  bytes.Put(~std::uint64_t{0});
  const std::string text = bytes.Take();
  EXPECT_THROW(ByteReader(text).GetAll<double>(), RuntimeFailure);
  EXPECT_THROW(ByteReader(text).GetText(), RuntimeFailure);
}

}  // namespace
}  // namespace antigrasp
