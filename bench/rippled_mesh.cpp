// bench_mesh RINGS FILE: writes the solid of 4 RINGS (RINGS - 1) faces that docs/performance.md
// gives the times of commands for.
#include <cstdio>
#include <cstdlib>

#include "antigrasp/mesh/mesh_file.h"
#include "tests/support/rippled_solid.h"

int main(int argc, char** argv) {
  const int rings = argc == 3 ? std::atoi(argv[1]) : 0;
  if (rings < 3) {
    std::fprintf(stderr, "bench_mesh RINGS FILE, at least 3 rings\n");
    return 2;
  }
  antigrasp::WriteMesh(argv[2], antigrasp::RippledSolid(rings));
  return 0;
}
