#include <assimp/scene.h>
#include <sys/resource.h>
#include <unistd.h>

#include <assimp/Importer.hpp>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <memory>

#include "antigrasp/core/error.h"
#include "antigrasp/core/format.h"
#include "antigrasp/core/throwaway_copy.h"
#include "antigrasp/mesh/mesh_readers.h"
#include "antigrasp/mesh/placed_soup.h"
#include "antigrasp/mesh/text_scanner.h"

// COLLADA by assimp, which damaged files can lead out of its buffers: only a copy of the process
// calls it, and hands on what it read.
namespace antigrasp {
namespace {

constexpr unsigned kMostSeconds = 60;
constexpr std::uint64_t kMostMemory = std::uint64_t{4} << 30;
constexpr const char* kWantedDae = "a COLLADA file (.dae) with meshes";

// A child's memory may grow by so much.
void BoundMemory() {
  std::ifstream statm("/proc/self/statm");
  std::uint64_t pages[6] = {};
  for (std::uint64_t& value : pages) statm >> value;
  const rlim_t most = pages[5] * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE)) + kMostMemory;
  const rlimit limit{most, most};
  ::setrlimit(RLIMIT_DATA, &limit);
}

Eigen::Affine3d PlaceOfNode(const aiMatrix4x4& m) {
  Eigen::Affine3d place;
  place.matrix() << static_cast<double>(m.a1), static_cast<double>(m.a2), static_cast<double>(m.a3),
      static_cast<double>(m.a4), static_cast<double>(m.b1), static_cast<double>(m.b2),
      static_cast<double>(m.b3), static_cast<double>(m.b4), static_cast<double>(m.c1),
      static_cast<double>(m.c2), static_cast<double>(m.c3), static_cast<double>(m.c4), 0.0, 0.0,
      0.0, 1.0;
  return place;
}

PolygonSoup SoupOf(const aiMesh& mesh) {
  PolygonSoup part;
  for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
    const aiVector3D& at = mesh.mVertices[i];
    part.vertices.emplace_back(static_cast<double>(at.x), static_cast<double>(at.y),
                               static_cast<double>(at.z));
  }
  for (unsigned i = 0; i < mesh.mNumFaces; ++i) {
    const aiFace& face = mesh.mFaces[i];
    if (face.mNumIndices < 3) continue;  // points and lines
    for (unsigned k = 0; k < face.mNumIndices; ++k) part.corners.push_back(face.mIndices[k]);
    part.EndPolygon();
  }
  return part;
}

// Every mesh where its nodes put it. The root is the scene: assimp multiplies it by the unit, and
// without that the coordinates are those of the file.
PolygonSoup SoupOf(const aiScene& scene, const std::string& path) {
  PolygonSoup soup;
  std::vector<std::pair<const aiNode*, Eigen::Affine3d>> open{
      {scene.mRootNode, Eigen::Affine3d::Identity()}};
  while (!open.empty()) {
    const auto [node, outer] = open.back();
    open.pop_back();
    const bool root = node == scene.mRootNode;
    const Eigen::Affine3d place = root ? outer : outer * PlaceOfNode(node->mTransformation);
    for (unsigned i = 0; i < node->mNumMeshes; ++i) {
      AppendPlaced(SoupOf(*scene.mMeshes[node->mMeshes[i]]), place, "a mesh", path, &soup);
    }
    for (unsigned i = node->mNumChildren; i-- > 0;) open.emplace_back(node->mChildren[i], place);
  }
  return soup;
}

// What the copy says: either a mesh or, without faces, why there is none.
struct DaeHead {
  std::uint64_t vertices = 0, corners = 0, faces = 0, text = 0;
  double metres = 1.0;  // a unit, in float32 at first
};

class DaePipe {
 public:
  DaePipe() : file_(std::tmpfile(), &std::fclose) {
    if (!file_) throw RuntimeFailure("cannot make a temporary file");
  }
  template <typename T>
  void Write(const T* values, std::size_t count) {
    std::fwrite(values, sizeof *values, count, file_.get());
  }
  template <typename T>
  bool Read(T* values, std::size_t count) {
    return std::fread(values, sizeof *values, count, file_.get()) == count;
  }
  void Flush() { std::fflush(file_.get()); }
  void Rewind() { std::rewind(file_.get()); }
  std::uint64_t Size() {
    std::fseek(file_.get(), 0, SEEK_END);
    return static_cast<std::uint64_t>(std::ftell(file_.get()));
  }

