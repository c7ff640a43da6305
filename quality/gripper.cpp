#include "antigrasp/quality/gripper.h"

namespace antigrasp {

void Bind(OptionTable* table, GripperModel* model) {
  GripperModel& m = *model;
  table->Add("gripper.palm_distance", &m.palm_distance, 0.0, 100.0,
             "from the palm to the grasp centre, m");
  table->Add("gripper.fingertip_overlap", &m.fingertip_overlap, 0.0, 100.0,
             "reach of the fingertips beyond the grasp centre, m");
  table->Add("gripper.finger_width", &m.finger_width, 0.0, 100.0,
             "finger size across grasp axis and approach, m");
  table->Add("gripper.finger_thickness", &m.finger_thickness, 0.0, 100.0,
             "finger size along the grasp axis, m");
  table->Add("gripper.palm_depth", &m.palm_depth, 0.0, 100.0, "palm size along the approach, m");
  table->Add("gripper.palm_length", &m.palm_length, 0.0, 100.0,
             "palm size along the grasp axis, m");
  table->Add("gripper.palm_width", &m.palm_width, 0.0, 100.0, "palm size across both, m");
  table->Add("gripper.approach_distance", &m.approach_distance, 0.0, 100.0,
             "length of the straight way in that must be free, m");
  table->Add("gripper.approach_angles", &m.approach_angles, 1, 10000,
             "approach angles tried per grasp, equally spaced about its axis");
}

std::array<BoundingBox, 3> GripperBoxes(const GripperModel& model, double opening, double retreat) {
  const double back = -model.palm_distance - retreat;
  const double tip = model.fingertip_overlap;
  const double inner = 0.5 * opening;
  const double outer = inner + model.finger_thickness;
  const double side = 0.5 * model.finger_width;
  const double half_length = 0.5 * model.palm_length;
  const double half_width = 0.5 * model.palm_width;
  return {BoundingBox{{back, -outer, -side}, {tip, -inner, side}},
          BoundingBox{{back, inner, -side}, {tip, outer, side}},
          BoundingBox{{back - model.palm_depth, -half_length, -half_width},
                      {-model.palm_distance, half_length, half_width}}};
}

TriangleMesh GripperMesh(const GripperModel& model, double opening) {
  // Corner i has its maximum in x, y, z by the bits of i; every side is split along a diagonal.
  constexpr std::array<std::array<std::int32_t, 3>, 12> kFaces = {{{0, 2, 1},
                                                                   {1, 2, 3},
                                                                   {4, 5, 6},
                                                                   {5, 7, 6},
                                                                   {0, 1, 4},
                                                                   {1, 5, 4},
                                                                   {2, 6, 3},
                                                                   {3, 6, 7},
                                                                   {0, 4, 2},
                                                                   {2, 4, 6},
                                                                   {1, 3, 5},
                                                                   {3, 7, 5}}};
  TriangleMesh mesh;
  for (const BoundingBox& box : GripperBoxes(model, opening, 0.0)) {
    const auto first = static_cast<std::int32_t>(mesh.vertices.size());
    for (int i = 0; i < 8; ++i) {
      mesh.vertices.emplace_back((i & 1) != 0 ? box.max.x() : box.min.x(),
                                 (i & 2) != 0 ? box.max.y() : box.min.y(),
                                 (i & 4) != 0 ? box.max.z() : box.min.z());
    }
    for (const auto& f : kFaces) mesh.faces.push_back({first + f[0], first + f[1], first + f[2]});
  }
  return mesh;
}

}  // namespace antigrasp
