#include "antigrasp/datasets/prior_set.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "antigrasp/core/error.h"
#include "antigrasp/sdf/mesh_to_sdf.h"
#include "antigrasp/sdf/remesh.h"

namespace antigrasp {
namespace {

const char* const kKinds[] = {"cylinders", "prisms", "bottles"};

ShapeSet Make(const std::string& kind, int count, int threads = 2, std::uint64_t seed = 1,
              int resolution = 32) {
  return MakePriorSet({kind, count, seed, resolution, threads});
}

void ExpectSameGrids(const ShapeSet& a, const ShapeSet& b, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    EXPECT_EQ(a.grids[i].values, b.grids[i].values) << i;
    EXPECT_EQ(a.names[i], b.names[i]);
  }
}

TEST(PriorSet, ShapeDependsOnKindSeedAndIndexOnly) {
  for (const char* kind : kKinds) {
    const ShapeSet three = Make(kind, 3, 1, 1, 16), five = Make(kind, 5, 2, 1, 16);
    ExpectSameGrids(three, five, 3);
    EXPECT_NE(three.grids[0].values, three.grids[1].values);
    EXPECT_NE(three.grids[0].values, Make(kind, 1, 1, 2, 16).grids[0].values);
  }
  EXPECT_NE(Make("cylinders", 1).grids[0].values, Make("prisms", 1).grids[0].values);
}

TEST(PriorSet, EveryShapeRemeshesToASolidTwoCellsInsideTheCube) {
  for (const char* kind : kKinds) {
    for (const SdfGrid& grid : Make(kind, 20).grids) {
      const RemeshResult result = Remesh(grid);
      EXPECT_EQ(result.status, RemeshStatus::kOk);
      EXPECT_TRUE(result.report.IsSolid());
      const BoundingBox box = Bounds(result.mesh);
      EXPECT_LE(box.Extent().maxCoeff(), 28.0 / 32 + 0.02 / 32);
      EXPECT_GT(box.Extent().maxCoeff(), 0.45);
      EXPECT_LT(box.Center().cwiseAbs().maxCoeff(), 1.0 / 32);  // sharp tips lose part of a cell
    }
  }
}

TEST(PriorSet, VolumesAndMeshSizesAreThoseOfTheKind) {
  struct Expected {
    const char* kind;
    double low_volume, high_volume;
    std::size_t low_vertices, high_vertices;
  };
  for (const Expected& e :
       {Expected{"cylinders", 0.015, 0.16, 600, 2800}, Expected{"prisms", 0.06, 0.35, 1200, 4500},
        Expected{"bottles", 0.015, 0.25, 500, 3000}}) {
    for (const SdfGrid& grid : Make(e.kind, 10, 2, 3).grids) {
      const RemeshResult result = Remesh(grid, {.check_self_intersection = false});
      EXPECT_GT(result.report.volume, e.low_volume) << e.kind;
      EXPECT_LT(result.report.volume, e.high_volume) << e.kind;
      EXPECT_GT(result.mesh.vertices.size(), e.low_vertices) << e.kind;
      EXPECT_LT(result.mesh.vertices.size(), e.high_vertices) << e.kind;
    }
  }
}

// Distances grow by at most the length of the step, and outside the surface by nearly all of it.
TEST(PriorSet, ValuesAreDistances) {
  for (const char* kind : kKinds) {
    for (const SdfGrid& grid : Make(kind, 4).grids) {
      for (int z = 0; z < grid.n; ++z) {
        for (int y = 0; y < grid.n; ++y) {
          for (int x = 0; x + 1 < grid.n; ++x) {
            const double step =
                std::abs(grid.values[grid.Index(x, y, z)] - grid.values[grid.Index(x + 1, y, z)]);
            ASSERT_LE(step, grid.spacing * 1.02) << kind;
          }
        }
      }
    }
  }
}

TEST(PriorSet, ValuesAgreeWithTheDistanceToTheirOwnSurface) {
  for (const char* kind : kKinds) {
    const SdfGrid grid = Make(kind, 1).grids[0];
    SdfGrid again = grid;
    MeshToSdf(Remesh(grid).mesh, &again);
    double sum = 0.0;
    for (std::size_t i = 0; i < grid.values.size(); ++i) {
      const double difference = std::abs(grid.values[i] - again.values[i]);
      sum += difference;
      EXPECT_LT(difference, 0.8 * grid.spacing) << kind;  // the mesh bevels sharp edges
    }
    EXPECT_LT(sum / static_cast<double>(grid.values.size()), 0.15 * grid.spacing) << kind;
  }
}

TEST(PriorSet, BottlesAreSurfacesOfRevolution) {
  for (const SdfGrid& grid : Make("bottles", 6).grids) {
    for (int z = 0; z < grid.n; ++z) {
      for (int y = 0; y < grid.n; ++y) {
        for (int x = 0; x < grid.n; ++x) {
          const float value = grid.values[grid.Index(x, y, z)];
          ASSERT_EQ(value, grid.values[grid.Index(y, x, z)]);
          ASSERT_EQ(value, grid.values[grid.Index(grid.n - 1 - x, y, z)]);
        }
      }
    }
  }
}

// Every solid contains its large part, whose axis is z: long runs of inside nodes along z.
TEST(PriorSet, CylindersStandAlongZ) {
  for (const SdfGrid& grid : Make("cylinders", 10).grids) {
    int longest = 0;
    for (int y = 0; y < grid.n; ++y) {
      for (int x = 0; x < grid.n; ++x) {
        int run = 0;
        for (int z = 0; z < grid.n; ++z) run += grid.values[grid.Index(x, y, z)] > 0.0F;
        longest = std::max(longest, run);
      }
    }
    EXPECT_GE(longest, static_cast<int>(0.70 * 28) - 1);
  }
}

TEST(PriorSet, NamesCountFromZeroWithSixDigits) {
  const ShapeSet set = Make("prisms", 2);
  EXPECT_EQ(set.kind, "prisms");
  EXPECT_EQ(set.seed, 1U);
  EXPECT_EQ(set.truncation, 0.0);
  EXPECT_EQ(set.names, (std::vector<std::string>{"prisms-000000", "prisms-000001"}));
}

TEST(PriorSet, WithoutGraftsIsTheSameShapesLargePartsWhereTheyLie) {
  for (const char* kind : {"cylinders", "prisms"}) {
    const auto left = [&](int grafts) {
      return MakePriorSet({.kind = kind, .count = 3, .resolution = 16, .grafts = grafts});
    };
    const ShapeSet none = left(0), one = left(1), both = left(2);
    for (std::size_t i = 0; i < 3; ++i) {
      int inside[3] = {};
      for (std::size_t k = 0; k < both.grids[i].values.size(); ++k) {
        const float values[3] = {none.grids[i].values[k], one.grids[i].values[k],
                                 both.grids[i].values[k]};
        // A union's distance is at least that of every part.
        ASSERT_LE(values[0], values[1] + 2e-3F);  // cylinders have 64 sides in unions
        ASSERT_LE(values[1], values[2] + 1e-6F);
        for (std::size_t j = 0; j < 3; ++j) inside[j] += values[j] > 0.0F ? 1 : 0;
      }
      EXPECT_GT(inside[0], 0);
      EXPECT_LT(inside[0], inside[1]);
      EXPECT_LT(inside[1], inside[2]);
    }
    EXPECT_TRUE(none.provenance.ends_with(", grafts 0")) << none.provenance;
    EXPECT_TRUE(both.provenance.ends_with(", count 3")) << both.provenance;
  }
  EXPECT_THROW(MakePriorSet({.kind = "bottles", .count = 1, .grafts = 1}), InputError);
  EXPECT_THROW(MakePriorSet({.count = 1, .grafts = 3}), InputError);
}

TEST(PriorSet, OtherResolutionsWorkToo) {
  const ShapeSet set = Make("bottles", 2, 2, 1, 48);
  EXPECT_EQ(set.grids[0].n, 48);
  EXPECT_EQ(Remesh(set.grids[0]).status, RemeshStatus::kOk);
}

TEST(PriorSet, ReportsProgressForEveryShape) {
  std::int64_t last = 0;
  MakePriorSet({"bottles", 4, 1, 32, 1}, [&](std::int64_t done, std::int64_t total) {
    EXPECT_EQ(done, ++last);
    EXPECT_EQ(total, 4);
  });
  EXPECT_EQ(last, 4);
}

TEST(PriorSet, UnknownKindsAndSillyNumbersAreInputErrors) {
  EXPECT_THROW(Make("teapots", 1), InputError);
  EXPECT_THROW(Make("", 1), InputError);
  EXPECT_THROW(Make("bottles", 0), InputError);
  EXPECT_THROW(Make("bottles", 1, 1, 1, 8), InputError);
  EXPECT_THROW(Make("bottles", 1, 1, 1, 1024), InputError);
}

}  // namespace
}  // namespace antigrasp