 private:
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_;
};

void ParseInto(std::string_view bytes, const std::string& path, DaePipe* pipe) {
  PolygonSoup soup;
  std::string why;
  double metres = 1.0;
  try {
    Assimp::Importer importer;
    importer.SetPropertyBool("IMPORT_COLLADA_IGNORE_UP_DIRECTION", true);
    importer.SetPropertyBool("IMPORT_NO_SKELETON_MESHES", true);  // made up of nodes alone
    const aiScene* const scene = importer.ReadFileFromMemory(bytes.data(), bytes.size(), 0, "dae");
    if (scene != nullptr && scene->mRootNode != nullptr) {
      soup = SoupOf(*scene, path);
      metres = static_cast<double>(scene->mRootNode->mTransformation.a1);
    }
    why = scene == nullptr ? importer.GetErrorString() : "no faces";
  } catch (const std::exception& error) {
    soup = {};
    why = error.what();
  }
  const DaeHead head{soup.vertices.size(), soup.corners.size(), soup.ends.size(), why.size(),
                     metres};
  pipe->Write(&head, 1);
  pipe->Write(soup.vertices.data(), soup.vertices.size());
  pipe->Write(soup.corners.data(), soup.corners.size());
  pipe->Write(soup.ends.data(), soup.ends.size());
  pipe->Write(why.data(), why.size());
  pipe->Flush();
}

// "cm" of 0.01; of no unit by name "0.3 m".
FileUnit UnitOf(double metres) {
  for (const Choice<LengthUnit>& unit : ChoicesOf(LengthUnit{})) {
    if (std::abs(metres / MetresPer(unit.value) - 1.0) < 1e-6) {
      return {std::string(unit.name), MetresPer(unit.value)};
    }
  }
  return {FormatDouble(metres) + " m", metres};
}

}  // namespace

PolygonSoup ReadDae(std::string_view bytes, const std::string& path) {
  if (bytes.substr(0, 4096).find("<COLLADA") == std::string_view::npos) {
    throw InputError("no COLLADA", path, kWantedDae);
  }
  DaePipe pipe;
  const bool returned = ReturnsInACopy(
      [&] {
        BoundMemory();
        ParseInto(bytes, path, &pipe);
      },
      kMostSeconds);
  const std::uint64_t size = pipe.Size();
  pipe.Rewind();
  DaeHead head;
  if (!returned || !pipe.Read(&head, 1)) {
    throw InputError("damaged COLLADA: assimp does not get through it", path, kWantedDae);
  }
  PolygonSoup soup;
  const std::uint64_t most = size / sizeof(std::uint64_t);
  if (head.vertices > most || head.corners > most || head.faces > most || head.text > size) {
    throw InputError("damaged COLLADA", path, kWantedDae);
  }
  soup.vertices.resize(head.vertices);
  soup.corners.resize(head.corners);
  soup.ends.resize(head.faces);
  std::string why(head.text, '\0');
  if (!pipe.Read(soup.vertices.data(), head.vertices) ||
      !pipe.Read(soup.corners.data(), head.corners) || !pipe.Read(soup.ends.data(), head.faces) ||
      !pipe.Read(why.data(), head.text)) {
    throw InputError("damaged COLLADA", path, kWantedDae);
  }
  if (soup.ends.empty()) {
    throw InputError("damaged COLLADA: " + Quoted(why), path, kWantedDae);
  }
  char text[32];  // float32 has no 0.01
  std::snprintf(text, sizeof text, "%.6g", head.metres);
  const double metres = ParseNumber(text).value_or(0.0);
  if (!(metres > 1e-12 && metres < 1e12)) {
    throw InputError("a unit of " + std::string(text) + " m", path, "a length");
  }
  soup.unit = UnitOf(metres);
  return soup;
}

}  // namespace antigrasp
