#include "antigrasp/doctor/library_versions.h"

#include <gtest/gtest.h>

namespace antigrasp {
namespace {

TEST(LibrariesText, TellsBothVersionsWhereTheyDiffer) {
  EXPECT_EQ(LibrariesText({{"Eigen", "3.4.0", ""},
                           {"HDF5", "1.10.8", "1.10.9"},
                           {"zlib", "1.2.13", "1.2.13"},
                           {"assimp", "", "5.2.5"}}),
            "Eigen 3.4.0, HDF5 1.10.9 (compiled against 1.10.8), zlib 1.2.13, assimp 5.2.5");
}

TEST(GeometryLibraries, AllTellAVersionOfThreeNumbers) {
  const std::vector<LibraryVersion> libraries = GeometryLibraries();
  EXPECT_GE(libraries.size(), 5u);
  for (const LibraryVersion& library : libraries) {
    int said = 0;
    for (const std::string& version : {library.compiled, library.linked}) {
      if (version.empty()) continue;
      ++said;
      EXPECT_TRUE(version.find_first_not_of("0123456789.") == std::string::npos ||
                  library.name == "CGAL")  // "5.6-I-123" between releases
          << library.name << " " << version;
    }
    EXPECT_GE(said, 1) << library.name;
  }
}

}  // namespace
}  // namespace antigrasp
