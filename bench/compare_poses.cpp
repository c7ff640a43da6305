#include <cmath>
#include <cstdio>

#include "antigrasp/mesh/stable_poses.h"
#include "bench/compare.h"
#include "bench/timing.h"
#include "tests/mesh/plain_rolling.h"
#include "tests/support/rippled_solid.h"

namespace antigrasp::bench {

// A solid with every vertex on its hull, against looking at every corner and facet for each step
// of a roll; and how the time grows from 6,000 to 100,000 faces.
void ComparePoses() {
  const TriangleMesh small = RippledSolid(39), middle = RippledSolid(80), large = RippledSolid(159);
  static std::size_t sink = 0;
  const auto ours = [](const TriangleMesh& mesh) {
    return [&mesh] { sink += StablePoses(mesh, CenterOfMass(mesh)).size(); };
  };
  const auto plain = [](const TriangleMesh& mesh) {
    return
        [&mesh] { sink += PlainRestingFacets(MakeFacetedHull(mesh, CenterOfMass(mesh))).size(); };
  };
  const std::vector<double> seconds = MedianSeconds({{"6,000 faces", ours(small)},
                                                     {"25,000 faces", ours(middle)},
                                                     {"100,000 faces", ours(large)},
                                                     {"plain, 6,000", plain(small)},
                                                     {"plain, 25,000", plain(middle)}},
                                                    3);
  PrintTime("poses_6000_faces", seconds[0]);
  PrintTime("poses_25000_faces", seconds[1]);
  PrintTime("poses_100000_faces", seconds[2]);
  const double faces = static_cast<double>(large.faces.size()) / double(small.faces.size());
  std::printf("poses: time grows as faces to the power %.2f\n",
              std::log(seconds[2] / seconds[0]) / std::log(faces));
  PrintRatio("poses_6000_faces_vs_all_corners", seconds[3] / seconds[0]);
  PrintRatio("poses_25000_faces_vs_all_corners", seconds[4] / seconds[1]);
}

}  // namespace antigrasp::bench
