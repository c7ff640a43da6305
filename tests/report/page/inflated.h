#pragma once

#include <gtest/gtest.h>
#include <zlib.h>

#include <string>

namespace antigrasp {

// The `size` bytes of a whole raw stream of RFC 1951, by zlib: no fewer, and no more.
inline std::string Inflated(std::string stream, std::size_t size) {
  std::string bytes(size + 1, '\0');
  z_stream state{};
  EXPECT_EQ(inflateInit2(&state, -15), Z_OK);
  state.next_in = reinterpret_cast<Bytef*>(stream.data());
  state.avail_in = static_cast<uInt>(stream.size());
  state.next_out = reinterpret_cast<Bytef*>(bytes.data());
  state.avail_out = static_cast<uInt>(bytes.size());
  EXPECT_EQ(inflate(&state, Z_FINISH), Z_STREAM_END);
  EXPECT_EQ(state.avail_in, 0u);
  EXPECT_EQ(state.total_out, size);
  inflateEnd(&state);
  bytes.resize(size);
  return bytes;
}

}  // namespace antigrasp
