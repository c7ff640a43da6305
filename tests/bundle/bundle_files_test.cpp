#include "antigrasp/bundle/bundle_files.h"

#include <gtest/gtest.h>

#include "antigrasp/bundle/xml_writer.h"
#include "tests/bundle/dented_solids.h"
#include "tests/support/well_formed.h"

namespace antigrasp {
namespace {

ObjectBundle LBundle(const std::string& name) {
  BundleOptions options;
  options.friction = 0.35;
  return MakeObjectBundle(name, shapes::LShape(), options);
}

int CountOf(const std::string& text, const std::string& part) {
  int count = 0;
  for (std::size_t at = 0; (at = text.find(part, at)) != std::string::npos; ++at) ++count;
  return count;
}

TEST(ObjectBundle, HasTheMassOfItsSolidAtADensity) {
  const ObjectBundle bundle = LBundle("l");
  EXPECT_NEAR(bundle.mass, 0.024, 1e-12);
  // Arms of 8 and 16 cm3: (20, 10) and (10, 30) mm by 16 and 8 g, then moved.
  EXPECT_TRUE(bundle.center.isApprox(Eigen::Vector3d(.01 + .05 / 3, -.02 + .05 / 3, .03), 1e-9));
}

TEST(ObjectBundle, OfAMassHasTheInertiaOfThatMass) {
  BundleOptions options;
  options.mass = 6.0;
  const ObjectBundle bundle =
      MakeObjectBundle("box", shapes::Away(shapes::Box({1, 2, 3})), options);
  EXPECT_EQ(bundle.mass, 6.0);
  // m / 12 (b2 + c2)
  EXPECT_TRUE(bundle.inertia.isApprox(
      Eigen::Vector3d(0.5 * 13, 0.5 * 10, 0.5 * 5).asDiagonal().toDenseMatrix(), 1e-12));
}

TEST(ObjectBundle, NumbersItsPartsWithTwoDigits) {
  ObjectBundle bundle;
  bundle.name = "mug";
  EXPECT_EQ(bundle.PartName(7), "mug_part_07");
}

TEST(MjcfText, IsThisOfAnObjectOfOnePart) {
  ObjectBundle bundle;
  bundle.name = "a";
  bundle.parts.resize(1);
  bundle.friction = 0.25;
  bundle.mass = 2.0;
  bundle.center = {1, 2, 3};
  bundle.inertia << 11, 12, 13, 12, 22, 23, 13, 23, 33;
  EXPECT_EQ(MjcfText(bundle),
            R"(<?xml version="1.0"?>
<!-- written by antigrasp: metres, kilograms, the object's own axes; see README.md -->
<mujoco model="a">
  <asset>
    <mesh name="a" file="a.stl"/>
    <mesh name="a_part_00" file="a_part_00.stl"/>
  </asset>
  <worldbody>
    <body name="a">
      <freejoint/>
      <inertial pos="1 2 3" mass="2" fullinertia="11 22 33 12 13 23"/>
      <geom type="mesh" mesh="a" group="2" contype="0" conaffinity="0"/>
      <geom type="mesh" mesh="a_part_00" group="3" priority="1" friction="0.25"/>
    </body>
  </worldbody>
</mujoco>
)");
}

TEST(UrdfText, HasOneLinkWithACollisionForEveryPart) {
  const ObjectBundle bundle = LBundle("l");
  const std::string urdf = UrdfText(bundle);
  EXPECT_EQ(shapes::WhyNotWellFormed(urdf), "");
  EXPECT_EQ(CountOf(urdf, "<link "), 1);
  EXPECT_EQ(CountOf(urdf, "<collision>"), 2);
  EXPECT_EQ(CountOf(urdf, "filename=\"l_part_01.stl\""), 1);
  EXPECT_EQ(CountOf(urdf, "<visual>"), 1);
  EXPECT_EQ(CountOf(urdf, "<lateral_friction value=\"0.35\"/>"), 1);
}

TEST(UrdfText, NamesTheMomentsOfInertia) {
  ObjectBundle bundle;
  bundle.name = "a";
  bundle.inertia << 11, 12, 13, 12, 22, 23, 13, 23, 33;
  EXPECT_EQ(CountOf(UrdfText(bundle),
                    R"(<inertia ixx="11" ixy="12" ixz="13" iyy="22" iyz="23" izz="33"/>)"),
            1);
}

TEST(SdformatText, IsThisOfAnObjectOfOnePart) {
  ObjectBundle bundle;
  bundle.name = "a";
  bundle.parts.resize(1);
  bundle.friction = 0.25;
  bundle.mass = 2.0;
  bundle.center = {1, 2, 3};
  bundle.inertia << 11, 12, 13, 12, 22, 23, 13, 23, 33;
  EXPECT_EQ(SdformatText(bundle), R"(<?xml version="1.0"?>
<!-- written by antigrasp: metres, kilograms, the object's own axes; see README.md -->
<sdf version="1.9">
  <model name="a">
    <link name="body">
      <inertial>
        <pose>1 2 3 0 0 0</pose>
        <mass>2</mass>
        <inertia>
          <ixx>11</ixx>
          <ixy>12</ixy>
          <ixz>13</ixz>
          <iyy>22</iyy>
          <iyz>23</iyz>
          <izz>33</izz>
        </inertia>
      </inertial>
      <visual name="visual">
        <geometry>
          <mesh>
            <uri>a.stl</uri>
          </mesh>
        </geometry>
      </visual>
      <collision name="part_0">
        <geometry>
          <mesh>
            <uri>a_part_00.stl</uri>
          </mesh>
        </geometry>
        <surface>
          <friction>
            <ode>
              <mu>0.25</mu>
              <mu2>0.25</mu2>
            </ode>
            <bullet>
              <friction>0.25</friction>
              <friction2>0.25</friction2>
            </bullet>
          </friction>
        </surface>
      </collision>
    </link>
  </model>
</sdf>
)");
}

TEST(SdformatConfig, NamesTheModelAndItsFile) {
  ObjectBundle bundle;
  bundle.name = "a";
  const std::string config = SdformatConfig(bundle);
  EXPECT_NE(config.find("<name>a</name>"), std::string::npos);
  EXPECT_NE(config.find("<sdf version=\"1.9\">model.sdf</sdf>"), std::string::npos);
}

TEST(BundleFiles, EscapeANameThatXmlMust) {
  const ObjectBundle bundle = LBundle("a<b> & \"c\"");
  EXPECT_EQ(shapes::WhyNotWellFormed(SdformatConfig(bundle)), "");
  for (const std::string& text : {MjcfText(bundle), UrdfText(bundle), SdformatText(bundle)}) {
    EXPECT_EQ(shapes::WhyNotWellFormed(text), "") << text;
    EXPECT_GT(CountOf(text, "a&lt;b&gt; &amp; &quot;c&quot;_part_00.stl"), 0);
  }
}

TEST(BundleReadme, StatesTheErrorsOfTheParts) {
  ObjectBundle bundle = LBundle("l");
  bundle.errors = {0.0125, 0.0025, 0.0015, 0.00125};
  bundle.cell = 0.00225;
  const std::string readme = BundleReadme(bundle, BundleTarget::kMujoco);
  EXPECT_NE(
      readme.find(
          "which cover 1.25 % of the volume too much and miss 0.25 %; Hausdorff distance 1.50 "
          "mm, deepest dent covered 1.25 mm (a cell of a 32^3 grid is 2.25 mm)"),
      std::string::npos)
      << readme;
  EXPECT_NE(readme.find("--mjcf=self_check.xml"), std::string::npos);
  for (const char* other : {"URDF", "SDFormat", "USD"}) {
    EXPECT_EQ(readme.find(other), std::string::npos) << other;
  }
}

TEST(XmlWriter, ClosesElementsInTheirOrder) {
  XmlWriter xml("one");
  xml.Open("a", {{"x", "1 < 2"}});
  xml.Open("b");
  xml.Text("c", "d & e");
  xml.Close();
  xml.Close();
  EXPECT_EQ(
      xml.Take(),
      "<?xml version=\"1.0\"?>\n<!-- one -->\n<a x=\"1 &lt; 2\">\n  <b>\n    <c>d &amp; e</c>\n  "
      "</b>\n</a>\n");
}

}  // namespace
}  // namespace antigrasp
