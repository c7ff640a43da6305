// The same seed gives the same bytes whatever vectors the processor has: LibTorch, oneDNN and
// OpenBLAS choose their kernels by the processor, unless they are told.
#include <gtest/gtest.h>

#include <filesystem>

#include "antigrasp/core/atomic_file.h"
#include "tests/app/run_binary.h"
#include "tests/support/temp_folder.h"

namespace antigrasp {
namespace {

using cli::Shell;
using shapes::TempFolder;

constexpr const char* kAsTheProcessorIs =
    "env -u ATEN_CPU_CAPABILITY -u DNNL_MAX_CPU_ISA -u OPENBLAS_CORETYPE ";
constexpr const char* kCapped =
    "env ATEN_CPU_CAPABILITY=avx2 DNNL_MAX_CPU_ISA=AVX2 OPENBLAS_CORETYPE=Haswell ";

std::string BytesOf(const std::string& environment, const std::string& arguments,
                    const std::filesystem::path& file) {
  std::filesystem::remove(file);  // of the call before
  Shell(environment + ANTIGRASP_BINARY " " + arguments);
  return ReadFile(file);  // throws where the command left none
}

TEST(SameBytesCli, OfASampleWithAndWithoutAVX512) {
  const TempFolder folder;
  const std::string out = (folder / "a.h5").string();
  const std::string arguments = "sample cylinders-prior --count 2 --threads 1 --out " + out;
  const std::string free = BytesOf(kAsTheProcessorIs, arguments, out);
  EXPECT_TRUE(free == BytesOf(kCapped, arguments, out));
}

// Six updates and no episode: what the networks have learnt, and the scores of the prior set.
// Networks that young make no usable object, which ends the run when both files are there.
TEST(SameBytesCli, OfTrainedNetworksWithAndWithoutAVX512) {
  const TempFolder folder;
  const std::string run = (folder / "run").string();
  const std::string arguments =
      "train " ANTIGRASP_CONFIGS
      "/smoke.toml --overwrite --threads 1 --set prior.count=8 --set "
      "cem.prior_iterations=6 --set cem.episodes=0 --set cem.samples=4 --set cem.keep=2 --set "
      "cem.prior_scored=2 "
      "--set cem.compared=2 --set cem.control=false --set run.stl_count=0 --out " +
      run;
  const std::string free = BytesOf(kAsTheProcessorIs, arguments, run + "/checkpoint.pt");
  const std::string scores = ReadFile(run + "/prior_scores.csv");
  EXPECT_TRUE(free == BytesOf(kCapped, arguments, run + "/checkpoint.pt"));
  EXPECT_EQ(scores, ReadFile(run + "/prior_scores.csv"));
}

}  // namespace
}  // namespace antigrasp
