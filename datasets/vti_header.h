#pragma once

#include <array>
#include <cstdint>
#include <fstream>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "antigrasp/datasets/vti_bytes.h"

namespace antigrasp {

struct VtiArray {
  std::string name;
  std::size_t float_size = 4;  // bytes of a value
  std::string format;          // "appended", "binary" or "ascii"
  std::uint64_t offset = 0;    // of what is appended
};

// What the XML of VTK image data says.
struct VtiHeader {
  VtiPacking packing;
  int n = 0;  // nodes a side
  double spacing = 0.0;
  std::array<double, 3> origin{};           // of the first node
  std::map<std::string, std::string> says;  // texts and numbers of the field data
  std::vector<VtiArray> arrays;             // scalars of float32 or float64 at the points
  std::uint64_t appended_at = 0;            // place of the appended bytes in the file
  bool appended_base64 = false;
};

// `inline_text`: called with an array that stands in the XML, and its text. InputError, naming
// `path`, for what is no cube of points with such scalars, several pieces, turned axes, big-endian
// numbers and packing that is not zlib's.
VtiHeader ReadVtiHeader(std::ifstream* file, const std::string& path,
                        const std::function<void(const VtiHeader& header, const VtiArray& array,
                                                 const std::string& text)>& inline_text);

}  // namespace antigrasp
