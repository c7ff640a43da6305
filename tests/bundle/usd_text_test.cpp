#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <sstream>

#include "antigrasp/bundle/bundle_files.h"
#include "antigrasp/bundle/simulator_names.h"
#include "antigrasp/bundle/usd_writer.h"
#include "tests/bundle/dented_solids.h"

namespace antigrasp {
namespace {

// The numbers of the tuple of an attribute.
std::vector<double> NumbersOf(const std::string& usd, const std::string& attribute) {
  const std::size_t at = usd.find(attribute + " = (");
  std::string text = usd.substr(at + attribute.size() + 4);
  text = text.substr(0, text.find(')'));
  std::replace(text.begin(), text.end(), ',', ' ');
  std::istringstream words(text);
  std::vector<double> numbers;
  for (double number = 0.0; words >> number;) numbers.push_back(number);
  return numbers;
}

ObjectBundle OneTetrahedron(const std::string& name) {
  ObjectBundle bundle;
  bundle.name = name;
  bundle.mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {0, 0, 3}};
  bundle.mesh.faces = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
  bundle.parts.push_back(MakeConvexPart(bundle.mesh.vertices));
  bundle.parts[0].mesh = bundle.mesh;
  bundle.friction = 0.25;
  bundle.mass = 2.0;
  bundle.center = {0.25, 0.5, 0.75};
  bundle.inertia = Eigen::Vector3d(4, 5, 6).asDiagonal();
  return bundle;
}

TEST(UsdText, IsThisOfAnObjectOfOnePart) {
  EXPECT_EQ(UsdText(OneTetrahedron("3-way \"mug\"")), R"(#usda 1.0
(
    defaultPrim = "_3_way__mug_"
    doc = "written by antigrasp: the object's own axes; see README.md"
    kilogramsPerUnit = 1
    metersPerUnit = 1
    upAxis = "Z"
)

def Xform "_3_way__mug_" (
    prepend apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"]
    assetInfo = {
        string name = "3-way \"mug\""
    }
    kind = "component"
)
{
    point3f physics:centerOfMass = (0.25, 0.5, 0.75)
    float3 physics:diagonalInertia = (4, 5, 6)
    float physics:mass = 2
    quatf physics:principalAxes = (1, 0, 0, 0)

    def Mesh "visual"
    {
        float3[] extent = [(0, 0, 0), (1, 2, 3)]
        int[] faceVertexCounts = [3, 3, 3, 3]
        int[] faceVertexIndices = [0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2]
        uniform token orientation = "rightHanded"
        point3f[] points = [(0, 0, 0), (1, 0, 0), (0, 2, 0), (0, 0, 3)]
        uniform token subdivisionScheme = "none"
    }

    def Mesh "part_0" (
        prepend apiSchemas = ["PhysicsCollisionAPI", "PhysicsMeshCollisionAPI", "MaterialBindingAPI"]
    )
    {
        uniform token physics:approximation = "convexHull"
        uniform token purpose = "guide"
        rel material:binding:physics = </_3_way__mug_/friction>
        float3[] extent = [(0, 0, 0), (1, 2, 3)]
        int[] faceVertexCounts = [3, 3, 3, 3]
        int[] faceVertexIndices = [0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2]
        uniform token orientation = "rightHanded"
        point3f[] points = [(0, 0, 0), (1, 0, 0), (0, 2, 0), (0, 0, 3)]
        uniform token subdivisionScheme = "none"
    }

    def Material "friction" (
        prepend apiSchemas = ["PhysicsMaterialAPI", "PhysxMaterialAPI"]
    )
    {
        float physics:dynamicFriction = 0.25
        float physics:restitution = 0
        float physics:staticFriction = 0.25
        uniform token physxMaterial:frictionCombineMode = "min"
    }
}
)");
}

// The tensor is that of the moments along the principal axes, the quaternion's real part first.
TEST(UsdText, PrincipalAxesAndMomentsMakeTheInertia) {
  ObjectBundle bundle = OneTetrahedron("a");
  bundle.inertia << 11, 1, 2, 1, 13, 3, 2, 3, 17;
  const std::string usd = UsdText(bundle);
  const auto q = NumbersOf(usd, "quatf physics:principalAxes");
  const auto moments = NumbersOf(usd, "float3 physics:diagonalInertia");
  ASSERT_EQ(q.size(), 4u);
  ASSERT_EQ(moments.size(), 3u);
  const Eigen::Matrix3d axes = Eigen::Quaterniond(q[0], q[1], q[2], q[3]).toRotationMatrix();
  const Eigen::Vector3d diagonal(moments[0], moments[1], moments[2]);
  EXPECT_TRUE((axes * diagonal.asDiagonal() * axes.transpose()).isApprox(bundle.inertia, 1e-12));
}

TEST(UsdSelfCheck, DrawsTheBallsInwardWithANewton) {
  const std::string usd = UsdSelfCheck();
  const std::size_t left = usd.find("def PhysicsPrismaticJoint \"stays_left_slide\"");
  const std::size_t right = usd.find("def PhysicsPrismaticJoint \"stays_right_slide\"");
  ASSERT_LT(left, right);
  ASSERT_NE(right, std::string::npos);
  EXPECT_LT(usd.find("physics:targetPosition = 1\n", left), right);
  EXPECT_NE(usd.find("physics:targetPosition = -1\n", right), std::string::npos);
  EXPECT_NE(usd.find("float drive:linear:physics:stiffness = 1\n", left), std::string::npos);
  const std::size_t material = usd.find("def Material \"friction_of_stays\"");
  ASSERT_NE(material, std::string::npos);
  EXPECT_NE(usd.find("staticFriction = 0.16\n", material), std::string::npos);
}

TEST(UsdString, EscapesQuotesAndBackslashes) { EXPECT_EQ(UsdString("a\"b\\c"), "\"a\\\"b\\\\c\""); }

TEST(UsdName, HoldsLettersDigitsAndUnderscoresAlone) {
  EXPECT_EQ(UsdName("mug_1"), "mug_1");
  EXPECT_EQ(UsdName("3-way.mug"), "_3_way_mug");
  EXPECT_EQ(UsdName(""), "_");
  EXPECT_EQ(UsdName("\xc3\xa4"), "__");  // two bytes of UTF-8
}

TEST(LinkName, LeavesOutWhatTheFormatKeepsForItself) {
  EXPECT_EQ(LinkName("mug-1"), "mug-1");
  EXPECT_EQ(LinkName("a::b"), "a_b");
  EXPECT_EQ(LinkName("world"), "world_object");
  EXPECT_EQ(LinkName("__model__"), "__model___object");
  EXPECT_EQ(LinkName("__model"), "__model");
}

}  // namespace
}  // namespace antigrasp
