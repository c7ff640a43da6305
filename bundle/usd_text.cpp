#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include "antigrasp/bundle/bundle_files.h"
#include "antigrasp/bundle/pinch_scene.h"
#include "antigrasp/bundle/simulator_names.h"
#include "antigrasp/bundle/usd_writer.h"
#include "antigrasp/core/format.h"

namespace antigrasp {
namespace {

using Eigen::Vector3d;

const std::vector<std::string> kBodySchemas{"PhysicsRigidBodyAPI", "PhysicsMassAPI"};

void AddMass(double mass, const Vector3d& center, const Eigen::Matrix3d& inertia, UsdWriter* usd) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(inertia);
  Eigen::Matrix3d axes = solver.eigenvectors();
  if (axes.determinant() < 0.0) axes.col(2) *= -1.0;
  const Eigen::Quaterniond turn(axes);
  usd->Line("point3f physics:centerOfMass = " + UsdTuple(center));
  usd->Line("float3 physics:diagonalInertia = " + UsdTuple(Vector3d(solver.eigenvalues())));
  usd->Line("float physics:mass = " + FormatDouble(mass));
  usd->Line("quatf physics:principalAxes = " + UsdTuple({turn.w(), turn.x(), turn.y(), turn.z()}));
}

// PhysX takes the smaller friction of a pair, unless the other material asks for the product or the
// larger one.
void AddMaterial(std::string_view name, double friction, UsdWriter* usd) {
  usd->Open("Material", name, {"PhysicsMaterialAPI", "PhysxMaterialAPI"});
  usd->Line("float physics:dynamicFriction = " + FormatDouble(friction));
  usd->Line("float physics:restitution = 0");
  usd->Line("float physics:staticFriction = " + FormatDouble(friction));
  usd->Line("uniform token physxMaterial:frictionCombineMode = \"min\"");
  usd->Close();
}

void BindMaterial(const std::string& path, UsdWriter* usd) {
  usd->Line("rel material:binding:physics = <" + path + ">");
}

const std::vector<std::string> kColliderSchemas{"PhysicsCollisionAPI", "MaterialBindingAPI"};

void AddPinchedBox(const PinchedBox& box, UsdWriter* usd) {
  usd->Open("Xform", box.name, kBodySchemas);
  AddMass(kBoxMass, Vector3d::Zero(), kBoxInertia * Eigen::Matrix3d::Identity(), usd);
  usd->Line("double3 xformOp:translate = " + UsdTuple(Vector3d(0.0, box.y, kPinchHeight)));
  usd->Line("uniform token[] xformOpOrder = [\"xformOp:translate\"]");
  usd->Open("Cube", "shape", kColliderSchemas);
  usd->Line("double size = " + FormatDouble(kBoxSide));
  BindMaterial("/self_check/friction_of_" + std::string(box.name), usd);
  usd->Close();
  usd->Close();
}

// A ball on a slide in the world, which a drive draws inward.
void AddSlidingBall(const PinchedBox& box, double side, UsdWriter* usd) {
  const std::string name = std::string(box.name) + (side < 0.0 ? "_left" : "_right");
  const Vector3d place(side * kBallAside, box.y, kPinchHeight);
  usd->Open("Xform", name, kBodySchemas);
  AddMass(kBallMass, Vector3d::Zero(), kBallInertia * Eigen::Matrix3d::Identity(), usd);
  usd->Line("double3 xformOp:translate = " + UsdTuple(place));
  usd->Line("uniform token[] xformOpOrder = [\"xformOp:translate\"]");
  usd->Open("Sphere", "shape", kColliderSchemas);
  usd->Line("double radius = " + FormatDouble(kBallRadius));
  BindMaterial("/self_check/friction_of_balls", usd);
  usd->Close();
  usd->Close();
  usd->Open("PhysicsPrismaticJoint", name + "_slide", {"PhysicsDriveAPI:linear"});
  usd->Line("uniform token physics:axis = \"X\"");
  usd->Line("rel physics:body1 = </self_check/" + name + ">");
  usd->Line("point3f physics:localPos0 = " + UsdTuple(place));
  usd->Line("point3f physics:localPos1 = (0, 0, 0)");
  usd->Line("quatf physics:localRot0 = (1, 0, 0, 0)");
  usd->Line("quatf physics:localRot1 = (1, 0, 0, 0)");
  usd->Line("float drive:linear:physics:damping = 0");
  usd->Line("float drive:linear:physics:stiffness = " + FormatDouble(kSpring));
  usd->Line("float drive:linear:physics:targetPosition = " + FormatDouble(-side * kSpringRest));
  usd->Line("uniform token drive:linear:physics:type = \"force\"");
  usd->Close();
}

}  // namespace

std::string UsdText(const ObjectBundle& bundle) {
  const std::string root = UsdName(bundle.name);
  UsdWriter usd(root, "written by antigrasp: the object's own axes; see README.md");
  usd.Open("Xform", root, kBodySchemas,
           {"assetInfo = {", "    string name = " + UsdString(bundle.name), "}",
            "kind = \"component\""});
  AddMass(bundle.mass, bundle.center, bundle.inertia, &usd);
  usd.Open("Mesh", "visual");
  usd.Triangles(bundle.mesh);
  usd.Close();
  for (std::size_t k = 0; k < bundle.parts.size(); ++k) {
    usd.Open("Mesh", "part_" + std::to_string(k),
             {"PhysicsCollisionAPI", "PhysicsMeshCollisionAPI", "MaterialBindingAPI"});
    usd.Line("uniform token physics:approximation = \"convexHull\"");
    usd.Line("uniform token purpose = \"guide\"");  // not drawn
    BindMaterial("/" + root + "/friction", &usd);
    usd.Triangles(bundle.parts[k].mesh);
    usd.Close();
  }
  AddMaterial("friction", bundle.friction, &usd);
  usd.Close();
  return usd.Take();
}

std::string UsdSelfCheck() {
  UsdWriter usd("self_check",
                "Two boxes of 30 g, each pinched at 1 N: within 2 s that of friction 0.14 falls "
                "and that of 0.16 stays (0.147 holds its weight)");
  usd.Open("Xform", "self_check");
  usd.Open("PhysicsScene", "physics");
  usd.Line("vector3f physics:gravityDirection = (0, 0, -1)");
  usd.Line("float physics:gravityMagnitude = 9.81");
  usd.Close();
  for (const PinchedBox& box : kPinchedBoxes) {
    AddPinchedBox(box, &usd);
    for (const double side : {-1.0, 1.0}) AddSlidingBall(box, side, &usd);
    AddMaterial("friction_of_" + std::string(box.name), box.friction, &usd);
  }
  AddMaterial("friction_of_balls", 1.0, &usd);
  usd.Close();
  return usd.Take();
}

}  // namespace antigrasp
