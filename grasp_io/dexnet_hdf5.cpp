#include <cmath>

#include "antigrasp/grasp_io/grasp_hdf5.h"
#include "antigrasp/mesh/mass_properties.h"
#include "antigrasp/sdf/mesh_to_sdf.h"

namespace antigrasp {
namespace {

using Eigen::Vector3d;

const std::string kSet = "/datasets/antigrasp";

// A frame whose y is the axis: where Dex-Net's angles count from.
Vector3d AtAngleZero(const Vector3d& axis) {
  const Vector3d x(axis.y(), -axis.x(), 0.0);
  return x.norm() > 0.0 ? Vector3d(x.normalized()) : Vector3d(Vector3d::UnitX());
}

Hdf5Numbers Three(const Vector3d& v) { return {{3}, {v.x(), v.y(), v.z()}}; }

void WriteMesh(const std::string& path, const TriangleMesh& mesh, Hdf5Tree* tree) {
  Hdf5Numbers vertices{{mesh.vertices.size(), 3}, {}}, triangles{{mesh.faces.size(), 3}, {}};
  for (const Vector3d& v : mesh.vertices) {
    vertices.values.insert(vertices.values.end(), {v.x(), v.y(), v.z()});
  }
  for (const auto& face : mesh.faces) {
    for (const std::int32_t corner : face) triangles.values.push_back(corner);
  }
  tree->Write(path + "/mesh/vertices", vertices);
  tree->WriteWhole(path + "/mesh/triangles", triangles);
}

// Three cells of room on each side; values in metres, the index of x first.
void WriteDistances(const std::string& path, const TriangleMesh& mesh, Hdf5Tree* tree) {
  constexpr int kNodes = 32, kRoom = 3;
  const BoundingBox box = Bounds(mesh);
  const double step = box.Extent().maxCoeff() / (kNodes - 1 - 2 * kRoom);
  const Vector3d origin = 0.5 * (box.min + box.max) - Vector3d::Constant(0.5 * step * (kNodes - 1));
  SdfGrid grid{kNodes, step, origin, std::vector<float>(kNodes * kNodes * kNodes)};
  MeshToSdf(mesh, &grid);
  constexpr std::uint64_t kSide = kNodes;
  Hdf5Numbers values{{kSide, kSide, kSide}, {}};
  for (int x = 0; x < kNodes; ++x) {
    for (int y = 0; y < kNodes; ++y) {
      for (int z = 0; z < kNodes; ++z) values.values.push_back(-grid.values[grid.Index(x, y, z)]);
    }
  }
  tree->Write(path + "/sdf/data", values);
  tree->WriteAttribute(path + "/sdf", "origin", Three(origin));
  tree->WriteAttribute(path + "/sdf", "resolution", {{}, {step}});
}

}  // namespace

double DexNetAngle(const Vector3d& axis, const Vector3d& approach) {
  const Vector3d x = AtAngleZero(axis);
  return std::atan2(approach.dot(x.cross(axis)), approach.dot(x));
}

Vector3d DexNetApproach(const Vector3d& axis, double angle) {
  const Vector3d x = AtAngleZero(axis);
  return std::cos(angle) * x + std::sin(angle) * x.cross(axis);
}

DexNetFile::DexNetFile(const std::filesystem::path& path, const GraspFileAbout& about)
    : about_(about), tree_(Hdf5Tree::Create(path)) {
  const std::string metric = kSet + "/metrics/robust_ferrari_canny";
  tree_->Group(metric);
  const auto number = [&](const char* name, double value) {
    tree_->WriteAttribute(metric, name, {{}, {value}});
  };
  tree_->WriteTextAttribute(metric, "quality_method", "ferrari_canny_L1");
  number("friction_coef", about.metric.friction);
  number("torque_scaling", about.metric.torque_scale);
  tree_->WriteWholeAttribute(metric, "num_cone_faces", about.metric.cone_edges);
  tree_->WriteWholeAttribute(metric, "num_quality_samples", about.metric.num_draws);
  tree_->WriteWholeAttribute(metric, "soft_fingers",
                             about.metric.torsion == Torsion::kNone ? 0 : 1);
  tree_->Group(kSet + "/objects");
  tree_->WriteTextAttribute(kSet, "label", about.LabelText());
}

void DexNetFile::Add(const std::string& key, const GraspSet& set) {
  const std::string path = kSet + "/objects/" + key;
  for (const char* part : {"/mesh", "/sdf", "/stable_poses", "/rendered_images", "/sensor_data"}) {
    tree_->Group(path + part);
  }
  const TriangleMesh mesh = Transformed(set.mesh, set.metres_per_unit, Vector3d::Zero());
  tree_->WriteAttribute(path, "mass", {{}, {about_.density * ComputeMassProperties(mesh).volume}});
  tree_->WriteTextAttribute(path, "file", set.object);
  tree_->WriteAttribute(path, "metres_per_unit", {{}, {set.metres_per_unit}});
  WriteMesh(path, mesh, tree_.get());
  WriteDistances(path, mesh, tree_.get());
  tree_->WriteWholeAttribute(path + "/stable_poses", "num_stable_poses", 0);
  const std::string gripper = path + "/grasps/" + about_.base.name;
  tree_->Group(gripper);
  tree_->WriteWholeAttribute(gripper, "num_grasps", std::ssize(set.grasps));
  for (std::size_t i = 0; i < set.grasps.size(); ++i) {
    AddGrasp(gripper + "/grasp_" + std::to_string(i), set.grasps[i]);
  }
}

void DexNetFile::AddGrasp(const std::string& path, const PosedGrasp& grasp) {
  tree_->Group(path + "/metrics");
  const double width = about_.metric.jaw_opening, jaw = about_.metric.gripper.finger_width;
  tree_->WriteAttribute(
      path, "configuration",
      {{10},
       {grasp.center.x(), grasp.center.y(), grasp.center.z(), grasp.axis.x(), grasp.axis.y(),
        grasp.axis.z(), width, DexNetAngle(grasp.axis, grasp.approach), jaw, 0.0}});
  tree_->WriteTextAttribute(path, "frame", "object");
  tree_->WriteWholeAttribute(path, "id", static_cast<std::int64_t>(grasp.candidate));
  tree_->WriteTextAttribute(path, "type", "ParallelJawPtGrasp3D");
  const std::string metrics = path + "/metrics";
  tree_->WriteAttribute(metrics, "robust_ferrari_canny", {{}, {grasp.quality}});
  tree_->WriteAttribute(metrics, "success", {{}, {about_.Success(grasp) ? 1.0 : 0.0}});
  if (grasp.executions > 0) {
    const double held = static_cast<double>(grasp.held) / grasp.executions;
    tree_->WriteAttribute(metrics, "held", {{}, {held}});
  }
}

}  // namespace antigrasp
