#include <array>
#include <map>
#include <utility>

#include "antigrasp/core/choice.h"
#include "antigrasp/core/error.h"
#include "antigrasp/mesh/mesh_readers.h"
#include "antigrasp/mesh/placed_soup.h"
#include "antigrasp/mesh/text_scanner.h"
#include "antigrasp/mesh/xml_elements.h"
#include "antigrasp/mesh/zip_parts.h"

// 3MF Core Specification 1.3 and, of the Production Extension, objects in other parts (p:path).
namespace antigrasp {
namespace {

constexpr const char* kCore = "http://schemas.microsoft.com/3dmanufacturing/core/";
constexpr const char* kRelations = "http://schemas.openxmlformats.org/package/2006/relationships";
constexpr const char* kModelRelation =
    "http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel";
constexpr int kDeepest = 64;                     // components in components
constexpr std::int64_t kMostVisits = 1'000'000;  // of objects, however they are nested

const std::map<std::string, FileUnit, std::less<>>& Units() {
  static const std::map<std::string, FileUnit, std::less<>> units = {
      {"micron", {"micron", 1e-6}}, {"millimeter", {"mm", 0.001}}, {"centimeter", {"cm", 0.01}},
      {"inch", {"in", 0.0254}},     {"foot", {"ft", 0.3048}},      {"meter", {"m", 1.0}}};
  return units;
}

using ObjectId = std::pair<std::string, std::string>;  // part of the package, id in it

struct PlacedObject {
  ObjectId object;
  Eigen::Affine3d place = Eigen::Affine3d::Identity();
};

struct Object3mf {
  PolygonSoup mesh;
  std::vector<PlacedObject> components;
  bool support = false;  // for the printer
};

struct Package3mf {
  std::map<ObjectId, Object3mf> objects;
  std::vector<PlacedObject> build;
  std::optional<FileUnit> unit;
};

std::string PartName(std::string_view path) {
  return std::string(path.substr(path.starts_with('/') ? 1 : 0));
}

// One model part into the package.
class ModelPart {
 public:
  ModelPart(const std::string& path, std::string part, bool root, Package3mf* package)
      : xml_(
            path + ", " + part, kCore,
            [this](std::string_view name, const XmlAttributes& a) { Start(name, a); },
            [this](std::string_view name) {
              if (name == "object") object_ = nullptr;
            }),
        part_(std::move(part)),
        root_(root),
        package_(package) {}

  void Read(ZipParts* zip) {
    zip->Read(part_, [&](std::string_view bytes) { xml_.Feed(bytes); });
    xml_.Finish();
    if (!is_model_) throw InputError("no 3MF model", xml_.Where(), "<model> of the core namespace");
  }
  // Parts that objects of this one lie in.
  const std::vector<std::string>& others() const { return others_; }

 private:
  void Start(std::string_view name, const XmlAttributes& attributes) {
    if (name == "vertex" && object_ != nullptr) {
      object_->mesh.vertices.emplace_back(Number(attributes, "x"), Number(attributes, "y"),
                                          Number(attributes, "z"));
    } else if (name == "triangle" && object_ != nullptr) {
      for (const char* corner : {"v1", "v2", "v3"}) {
        object_->mesh.corners.push_back(Whole(attributes, corner));
      }
      object_->mesh.EndPolygon();
    } else if (name == "component" && object_ != nullptr) {
      object_->components.push_back(Placed(attributes));
    } else if (name == "item" && root_) {
      package_->build.push_back(Placed(attributes));
    } else if (name == "object") {
      StartObject(attributes);
    } else if (name == "model") {
      is_model_ = true;
      if (root_) TakeUnit(attributes.Find("unit").value_or("millimeter"));
    }
  }

  void StartObject(const XmlAttributes& attributes) {
    const auto id = Require(attributes, "id");
    const auto [place, is_new] = package_->objects.try_emplace({part_, std::string(id)});
    if (!is_new) Fail("object " + Quoted(id) + " a second time", "one object of an id");
    object_ = &place->second;
    const auto type = attributes.Find("type").value_or("model");
    object_->support = type == "support" || type == "solidsupport";
  }

  void TakeUnit(std::string_view name) {
    const auto unit = Units().find(name);
    if (unit == Units().end()) {
      Fail("unit " + Quoted(name), "micron, millimeter, centimeter, inch, foot or meter");
    }
    package_->unit = unit->second;
  }

