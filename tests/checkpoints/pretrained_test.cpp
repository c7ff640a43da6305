#include "antigrasp/checkpoints/pretrained.h"

#include <gtest/gtest.h>
#include <torch/types.h>

#include <cstdlib>
#include <filesystem>

#include "antigrasp/checkpoints/checkpoint.h"
#include "antigrasp/core/atomic_file.h"
#include "antigrasp/core/error.h"
#include "tests/support/temp_folder.h"

namespace antigrasp {
namespace {

const std::vector<std::string> kNames = {
    "bottles-adversarial",   "bottles-prior",   "bottles-solids",
    "cylinders-adversarial", "cylinders-prior", "cylinders-solids",
    "prisms-adversarial",    "prisms-prior",    "prisms-solids"};

TEST(Pretrained, NamesAreThoseOfTheFilesInOrder) { EXPECT_EQ(PretrainedNames(), kNames); }

TEST(Pretrained, EachNameIsItsOwnFileOfHalfPrecisionNetworks) {
  for (const std::string& name : kNames) {
    const std::filesystem::path file = FindNetworks(name);
    EXPECT_EQ(file.filename(), name + ".pt");
    EXPECT_EQ(file.parent_path().filename(), "pretrained");
    const Checkpoint checkpoint = ReadCheckpoint(file);
    const std::string shapes = name.substr(0, name.find('-'));
    EXPECT_NE(checkpoint.config.find(shapes), std::string::npos) << name;
    const std::string last = name.ends_with("solids") ? "layer4/weight" : "last_weight";
    const torch::Tensor* const weight = FindTensor(checkpoint.networks, "average/" + last);
    const torch::Tensor* const progress = FindTensor(checkpoint.networks, "progress");
    ASSERT_TRUE(weight != nullptr && progress != nullptr) << name;
    EXPECT_EQ(weight->scalar_type(), torch::kHalf) << name;
    EXPECT_EQ(progress->scalar_type(), torch::kLong) << name;
    // Episode 0 is trained on the set itself; later ones on what is hard to grasp.
    EXPECT_EQ((*progress)[0].item<std::int64_t>() > 0, name.ends_with("adversarial")) << name;
  }
}

TEST(Pretrained, APathGoesBeforeANameAndAFolderIsARun) {
  const shapes::TempFolder folder;
  EXPECT_EQ(FindNetworks(folder.path().string()), folder.path() / "checkpoint.pt");
  WriteFileAtomic(folder / "bottles-prior", "mine");
  EXPECT_EQ(FindNetworks((folder / "bottles-prior").string()), folder / "bottles-prior");
}

TEST(Pretrained, AreLookedForInTheFolderGivenThenInTheEnvironmentsThenWhereTheyShip) {
  const shapes::TempFolder folder;
  folder.Write("given/cylinders-prior.pt", "given");
  folder.Write("named/cylinders-prior.pt", "named");
  folder.Write("named/mugs-prior.pt", "named");
  setenv("ANTIGRASP_PRETRAINED", (folder / "named").c_str(), 1);
  const std::vector<std::string> names = PretrainedNames();
  const auto given = FindNetworks("cylinders-prior", folder / "given");
  const auto named = FindNetworks("cylinders-prior");
  const auto ships = FindNetworks("prisms-prior", folder / "given");
  unsetenv("ANTIGRASP_PRETRAINED");
  EXPECT_EQ(given, folder / "given/cylinders-prior.pt");
  EXPECT_EQ(named, folder / "named/cylinders-prior.pt");
  EXPECT_EQ(ships, FindNetworks("prisms-prior"));
  EXPECT_EQ(names.size(), kNames.size() + 1);
  EXPECT_NE(FindNetworks("cylinders-prior"), named);
}

TEST(Pretrained, AnUnknownNameIsRefusedWithThoseThatThereAre) {
  try {
    FindNetworks("cups-prior");
    FAIL() << "found";
  } catch (const InputError& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find("cups-prior"), std::string::npos) << message;
    EXPECT_NE(message.find("bottles-solids, cylinders-adversarial"), std::string::npos) << message;
  }
}

}  // namespace
}  // namespace antigrasp
