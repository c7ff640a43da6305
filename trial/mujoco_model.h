#pragma once

#include <mujoco/mujoco.h>

#include <memory>
#include <string>

// What differs between the versions of MuJoCo (2.2.2 to 3.x), and owners of its model and data.
namespace antigrasp::mujoco {

struct DeleteModel {
  void operator()(mjModel* model) const { mj_deleteModel(model); }
};
struct DeleteData {
  void operator()(mjData* data) const { mj_deleteData(data); }
};
using Model = std::unique_ptr<mjModel, DeleteModel>;
using Data = std::unique_ptr<mjData, DeleteData>;

// A model from MJCF text. A text that MuJoCo refuses is a broken invariant.
Model Compile(const std::string& mjcf);

// Whether a step met numbers that are no physics any more; MuJoCo then starts the data anew.
bool WentWrong(const mjData& data);

}  // namespace antigrasp::mujoco
