#include "antigrasp/export/plate.h"

#include <Model/COM/NMR_DLLInterfaces.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <string_view>

#include "antigrasp/core/error.h"
#include "antigrasp/core/rng.h"

namespace antigrasp {
namespace {

using Eigen::Vector3d;

// Of lib3mf, released when it goes.
template <typename T>
class Owned {
 public:
  Owned() = default;
  ~Owned() {
    if (pointer_ != nullptr) NMR::lib3mf_release(pointer_);
  }
  Owned(const Owned&) = delete;
  Owned& operator=(const Owned&) = delete;
  T* get() const { return pointer_; }
  T** out() { return &pointer_; }

 private:
  T* pointer_ = nullptr;
};

void Done(long result, const std::string& what) {
  if (result == 0) return;
  throw RuntimeFailure("lib3mf cannot write " + what + ": out of memory, or the disk is full");
}

// As RFC 9562 has those of one's own making (version 8).
std::string Identifier(std::string_view kind, const std::string& content) {
  const std::uint64_t high = HashOf(std::string(kind) + content);
  const std::uint64_t low = HashOf(content + std::string(kind));
  char text[64];
  std::snprintf(text, sizeof text, "%08x-%04x-8%03x-%04x-%012llx",
                static_cast<unsigned>(high >> 32), static_cast<unsigned>(high >> 16 & 0xffff),
                static_cast<unsigned>(high & 0xfff),
                static_cast<unsigned>(0x8000 | (low >> 48 & 0x3fff)),
                static_cast<unsigned long long>(low & 0xffffffffffffULL));
  return text;
}

template <typename T>
std::string BytesOf(const std::vector<T>& values) {
  return {reinterpret_cast<const char*>(values.data()), sizeof(T) * values.size()};
}

}  // namespace

std::vector<Vector3d> Plate::Places() const {
  constexpr double kGap = 5.0;
  std::vector<Vector3d> places;
  if (solids_.size() < 2) return std::vector<Vector3d>(solids_.size(), Vector3d::Zero());
  const auto columns = static_cast<std::size_t>(std::ceil(std::sqrt(double(solids_.size()))));
  double x = 0.0, y = 0.0, deepest = 0.0;
  for (std::size_t i = 0; i < solids_.size(); ++i) {
    const BoundingBox box = Bounds(solids_[i].mesh);
    if (i > 0 && i % columns == 0) {
      x = 0.0;
      y += deepest + kGap;
      deepest = 0.0;
    }
    places.emplace_back(x - box.min.x(), y - box.min.y(), 0.0);
    x += box.Extent().x() + kGap;
    deepest = std::max(deepest, box.Extent().y());
  }
  return places;
}

void Plate::Write(const std::filesystem::path& path) const {
  Owned<NMR::PLib3MFModel> model;
  Done(NMR::lib3mf_createmodel(model.out()), path.string());
  const std::vector<Vector3d> places = Places();
  std::string all;  // of the contents, one after the other
  for (std::size_t i = 0; i < solids_.size(); ++i) {
    const auto& [name, mesh] = solids_[i];
    std::vector<NMR::MODELMESHVERTEX> vertices;
    for (const Vector3d& v : mesh.vertices) {
      const Eigen::Vector3f at = (v + places[i]).cast<float>();
      vertices.push_back({{at.x(), at.y(), at.z()}});
    }
    std::vector<NMR::MODELMESHTRIANGLE> triangles;
    for (const auto& face : mesh.faces) {
      triangles.push_back({{DWORD(face[0]), DWORD(face[1]), DWORD(face[2])}});
    }
    // Two alike are two objects: a number tells them apart.
    const std::string content =
        std::to_string(i) + ":" + BytesOf(vertices) + BytesOf(triangles) + name;
    all += Identifier("object", content);
    Owned<NMR::PLib3MFModelMeshObject> object;
    Done(NMR::lib3mf_model_addmeshobject(model.get(), object.out()), name);
    Done(NMR::lib3mf_meshobject_setgeometry(object.get(), vertices.data(), DWORD(vertices.size()),
                                            triangles.data(), DWORD(triangles.size())),
         name);
    BOOL manifold = 0;
    Done(NMR::lib3mf_meshobject_ismanifoldandoriented(object.get(), &manifold), name);
    if (!manifold) throw RuntimeFailure(name + " has edges without two faces in " + path.string());
    NMR::lib3mf_object_setnameutf8(object.get(), name.c_str());  // none where it is no UTF-8
    Done(NMR::lib3mf_object_setuuidutf8(object.get(), Identifier("object", content).c_str()), name);
    Owned<NMR::PLib3MFModelBuildItem> item;
    Done(NMR::lib3mf_model_addbuilditem(model.get(), object.get(), nullptr, item.out()), name);
    Done(NMR::lib3mf_builditem_setuuidutf8(item.get(), Identifier("item", content).c_str()), name);
  }
  Done(NMR::lib3mf_model_setbuilduuidutf8(model.get(), Identifier("build", all).c_str()),
       path.string());
  Owned<NMR::PLib3MFModelWriter> writer;
  Done(NMR::lib3mf_model_querywriter(model.get(), "3mf", writer.out()), path.string());
  Done(NMR::lib3mf_writer_writetofileutf8(writer.get(), path.c_str()), path.string());
}

}  // namespace antigrasp
