// The plate as lib3mf's own reader finds it: the 3MF Consortium's, not ours (plate_test.cpp).
#include <Model/COM/NMR_DLLInterfaces.h>
#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

#include "antigrasp/export/plate.h"
#include "tests/support/shapes.h"

namespace antigrasp {
namespace {

constexpr LIB3MFRESULT kFine = 0;
constexpr DWORD kMillimetre = 1;  // lib3mf counts from micrometre = 0

struct FoundObject {
  std::string name;
  DWORD vertices = 0, triangles = 0;
  BOOL solid = 0;
};

struct FoundPlate {
  DWORD unit = 0, warnings = 0;
  int items = 0;
  std::vector<FoundObject> objects;
};

FoundObject ObjectOf(NMR::PLib3MFModelResource* resource) {
  FoundObject found;
  std::array<char, 64> name{};
  ULONG needed = 0;
  NMR::lib3mf_object_getnameutf8(resource, name.data(), name.size(), &needed);
  found.name = name.data();
  NMR::lib3mf_meshobject_getvertexcount(resource, &found.vertices);
  NMR::lib3mf_meshobject_gettrianglecount(resource, &found.triangles);
  NMR::lib3mf_meshobject_ismanifoldandoriented(resource, &found.solid);
  return found;
}

FoundPlate ReadByLib3mf(const std::string& path) {
  FoundPlate found;
  NMR::PLib3MFModel* model = nullptr;
  NMR::PLib3MFModelReader* reader = nullptr;
  NMR::PLib3MFModelResourceIterator* objects = nullptr;
  NMR::PLib3MFModelBuildItemIterator* items = nullptr;
  EXPECT_EQ(NMR::lib3mf_createmodel(&model), kFine);
  EXPECT_EQ(NMR::lib3mf_model_queryreader(model, "3mf", &reader), kFine);
  EXPECT_EQ(NMR::lib3mf_reader_readfromfileutf8(reader, path.c_str()), kFine);
  NMR::lib3mf_reader_getwarningcount(reader, &found.warnings);
  NMR::lib3mf_model_getunit(model, &found.unit);
  EXPECT_EQ(NMR::lib3mf_model_getmeshobjects(model, &objects), kFine);
  BOOL more = 0;
  while (NMR::lib3mf_resourceiterator_movenext(objects, &more) == kFine && more) {
    NMR::PLib3MFModelResource* object = nullptr;
    EXPECT_EQ(NMR::lib3mf_resourceiterator_getcurrent(objects, &object), kFine);
    found.objects.push_back(ObjectOf(object));
    NMR::lib3mf_release(object);
  }
  EXPECT_EQ(NMR::lib3mf_model_getbuilditems(model, &items), kFine);
  while (NMR::lib3mf_builditemiterator_movenext(items, &more) == kFine && more) ++found.items;
  for (NMR::PLib3MFBase* used : {items, objects, reader, model}) NMR::lib3mf_release(used);
  return found;
}

TEST(PlateByLib3mf, HasEveryObjectOnceAsASolidInMillimetres) {
  const shapes::TempFolder folder;
  Plate plate;
  plate.Add("mug & \"lid\"", shapes::Box({40.0, 20.0, 10.0}));
  plate.Add("torus", shapes::Torus(20.0, 6.0, 12, 8));
  plate.Write(folder / "plate.3mf");
  const FoundPlate found = ReadByLib3mf((folder / "plate.3mf").string());
  EXPECT_EQ(found.warnings, 0U);
  EXPECT_EQ(found.unit, kMillimetre);
  EXPECT_EQ(found.items, 2);
  ASSERT_EQ(found.objects.size(), 2U);
  EXPECT_EQ(found.objects[0].name, "mug & \"lid\"");
  EXPECT_EQ(found.objects[0].vertices, 8U);
  EXPECT_EQ(found.objects[0].triangles, 12U);
  EXPECT_EQ(found.objects[1].name, "torus");
  EXPECT_EQ(found.objects[1].vertices, 96U);  // 12 x 8
  EXPECT_EQ(found.objects[1].triangles, 192U);
  for (const FoundObject& object : found.objects) EXPECT_TRUE(object.solid) << object.name;
}

}  // namespace
}  // namespace antigrasp
