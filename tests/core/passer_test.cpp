#include "antigrasp/core/passer.h"

#include <gtest/gtest.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace antigrasp {
namespace {

struct Leaf {
  std::string name;
  double height = 0.0;
};
void PassFields(Passer& pass, Leaf& leaf) { pass(leaf.name, leaf.height); }

struct Tree {
  std::int16_t age = 0;
  std::vector<Leaf> leaves;
  std::array<Leaf, 2> roots;
  std::optional<Leaf> nest, owl;
  std::vector<float> rings;
};
void PassFields(Passer& pass, Tree& tree) {
  pass(tree.age, tree.leaves, tree.roots, tree.nest, tree.owl, tree.rings);
}

Tree Some() {
  return {-3,           {{"a", 1.5}, {"", 2.5}}, {Leaf{"l", 3.0}, Leaf{"r", 4.0}},
          std::nullopt, Leaf{"o", 5.0},          {0.5F, 0.25F}};
}

TEST(Passer, EveryFieldComesBackUnderItsOwnName) {
  const std::string bytes = PassedBytes(Some());
  // Lengths are of eight bytes, and what is there of one.
  EXPECT_EQ(bytes.size(),
            2U + (8U + 9U + 8U + 8U + 8U) + 2U * (9U + 8U) + 1U + (1U + 9U + 8U) + (8U + 8U));
  const Tree tree = FromPassed<Tree>(bytes);
  EXPECT_EQ(tree.age, -3);
  ASSERT_EQ(tree.leaves.size(), 2U);
  EXPECT_EQ(tree.leaves[0].name, "a");
  EXPECT_EQ(tree.leaves[0].height, 1.5);
  EXPECT_EQ(tree.leaves[1].name, "");
  EXPECT_EQ(tree.leaves[1].height, 2.5);
  EXPECT_EQ(tree.roots[0].name + tree.roots[1].name, "lr");
  EXPECT_EQ(tree.roots[1].height, 4.0);
  EXPECT_FALSE(tree.nest.has_value());
  ASSERT_TRUE(tree.owl.has_value());
  EXPECT_EQ(tree.owl->name, "o");
  EXPECT_EQ(tree.rings, (std::vector<float>{0.5F, 0.25F}));
}

TEST(Passer, RefusesWhatIsCutShortOrTooLong) {
  const std::string bytes = PassedBytes(Some());
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    EXPECT_THROW(FromPassed<Tree>(bytes.substr(0, size)), RuntimeFailure) << size;
  }
  EXPECT_THROW(FromPassed<Tree>(bytes + "x"), RuntimeFailure);
}

TEST(Passer, AFalseLengthTakesNoMemory) {
  const std::string length = PassedBytes(~std::uint64_t{0});
  EXPECT_THROW(FromPassed<std::string>(length + "x"), RuntimeFailure);
  EXPECT_THROW(FromPassed<std::vector<double>>(length + "12345678"), RuntimeFailure);
  EXPECT_THROW(FromPassed<std::vector<Leaf>>(length + "x"), RuntimeFailure);
}

}  // namespace
}  // namespace antigrasp
