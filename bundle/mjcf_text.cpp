#include <cstdio>

#include "antigrasp/bundle/bundle_files.h"
#include "antigrasp/bundle/xml_writer.h"
#include "antigrasp/core/format.h"

namespace antigrasp {
namespace {

constexpr double kPinch = 1.0;                       // N
constexpr double kBox = 0.04, kBall = 0.005;         // m
constexpr double kBoxMass = 0.03, kBallMass = 0.05;  // kg

void AddPinch(const std::string& name, double y, const std::string& friction, XmlWriter* xml) {
  const double out = 0.5 * kBox + kBall;
  xml->Open("body", {{"name", name}, {"pos", NumbersText({0.0, y, 0.3})}});
  xml->Leaf("freejoint", {});
  xml->Leaf("geom", {{"name", name},
                     {"type", "box"},
                     {"size", NumbersText({0.5 * kBox, 0.5 * kBox, 0.5 * kBox})},
                     {"mass", FormatDouble(kBoxMass)},
                     {"priority", "1"},
                     {"friction", friction}});
  xml->Close();
  for (const double side : {-1.0, 1.0}) {
    const std::string ball = name + (side < 0.0 ? "_left" : "_right");
    xml->Open("body", {{"name", ball}, {"pos", NumbersText({side * out, y, 0.3})}});
    // A soft spring a metre away from rest: 1 N, and no actuator to be set.
    xml->Leaf("joint", {{"name", ball},
                        {"type", "slide"},
                        {"axis", NumbersText({-side, 0.0, 0.0})},
                        {"stiffness", FormatDouble(kPinch)},
                        {"springref", "1"}});
    xml->Leaf("geom", {{"name", ball},
                       {"type", "sphere"},
                       {"size", FormatDouble(kBall)},
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
  xml.Open("body", {{"name", bundle.name}});
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
  AddPinch("falls", -0.1, "0.14", &xml);
  AddPinch("stays", 0.1, "0.16", &xml);
  xml.Close();
  xml.Close();
  return xml.Take();
}

}  // namespace antigrasp
