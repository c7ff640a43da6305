#include "antigrasp/bundle/bundle_files.h"
#include "antigrasp/bundle/simulator_names.h"
#include "antigrasp/bundle/xml_writer.h"
#include "antigrasp/core/format.h"

namespace antigrasp {
namespace {

void AddShape(std::string_view element, const std::string& file, XmlWriter* xml) {
  xml->Open(element);
  xml->Leaf("origin", {{"xyz", "0 0 0"}, {"rpy", "0 0 0"}});
  xml->Open("geometry");
  xml->Leaf("mesh", {{"filename", file}});
  xml->Close();
  xml->Close();
}

}  // namespace

std::string UrdfText(const ObjectBundle& bundle) {
  XmlWriter xml("written by antigrasp: metres, kilograms, the object's own axes; see README.md");
  const std::string name = LinkName(bundle.name);
  xml.Open("robot", {{"name", name}});
  xml.Open("link", {{"name", name}});
  xml.Open("inertial");
  xml.Leaf("origin", {{"xyz", NumbersText(bundle.center)}, {"rpy", "0 0 0"}});
  xml.Leaf("mass", {{"value", FormatDouble(bundle.mass)}});
  const Eigen::Matrix3d& i = bundle.inertia;
  xml.Leaf("inertia", {{"ixx", FormatDouble(i(0, 0))},
                       {"ixy", FormatDouble(i(0, 1))},
                       {"ixz", FormatDouble(i(0, 2))},
                       {"iyy", FormatDouble(i(1, 1))},
                       {"iyz", FormatDouble(i(1, 2))},
                       {"izz", FormatDouble(i(2, 2))}});
  xml.Close();
  AddShape("visual", bundle.name + ".stl", &xml);
  for (std::size_t k = 0; k < bundle.parts.size(); ++k) {
    AddShape("collision", bundle.PartName(k) + ".stl", &xml);
  }
  // Bullet's own element; other readers pass over it.
  xml.Open("contact");
  xml.Leaf("lateral_friction", {{"value", FormatDouble(bundle.friction)}});
  xml.Close();
  xml.Close();
  xml.Close();
  return xml.Take();
}

}  // namespace antigrasp
