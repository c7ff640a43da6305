#pragma once

#include <string>
#include <string_view>

namespace antigrasp {

// Bytes as the blob of a report keeps them: a raw stream of RFC 1951, and how many bytes it
// becomes.
struct DeflatedPart {
  std::string stream;  // empty for no bytes
  std::size_t size = 0;
};

// zlib's densest: some 20 MB/s. The same bytes for the same version of zlib.
DeflatedPart Deflated(std::string_view bytes);

}  // namespace antigrasp
