#include "antigrasp/quality/grasp_table.h"

#include <gtest/gtest.h>

#include <string>

namespace antigrasp {
namespace {

// A mesh in units of 250 mm: one grasp 0.5 units wide.
Graspability OneGrasp() {
  Graspability score;
  score.scale = 0.25;
  Grasp grasp;
  grasp.contacts[0] = {{0.25, 0.5, 0.75}, {-1, 0, 0}};
  grasp.contacts[1] = {{0.375, 0.5, 0.75}, {1, 0, 0}};
  grasp.axis = {1, 0, 0};
  grasp.width = 0.125;
  grasp.approach = {0, 0, -1};
  score.grasps.push_back({grasp, 0.0625, 1, 17});
  return score;
}

std::string TextIn(GraspFrame frame) {
  GraspTable table(frame);
  table.Add("mug", OneGrasp(), {2, 3, 4});
  return table.TakeText();
}

const std::string kHeader =
    "object,grasp,p1x,p1y,p1z,n1x,n1y,n1z,p2x,p2y,p2z,n2x,n2y,n2z,axis_x,axis_y,axis_z,width,"
    "robust_quality,approach_x,approach_y,approach_z,comx,comy,comz,in1x,in1y,in1z,in2x,in2y,in2z,"
    "metres_per_unit,candidate,frame\n";

TEST(GraspTable, IsInMetresAndSaysWhatMapsItBack) {
  EXPECT_EQ(TextIn(GraspFrame::kMetres),
            kHeader +
                "mug,0,0.25,0.5,0.75,-1,0,0,0.375,0.5,0.75,1,0,0,1,0,0,0.125,0.0625,0,0,-1,"
                "0.5,0.75,1,1,0,0,-1,-0,-0,0.25,17,metres\n");
}

// Directions have no length, qualities no unit.
TEST(GraspTable, InTheMeshsFrameHasItsLengths) {
  EXPECT_EQ(TextIn(GraspFrame::kMesh),
            kHeader +
                "mug,0,1,2,3,-1,0,0,1.5,2,3,1,0,0,1,0,0,0.5,0.0625,0,0,-1,"
                "2,3,4,1,0,0,-1,-0,-0,0.25,17,mesh\n");
}

}  // namespace
}  // namespace antigrasp