  PlacedObject Placed(const XmlAttributes& attributes) {
    PlacedObject placed;
    placed.object = {part_, std::string(Require(attributes, "objectid"))};
    if (const auto path = attributes.Find("path")) {
      placed.object.first = PartName(*path);
      others_.push_back(placed.object.first);
    }
    auto text = attributes.Find("transform");
    if (!text) return placed;
    // Rows of four by three, for points as rows.
    for (int row = 0; row < 4; ++row) {
      for (int column = 0; column < 3; ++column) {
        const std::string_view word = TakeWord(&*text);
        const auto value = ParseNumber(word);
        if (!value) Fail("transform " + Quoted(word), "twelve numbers");
        placed.place(column, row) = *value;
      }
    }
    return placed;
  }

  std::string_view Require(const XmlAttributes& attributes, const char* name) const {
    const auto value = attributes.Find(name);
    if (!value) Fail(std::string("no ") + name, std::string("the attribute ") + name);
    return *value;
  }
  double Number(const XmlAttributes& attributes, const char* name) const {
    const std::string_view text = Require(attributes, name);
    const auto value = ParseNumber(text);
    if (!value) Fail(std::string(name) + " = " + Quoted(text), "a number");
    return *value;
  }
  std::int64_t Whole(const XmlAttributes& attributes, const char* name) const {
    const std::string_view text = Require(attributes, name);
    const auto value = ParseInteger(text);
    if (!value) Fail(std::string(name) + " = " + Quoted(text), "a whole number from 0");
    return *value;
  }
  [[noreturn]] void Fail(const std::string& what, const std::string& expected) const {
    throw InputError(what, xml_.Where(), expected);
  }

  XmlElements xml_;
  std::string part_;
  bool root_, is_model_ = false;
  Package3mf* package_;
  Object3mf* object_ = nullptr;  // being read
  std::vector<std::string> others_;
};

// The part that the package's relations name as its model.
std::string RootPart(const std::string& path, ZipParts* zip) {
  constexpr const char* kFile = "_rels/.rels";
  if (!zip->Has(kFile)) throw InputError("a zip archive without 3MF in it", path, "a 3MF file");
  std::string root;
  XmlElements xml(
      path + ", " + kFile, kRelations,
      [&](std::string_view name, const XmlAttributes& attributes) {
        if (name != "Relationship" || attributes.Find("Type") != kModelRelation) return;
        root = PartName(attributes.Find("Target").value_or(""));
      },
      [](std::string_view) {});
  zip->Read(kFile, [&](std::string_view bytes) { xml.Feed(bytes); });
  xml.Finish();
  if (root.empty()) throw InputError("a package without a 3D model", path, "a 3MF file");
  return root;
}

Package3mf ReadPackage(std::string_view bytes, const std::string& path) {
  ZipParts zip(bytes, path);
  Package3mf package;
  std::vector<std::string> parts = {RootPart(path, &zip)};
  std::map<std::string, bool> seen;
  for (bool root = true; !parts.empty(); root = false) {
    const std::string name = parts.back();
    parts.pop_back();
    if (!seen.try_emplace(name, true).second) continue;
    ModelPart part(path, name, root, &package);
    part.Read(&zip);
    parts.insert(parts.end(), part.others().begin(), part.others().end());
  }
  return package;
}

// The objects of the build, with their components, at their places.
class Build {
 public:
  Build(const Package3mf& package, const std::string& path) : package_(package), path_(path) {}

  PolygonSoup Soup() {
    for (const PlacedObject& item : package_.build) Add(item, Eigen::Affine3d::Identity(), 0);
    if (supports_ > 0) {
      soup_.notes.push_back(std::to_string(supports_) + " support objects left out");
    }
    soup_.unit = package_.unit;
    return std::move(soup_);
  }

 private:
  void Add(const PlacedObject& placed, const Eigen::Affine3d& outer, int depth) {
    const auto& [part, id] = placed.object;
    const auto found = package_.objects.find(placed.object);
    if (found == package_.objects.end()) {
      throw InputError("no object " + Quoted(id) + " in " + part, path_, "every object placed");
    }
    if (depth > kDeepest || ++visits_ > kMostVisits) {
      throw InputError("object " + Quoted(id) + ": components without an end", path_,
                       "a hierarchy without a circle, of at most a million objects");
    }
    const Object3mf& object = found->second;
    if (object.support) {
      ++supports_;
      return;
    }
    const Eigen::Affine3d place = outer * placed.place;
    AppendPlaced(object.mesh, place, "object " + Quoted(id), path_, &soup_);
    for (const PlacedObject& component : object.components) Add(component, place, depth + 1);
  }

  const Package3mf& package_;
  const std::string& path_;
  PolygonSoup soup_;
  std::int64_t visits_ = 0;
  int supports_ = 0;
};

}  // namespace

PolygonSoup Read3mf(std::string_view bytes, const std::string& path) {
  const Package3mf package = ReadPackage(bytes, path);
  if (package.build.empty()) throw InputError("nothing to build", path, "a build with an item");
  return Build(package, path).Soup();
}

}  // namespace antigrasp
