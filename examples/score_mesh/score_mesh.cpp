// Scores one mesh file (STL, OBJ, PLY, OFF): score_mesh MESH
#include <antigrasp/mesh/mesh_file.h>
#include <antigrasp/mesh/repair.h>
#include <antigrasp/quality/graspability.h>

#include <cstdio>
#include <exception>

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: score_mesh MESH\n");
    return 2;
  }
  try {
    const antigrasp::RepairResult solid = antigrasp::Repair(antigrasp::ReadMesh(argv[1]));
    if (!solid.refusal.empty()) {
      std::fprintf(stderr, "%s: %s\n", argv[1], solid.refusal.c_str());
      return 1;
    }
    const antigrasp::MetricOptions options;  // 75th percentile of 100 grasps x 25 draws
    const auto score =
        antigrasp::EvaluateGraspability(solid.mesh, options, /*seed=*/1, /*object=*/0);
    std::printf("graspability %.5f (95 %%: %.5f to %.5f) from %zu grasps\n", score.value,
                score.ci_low, score.ci_high, score.grasps.size());
  } catch (const std::exception& error) {
    std::fprintf(stderr, "score_mesh: %s\n", error.what());
    return 2;
  }
}
