// Bundles in libsdformat, Gazebo's reader of SDFormat and URDF, with warnings as errors.
#include <gtest/gtest.h>

#include "antigrasp/bundle/bundle_files.h"
#include "tests/bundle/dented_solids.h"

#ifdef ANTIGRASP_HAS_SDFORMAT
#include <sdf/sdf.hh>
#endif

namespace antigrasp {
namespace {

#ifdef ANTIGRASP_HAS_SDFORMAT

struct Read {
  sdf::Root root;
  std::string errors;
};

Read ReadWith(const std::filesystem::path& path) {
  sdf::ParserConfig config;
  config.SetWarningsPolicy(sdf::EnforcementPolicy::ERR);
  config.SetUnrecognizedElementsPolicy(sdf::EnforcementPolicy::ERR);
  config.SetDeprecatedElementsPolicy(sdf::EnforcementPolicy::ERR);
  Read read;
  for (const sdf::Error& error : read.root.Load(path, config))
    read.errors += error.Message() + "\n";
  return read;
}

sdf::ElementPtr FrictionOf(const sdf::Link& link, std::size_t collision) {
  return link.CollisionByIndex(collision)->Surface()->Element()->GetElement("friction");
}

class SdformatReads : public testing::TestWithParam<const char*> {
 protected:
  static ObjectBundle LBundle(const std::string& name) {
    BundleOptions options;
    options.friction = 0.35;
    return MakeObjectBundle(name, shapes::LShape(), options);
  }
  std::filesystem::path Written(const ObjectBundle& bundle) {
    for (const TextFile& file : TextFiles(bundle, BundleTarget::kAll)) {
      folder_.Write(file.name, file.text);
    }
    return folder_ /
           (std::string(GetParam()) == "urdf" ? bundle.name + ".urdf" : std::string("model.sdf"));
  }

  shapes::TempFolder folder_;
};

TEST_P(SdformatReads, OneLinkWithTheMassCentreAndInertiaThatWereWritten) {
  const ObjectBundle bundle = LBundle("l");
  const Read read = ReadWith(Written(bundle));
  ASSERT_EQ(read.errors, "");
  const sdf::Model* model = read.root.Model();
  ASSERT_NE(model, nullptr);
  EXPECT_EQ(model->Name(), "l");
  ASSERT_EQ(model->LinkCount(), 1u);
  const ignition::math::Inertiald inertial = model->LinkByIndex(0)->Inertial();
  EXPECT_NEAR(inertial.MassMatrix().Mass(), 0.024, 0.024e-6);
  const auto& center = inertial.Pose().Pos();
  EXPECT_TRUE(Eigen::Vector3d(center.X(), center.Y(), center.Z()).isApprox(bundle.center, 1e-6));
  Eigen::Matrix3d moments;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) moments(i, j) = inertial.Moi()(i, j);
  }
  EXPECT_TRUE(moments.isApprox(bundle.inertia, 1e-6));
  EXPECT_NEAR(inertial.Pose().Rot().W(), 1.0, 1e-12);
}

TEST_P(SdformatReads, ACollisionForEveryPart) {
  const ObjectBundle bundle = LBundle("l");
  const Read read = ReadWith(Written(bundle));
  ASSERT_EQ(read.errors, "");
  const sdf::Link* link = read.root.Model()->LinkByIndex(0);
  EXPECT_EQ(link->VisualCount(), 1u);
  EXPECT_EQ(link->VisualByIndex(0)->Geom()->MeshShape()->Uri(), "l.stl");
  ASSERT_EQ(link->CollisionCount(), 2u);
  for (std::size_t k = 0; k < 2; ++k) {
    const sdf::Mesh* mesh = link->CollisionByIndex(k)->Geom()->MeshShape();
    ASSERT_NE(mesh, nullptr);
    EXPECT_EQ(mesh->Uri(), bundle.PartName(k) + ".stl");
    EXPECT_EQ(mesh->Scale(), ignition::math::Vector3d::One);
  }
}

TEST_P(SdformatReads, ALinkOfEveryName) {
  for (const std::string name : {"world", "__model__", "a::b", "a<b> & \"c\" 'd'", "3-way"}) {
    const Read read = ReadWith(Written(LBundle(name)));
    EXPECT_EQ(read.errors, "") << name;
    ASSERT_NE(read.root.Model(), nullptr) << name;
    EXPECT_EQ(read.root.Model()->LinkCount(), 1u) << name;
    EXPECT_EQ(read.root.Model()->LinkByIndex(0)->CollisionCount(), 2u) << name;
  }
}

INSTANTIATE_TEST_SUITE_P(Of, SdformatReads, testing::Values("urdf", "sdformat"),
                         [](const auto& info) { return std::string(info.param); });

TEST(SdformatReadsSurface, TheFrictionOfTheObject) {
  shapes::TempFolder folder;
  BundleOptions options;
  options.friction = 0.35;
  const ObjectBundle bundle = MakeObjectBundle("l", shapes::LShape(), options);
  const Read read = ReadWith(folder.Write("model.sdf", SdformatText(bundle)));
  ASSERT_EQ(read.errors, "");
  const sdf::ElementPtr friction = FrictionOf(*read.root.Model()->LinkByIndex(0), 1);
  EXPECT_EQ(friction->GetElement("ode")->Get<double>("mu"), 0.35);
  EXPECT_EQ(friction->GetElement("ode")->Get<double>("mu2"), 0.35);
  EXPECT_EQ(friction->GetElement("bullet")->Get<double>("friction"), 0.35);
  EXPECT_EQ(friction->GetElement("bullet")->Get<double>("friction2"), 0.35);
}

TEST(SdformatReadsWorld, OfThePinchedBoxesOnSpringsOfANewton) {
  shapes::TempFolder folder;
  const Read read = ReadWith(folder.Write("self_check.sdf", SdformatSelfCheck()));
  ASSERT_EQ(read.errors, "");
  const sdf::World* world = read.root.WorldByIndex(0);
  ASSERT_NE(world, nullptr);
  ASSERT_EQ(world->ModelCount(), 3u);
  const sdf::Link* box = world->ModelByName("stays")->LinkByIndex(0);
  EXPECT_NEAR(box->Inertial().MassMatrix().Mass(), 0.03, 1e-12);
  EXPECT_NEAR(box->Inertial().Moi()(1, 1), 0.03 * 2 * .04 * .04 / 12, 1e-12);
  EXPECT_EQ(FrictionOf(*box, 0)->GetElement("ode")->Get<double>("mu"), 0.16);
  const sdf::Model* balls = world->ModelByName("balls");
  ASSERT_EQ(balls->LinkCount(), 4u);
  ASSERT_EQ(balls->JointCount(), 4u);
  const sdf::JointAxis* axis = balls->JointByName("falls_right_slide")->Axis(0);
  EXPECT_EQ(axis->Xyz(), ignition::math::Vector3d(-1, 0, 0));
  EXPECT_EQ(axis->SpringStiffness() * axis->SpringReference(), 1.0);
}

#else

TEST(SdformatReads, Bundles) { GTEST_SKIP() << "libsdformat-dev is not installed"; }

#endif

}  // namespace
}  // namespace antigrasp
