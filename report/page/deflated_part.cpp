#include "antigrasp/report/page/deflated_part.h"

#include <zlib.h>

#include <limits>

#include "antigrasp/core/check.h"

namespace antigrasp {

DeflatedPart Deflated(std::string_view bytes) {
  if (bytes.empty()) return {};
  AG_CHECK(bytes.size() < std::numeric_limits<uInt>::max() / 2, "a part of a report is below 2 GB");
  constexpr int kRaw = -15;  // no header, no check sum; a window of 32 KiB
  constexpr int kMemory = 9;
  z_stream state{};
  AG_CHECK(deflateInit2(&state, Z_BEST_COMPRESSION, Z_DEFLATED, kRaw, kMemory,
                        Z_DEFAULT_STRATEGY) == Z_OK,
           "zlib has memory for a stream");
  DeflatedPart part{std::string(deflateBound(&state, bytes.size()), '\0'), bytes.size()};
  state.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));  // zlib only reads it
  state.avail_in = static_cast<uInt>(bytes.size());
  state.next_out = reinterpret_cast<Bytef*>(part.stream.data());
  state.avail_out = static_cast<uInt>(part.stream.size());
  const int status = deflate(&state, Z_FINISH);
  part.stream.resize(state.total_out);
  deflateEnd(&state);
  AG_CHECK(status == Z_STREAM_END, "a stream fits into its bound");
  return part;
}

}  // namespace antigrasp
