#include <cmath>

#include "antigrasp/grasp_io/base_pose.h"
#include "antigrasp/grasp_io/grasp_hdf5.h"
#include "antigrasp/mesh/mass_properties.h"

namespace antigrasp {
namespace {

// A number of each grasp.
template <typename Value>
Hdf5Numbers OfEach(const GraspSet& set, const Value& value) {
  Hdf5Numbers numbers{{set.grasps.size()}, {}};
  for (const PosedGrasp& grasp : set.grasps) {
    numbers.values.push_back(static_cast<double>(value(grasp)));
  }
  return numbers;
}

Hdf5Numbers One(double value) { return {{}, {value}}; }

void WriteObject(const GraspSet& set, const GraspFileAbout& about, Hdf5Tree* tree) {
  const double s = set.metres_per_unit;
  const MassProperties mass = ComputeMassProperties(set.mesh);
  const double volume = std::pow(s, 3) * mass.volume;
  const Eigen::Vector3d center = s * mass.center;
  Hdf5Numbers inertia{{3, 3}, {}};
  for (int row = 0; row < 3; ++row) {
    for (int k = 0; k < 3; ++k) {
      inertia.values.push_back(about.density * std::pow(s, 5) * mass.inertia(row, k));
    }
  }
  tree->WriteText("/object/file", set.object);
  tree->Write("/object/scale", One(s));
  tree->Write("/object/com", {{3}, {center.x(), center.y(), center.z()}});
  tree->Write("/object/density", One(about.density));
  tree->Write("/object/friction", One(about.metric.friction));
  tree->Write("/object/inertia", inertia);
  tree->Write("/object/mass", One(about.density * volume));
  tree->Write("/object/volume", One(volume));
}

}  // namespace

void WriteAcronym(const std::filesystem::path& path, const GraspSet& set,
                  const GraspFileAbout& about) {
  const auto tree = Hdf5Tree::Create(path);
  Hdf5Numbers poses{{set.grasps.size(), 4, 4}, {}};
  const BaseFrame frame = ConventionFrame(about.metric);
  for (const PosedGrasp& grasp : set.grasps) {
    const Eigen::Matrix<double, 4, 4, Eigen::RowMajor> pose = BasePose(grasp, frame);
    poses.values.insert(poses.values.end(), pose.data(), pose.data() + pose.size());
  }
  tree->Write("/grasps/transforms", poses);
  const std::string bit = "/grasps/qualities/flex/object_in_gripper";
  tree->WriteWhole(bit, OfEach(set, [&](const PosedGrasp& g) { return about.Success(g) ? 1 : 0; }));
  tree->WriteTextAttribute(bit, "label", about.LabelText());
  const std::string own = "/grasps/qualities/antigrasp/";
  tree->WriteWhole(own + "candidate", OfEach(set, [](const PosedGrasp& g) { return g.candidate; }));
  tree->Write(own + "robust_quality", OfEach(set, [](const PosedGrasp& g) { return g.quality; }));
  tree->Write(own + "width", OfEach(set, [](const PosedGrasp& g) { return g.width; }));
  tree->WriteWhole(own + "executions",
                   OfEach(set, [](const PosedGrasp& g) { return g.executions; }));
  tree->WriteWhole(own + "held", OfEach(set, [](const PosedGrasp& g) { return g.held; }));
  tree->WriteText("/gripper/type", about.base.name);
  tree->Write("/gripper/configuration", {{1}, {0.5 * about.metric.jaw_opening}});
  WriteObject(set, about, tree.get());
  tree->Close();
}

}  // namespace antigrasp
