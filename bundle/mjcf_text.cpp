#include "antigrasp/bundle/bundle_files.h"
#include "antigrasp/bundle/pinch_scene.h"
#include "antigrasp/bundle/simulator_names.h"
#include "antigrasp/bundle/xml_writer.h"
#include "antigrasp/core/format.h"

namespace antigrasp {
namespace {

void AddPinch(const PinchedBox& box, XmlWriter* xml) {
  const std::string name = box.name;
  const double half = 0.5 * kBoxSide;
  xml->Open("body", {{"name", name}, {"pos", NumbersText({0.0, box.y, kPinchHeight})}});
  xml->Leaf("freejoint", {});
  xml->Leaf("geom", {{"name", name},
                     {"type", "box"},
                     {"size", NumbersText({half, half, half})},
                     {"mass", FormatDouble(kBoxMass)},
                     {"priority", "1"},
                     {"friction", FormatDouble(box.friction)}});
  xml->Close();
  for (const double side : {-1.0, 1.0}) {
    const std::string ball = name + (side < 0.0 ? "_left" : "_right");
    xml->Open("body",
              {{"name", ball}, {"pos", NumbersText({side * kBallAside, box.y, kPinchHeight})}});
    xml->Leaf("joint", {{"name", ball},
                        {"type", "slide"},
                        {"axis", NumbersText({-side, 0.0, 0.0})},
                        {"stiffness", FormatDouble(kSpring)},
                        {"springref", FormatDouble(kSpringRest)}});
    xml->Leaf("geom", {{"name", ball},
                       {"type", "sphere"},
                       {"size", FormatDouble(kBallRadius)},
                       {"mass", FormatDouble(kBallMass)}});
    xml->Close();
  }
}

}  // namespace

std::string MjcfText(const ObjectBundle& bundle) {
  XmlWriter xml("written by antigrasp: metres, kilograms, the object's own axes; see README.md");
  xml.Open("mujoco", {{"model", bundle.name}});
  xml.Open("asset");
  xml.Leaf("mesh", {{"name", bundle.name}, {"file", bundle.name + ".stl"}});
  for (std::size_t i = 0; i < bundle.parts.size(); ++i) {
    xml.Leaf("mesh", {{"name", bundle.PartName(i)}, {"file", bundle.PartName(i) + ".stl"}});
  }
  xml.Close();
  xml.Open("worldbody");
  xml.Open("body", {{"name", LinkName(bundle.name)}});
  xml.Leaf("freejoint", {});
  const Eigen::Matrix3d& i = bundle.inertia;
  xml.Leaf("inertial",
           {{"pos", NumbersText(bundle.center)},
            {"mass", FormatDouble(bundle.mass)},
            {"fullinertia", NumbersText({i(0, 0), i(1, 1), i(2, 2), i(0, 1), i(0, 2), i(1, 2)})}});
  xml.Leaf("geom", {{"type", "mesh"},
                    {"mesh", bundle.name},
                    {"group", "2"},
                    {"contype", "0"},
                    {"conaffinity", "0"}});
  for (std::size_t k = 0; k < bundle.parts.size(); ++k) {
    xml.Leaf("geom", {{"type", "mesh"},
                      {"mesh", bundle.PartName(k)},
                      {"group", "3"},
                      {"priority", "1"},
                      {"friction", FormatDouble(bundle.friction)}});
  }
  xml.Close();
  xml.Close();
  xml.Close();
  return xml.Take();
}

std::string MjcfSelfCheck() {
  XmlWriter xml(
      "Two boxes of 30 g, each pinched at 1 N: within 2 s that of friction 0.14 falls and that of "
      "0.16 stays (0.147 holds its weight)");
  xml.Open("mujoco", {{"model", "self_check"}});
  // Without noslip MuJoCo creeps; with it the limit is right for the elliptic cone alone.
  xml.Leaf("option", {{"cone", "elliptic"}, {"noslip_iterations", "10"}});
  xml.Open("worldbody");
  for (const PinchedBox& box : kPinchedBoxes) AddPinch(box, &xml);
  xml.Close();
  xml.Close();
  return xml.Take();
}

}  // namespace antigrasp
