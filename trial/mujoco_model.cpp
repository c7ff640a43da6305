#include "antigrasp/trial/mujoco_model.h"

#include <algorithm>
#include <array>

#include "antigrasp/core/check.h"

namespace antigrasp::mujoco {

Model Compile(const std::string& mjcf) {
  constexpr const char* kName = "trial.xml";
  const auto files = std::make_unique<mjVFS>();
  mj_defaultVFS(files.get());
#if mjVERSION_HEADER >= 313
  const int failed =
      mj_addBufferVFS(files.get(), kName, mjcf.data(), static_cast<int>(mjcf.size()));
#else
  const int failed = mj_makeEmptyFileVFS(files.get(), kName, static_cast<int>(mjcf.size()));
  if (failed == 0) {
    std::copy(mjcf.begin(), mjcf.end(), static_cast<char*>(files->filedata[files->nfile - 1]));
  }
#endif
  AG_CHECK(failed == 0, "room for one file in MuJoCo's file system");
  char error[1000] = "";
  Model model(mj_loadXML(kName, files.get(), error, sizeof error));
  mj_deleteVFS(files.get());
  AG_CHECK(model != nullptr, error);
  return model;
}

bool WentWrong(const mjData& data) {
  constexpr std::array kinds = {mjWARN_INERTIA, mjWARN_CONTACTFULL, mjWARN_CNSTRFULL,
                                mjWARN_BADQPOS, mjWARN_BADQVEL,     mjWARN_BADQACC};
  return std::any_of(kinds.begin(), kinds.end(),
                     [&](mjtWarning kind) { return data.warning[kind].number > 0; });
}

}  // namespace antigrasp::mujoco
