#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "antigrasp/datasets/hdf5_tree.h"
#include "antigrasp/grasp_io/grasp_set.h"
#include "antigrasp/quality/given_grasps.h"

// Grasps in HDF5: ACRONYM's, one object a file, and Dex-Net's, which holds any number.
namespace antigrasp {

// Both write `path`, which is whole when the call returns, or after Close().
void WriteAcronym(const std::filesystem::path& path, const GraspSet& set,
                  const GraspFileAbout& about);

// A Dex-Net 2.0 database of one dataset, "antigrasp".
class DexNetFile {
 public:
  DexNetFile(const std::filesystem::path& path, const GraspFileAbout& about);
  // `key`: the object's name in it, no two alike. With the mesh and its signed distances on a grid
  // of 32 nodes a side (negative inside, as Dex-Net's), metres.
  void Add(const std::string& key, const GraspSet& set);
  void Close() { tree_->Close(); }

 private:
  void AddGrasp(const std::string& path, const PosedGrasp& grasp);

  GraspFileAbout about_;
  std::unique_ptr<Hdf5Tree> tree_;
};

// Dex-Net's angle of an approach about the axis, and back (its grasping/grasp.py): the approach of
// angle 0 is (axis.y, -axis.x, 0), or x where the axis is z.
double DexNetAngle(const Eigen::Vector3d& axis, const Eigen::Vector3d& approach);
Eigen::Vector3d DexNetApproach(const Eigen::Vector3d& axis, double angle);

// Either of them. InputError for what is no HDF5, neither of the two or without grasps, for a
// damaged array and for another gripper.
std::vector<GivenGrasp> ReadHdf5Grasps(const std::string& path, const GripperBase& base,
                                       const MetricOptions& metric);

}  // namespace antigrasp
