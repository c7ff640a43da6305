#include "antigrasp/bundle/bundle_files.h"
#include "antigrasp/bundle/pinch_scene.h"
#include "antigrasp/bundle/simulator_names.h"
#include "antigrasp/bundle/xml_writer.h"
#include "antigrasp/core/format.h"

namespace antigrasp {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr const char* kVersion = "1.9";

std::string PoseText(const Vector3d& place) { return NumbersText(place) + " 0 0 0"; }

void AddInertial(double mass, const Vector3d& center, const Matrix3d& i, XmlWriter* xml) {
  xml->Open("inertial");
  xml->Text("pose", PoseText(center));
  xml->Text("mass", FormatDouble(mass));
  xml->Open("inertia");
  xml->Text("ixx", FormatDouble(i(0, 0)));
  xml->Text("ixy", FormatDouble(i(0, 1)));
  xml->Text("ixz", FormatDouble(i(0, 2)));
  xml->Text("iyy", FormatDouble(i(1, 1)));
  xml->Text("iyz", FormatDouble(i(1, 2)));
  xml->Text("izz", FormatDouble(i(2, 2)));
  xml->Close();
  xml->Close();
}

// In the terms of every engine that Gazebo has: the smaller (DART, ODE) or the product (Bullet) of
// a pair, both that of the object beside a friction of 1.
void AddFriction(double friction, XmlWriter* xml) {
  const std::string text = FormatDouble(friction);
  xml->Open("surface");
  xml->Open("friction");
  xml->Open("ode");
  xml->Text("mu", text);
  xml->Text("mu2", text);
  xml->Close();
  xml->Open("bullet");
  xml->Text("friction", text);
  xml->Text("friction2", text);
  xml->Close();
  xml->Close();
  xml->Close();
}

void AddMesh(const std::string& file, XmlWriter* xml) {
  xml->Open("geometry");
  xml->Open("mesh");
  xml->Text("uri", file);
  xml->Close();
  xml->Close();
}

enum class Shape { kBox, kBall };

void AddPrimitive(Shape shape, XmlWriter* xml) {
  xml->Open("geometry");
  if (shape == Shape::kBox) {
    xml->Open("box");
    xml->Text("size", NumbersText({kBoxSide, kBoxSide, kBoxSide}));
  } else {
    xml->Open("sphere");
    xml->Text("radius", FormatDouble(kBallRadius));
  }
  xml->Close();
  xml->Close();
}

void AddShapeLink(const std::string& name, Shape shape, const Vector3d& place, double friction,
                  XmlWriter* xml) {
  const bool box = shape == Shape::kBox;
  xml->Open("link", {{"name", name}});
  xml->Text("pose", PoseText(place));
  const Matrix3d inertia = (box ? kBoxInertia : kBallInertia) * Matrix3d::Identity();
  AddInertial(box ? kBoxMass : kBallMass, Vector3d::Zero(), inertia, xml);
  xml->Open("visual", {{"name", "visual"}});
  AddPrimitive(shape, xml);
  xml->Close();
  xml->Open("collision", {{"name", "collision"}});
  AddPrimitive(shape, xml);
  AddFriction(friction, xml);
  xml->Close();
  xml->Close();
}

void AddBall(const PinchedBox& box, double side, XmlWriter* xml) {
  const std::string name = std::string(box.name) + (side < 0.0 ? "_left" : "_right");
  AddShapeLink(name, Shape::kBall, {side * kBallAside, box.y, kPinchHeight}, 1.0, xml);
  xml->Open("joint", {{"name", name + "_slide"}, {"type", "prismatic"}});
  xml->Text("parent", "world");
  xml->Text("child", name);
  xml->Open("axis");
  xml->Text("xyz", NumbersText({-side, 0.0, 0.0}));
  xml->Open("dynamics");
  xml->Text("spring_reference", FormatDouble(kSpringRest));
  xml->Text("spring_stiffness", FormatDouble(kSpring));
  xml->Close();
  xml->Close();
  xml->Close();
}

}  // namespace

std::string SdformatText(const ObjectBundle& bundle) {
  XmlWriter xml("written by antigrasp: metres, kilograms, the object's own axes; see README.md");
  xml.Open("sdf", {{"version", kVersion}});
  xml.Open("model", {{"name", LinkName(bundle.name)}});
  xml.Open("link", {{"name", "body"}});
  AddInertial(bundle.mass, bundle.center, bundle.inertia, &xml);
  xml.Open("visual", {{"name", "visual"}});
  AddMesh(bundle.name + ".stl", &xml);
  xml.Close();
  for (std::size_t k = 0; k < bundle.parts.size(); ++k) {
    xml.Open("collision", {{"name", "part_" + std::to_string(k)}});
    AddMesh(bundle.PartName(k) + ".stl", &xml);
    AddFriction(bundle.friction, &xml);
    xml.Close();
  }
  xml.Close();
  xml.Close();
  xml.Close();
  return xml.Take();
}

std::string SdformatConfig(const ObjectBundle& bundle) {
  XmlWriter xml("written by antigrasp");
  xml.Open("model");
  xml.Text("name", LinkName(bundle.name));
  xml.Text("version", "1.0");
  xml.Text("sdf", "model.sdf", {{"version", kVersion}});
  xml.Text("description", "metres, kilograms, the object's own axes; see README.md");
  xml.Close();
  return xml.Take();
}

std::string SdformatSelfCheck() {
  XmlWriter xml(
      "Two boxes of 30 g, each pinched at 1 N: within 2 s that of friction 0.14 falls and that of "
      "0.16 stays (0.147 holds its weight)");
  xml.Open("sdf", {{"version", kVersion}});
  xml.Open("world", {{"name", "self_check"}});
  xml.Text("gravity", NumbersText({0.0, 0.0, -9.81}));
  for (const PinchedBox& box : kPinchedBoxes) {
    xml.Open("model", {{"name", box.name}});
    AddShapeLink("body", Shape::kBox, {0.0, box.y, kPinchHeight}, box.friction, &xml);
    xml.Close();
  }
  xml.Open("model", {{"name", "balls"}});
  for (const PinchedBox& box : kPinchedBoxes) {
    for (const double side : {-1.0, 1.0}) AddBall(box, side, &xml);
  }
  xml.Close();
  xml.Close();
  xml.Close();
  return xml.Take();
}

}  // namespace antigrasp
