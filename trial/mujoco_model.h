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

// What a collision function is given to read and to fill: not the same types in every version.
template <typename Function>
struct CollisionTypes;
template <typename D, typename C>
struct CollisionTypes<int (*)(const mjModel*, D, C*, int, int, mjtNum)> {
  using Data = D;
  using Contact = C;
};
using CollisionData = CollisionTypes<mjfCollision>::Data;
using CollisionContact = CollisionTypes<mjfCollision>::Contact;

// Sets the normal of a contact; MuJoCo completes the frame.
template <typename Contact>
void SetNormal(const mjtNum* normal, Contact* contact) {
  if constexpr (requires { contact->frame; }) {
    mju_copy3(contact->frame, normal);
    mju_zero3(contact->frame + 3);
  } else {
    mju_copy3(contact->normal, normal);
    mju_zero3(contact->tangent);
  }
}

// A model from MJCF text. A text that MuJoCo refuses is a broken invariant.
Model Compile(const std::string& mjcf);

// Whether a step met numbers that are no physics any more; MuJoCo then starts the data anew.
bool WentWrong(const mjData& data);

}  // namespace antigrasp::mujoco
