#include <algorithm>
#include <bit>
#include <cstring>

#include "antigrasp/core/error.h"
#include "antigrasp/mesh/mesh_readers.h"
#include "antigrasp/mesh/text_scanner.h"

namespace antigrasp {
namespace {

static_assert(std::endian::native == std::endian::little, "binary STL is little endian");

constexpr std::size_t kHeaderBytes = 84;  // 80 of text and the number of faces
constexpr std::size_t kFaceBytes = 50;    // normal, three corners, two bytes of attributes
constexpr std::size_t kNormalBytes = 12;

bool IsWord(std::string_view word, std::string_view lower_case) {
  return std::equal(word.begin(), word.end(), lower_case.begin(), lower_case.end(),
                    [](char a, char b) { return (a >= 'A' && a <= 'Z' ? a + 32 : a) == b; });
}

std::size_t ClaimedFaces(std::string_view bytes) {
  std::uint32_t faces = 0;
  std::memcpy(&faces, bytes.data() + kHeaderBytes - sizeof(faces), sizeof(faces));
  return faces;
}

PolygonSoup ReadBinary(std::string_view bytes, std::size_t faces) {
  PolygonSoup soup;
  const std::size_t end = kHeaderBytes + kFaceBytes * faces;
  for (std::size_t at = kHeaderBytes; at < end; at += kFaceBytes) {
    float corners[9];
    std::memcpy(corners, bytes.data() + at + kNormalBytes, sizeof(corners));
    for (int k = 0; k < 3; ++k) {
      soup.corners.push_back(static_cast<std::int64_t>(soup.vertices.size()));
      soup.vertices.emplace_back(corners[3 * k], corners[3 * k + 1], corners[3 * k + 2]);
    }
    soup.EndPolygon();
  }
  return soup;
}

// A file whose size is not that of its face count. Some writers never go back to put the count in,
// some append data of their own; a file that could also hold other faces than it counts is refused.
PolygonSoup ReadMiscounted(std::string_view bytes, const std::string& path) {
  const std::size_t claimed = ClaimedFaces(bytes);
  const std::size_t held = (bytes.size() - kHeaderBytes) / kFaceBytes;
  const bool whole_faces = (bytes.size() - kHeaderBytes) % kFaceBytes == 0;
  if (claimed == 0 && whole_faces) {
    PolygonSoup soup = ReadBinary(bytes, held);
    soup.notes.push_back("the file counts 0 faces: " + std::to_string(held) + " read by its size");
    return soup;
  }
  if (held < claimed || whole_faces || claimed == 0) {
    throw InputError(std::string(held < claimed ? "truncated binary STL, or a wrong count: "
                                                : "binary STL with a wrong count: ") +
                         std::to_string(held) + " faces by its " + std::to_string(bytes.size()) +
                         " bytes, " + std::to_string(claimed) + " by its face count",
                     path,
                     std::to_string(kHeaderBytes + kFaceBytes * claimed) + " bytes for that count");
  }
  return ReadBinary(bytes, claimed);
}

std::string_view RequireWord(TextScanner* text, const char* expected) {
  const auto word = text->NextWord();
  if (!word) text->Fail("file ends early", std::string("'") + expected + "'");
  return *word;
}

void SkipTo(TextScanner* text, const char* expected) {
  while (!IsWord(RequireWord(text, expected), expected)) {
  }
}

// From after "facet" to "endfacet". The normal is skipped: it says nothing the corners do not.
void ReadFacet(TextScanner* text, PolygonSoup* soup) {
  SkipTo(text, "loop");
  for (;;) {
    const std::string_view word = RequireWord(text, "endloop");
    if (IsWord(word, "endloop")) break;
    if (!IsWord(word, "vertex")) text->Fail(Quoted(word), "'vertex' or 'endloop'");
    Eigen::Vector3d v;
    for (int k = 0; k < 3; ++k) v[k] = text->NextNumber("a vertex coordinate");
    soup->corners.push_back(static_cast<std::int64_t>(soup->vertices.size()));
    soup->vertices.push_back(v);
  }
  const std::string_view word = RequireWord(text, "endfacet");
  if (!IsWord(word, "endfacet")) text->Fail(Quoted(word), "'endfacet'");
  soup->EndPolygon();
}

// Any number of solids. The rest of a "solid" or "endsolid" line is a name, whatever it says.
PolygonSoup ReadAscii(std::string_view bytes, const std::string& path) {
  TextScanner text(bytes, path);
  PolygonSoup soup;
  bool in_solid = false;
  while (const auto word = text.NextWord()) {
    if (!in_solid && IsWord(*word, "solid")) {
      in_solid = true;
      text.NextLine();
    } else if (in_solid && IsWord(*word, "endsolid")) {
      in_solid = false;
      text.NextLine();
    } else if (in_solid && IsWord(*word, "facet")) {
      ReadFacet(&text, &soup);
    } else {
      text.Fail(Quoted(*word), in_solid ? "'facet' or 'endsolid'" : "'solid' (ASCII STL)");
    }
  }
  if (in_solid) text.Fail("file ends early", "'endsolid'");
  return soup;
}

}  // namespace

PolygonSoup ReadStl(std::string_view bytes, const std::string& path) {
  // Many binary files begin with "solid" too, so the exact size decides first, and then a zero
  // byte, which no text has.
  const bool has_header = bytes.size() >= kHeaderBytes;
  if (has_header && bytes.size() == kHeaderBytes + kFaceBytes * ClaimedFaces(bytes)) {
    return ReadBinary(bytes, ClaimedFaces(bytes));
  }
  const bool text = bytes.substr(0, kHeaderBytes).find('\0') == std::string_view::npos;
  std::string_view start = bytes;
  if (text && IsWord(TakeWord(&start), "solid")) return ReadAscii(bytes, path);
  if (!has_header) {
    throw InputError("neither ASCII nor binary STL: " + std::to_string(bytes.size()) + " bytes",
                     path, "'solid' or a binary header of 84 bytes");
  }
  return ReadMiscounted(bytes, path);
}

}  // namespace antigrasp
