#include "antigrasp/bundle/bundle_files.h"

namespace antigrasp {

std::vector<TextFile> TextFiles(const ObjectBundle& bundle, BundleTarget target) {
  std::vector<TextFile> files{{"README.md", BundleReadme(bundle, target)}};
  if (IsFor(target, BundleTarget::kMujoco)) {
    files.push_back({bundle.name + ".xml", MjcfText(bundle)});
    files.push_back({"self_check.xml", MjcfSelfCheck()});
  }
  if (IsFor(target, BundleTarget::kUrdf)) {
    files.push_back({bundle.name + ".urdf", UrdfText(bundle)});
    files.push_back({"self_check_bullet.py", BulletSelfCheck()});
  }
  if (IsFor(target, BundleTarget::kSdformat)) {
    files.push_back({"model.config", SdformatConfig(bundle)});
    files.push_back({"model.sdf", SdformatText(bundle)});
    files.push_back({"self_check.sdf", SdformatSelfCheck()});
  }
  if (IsFor(target, BundleTarget::kUsd)) {
    files.push_back({bundle.name + ".usda", UsdText(bundle)});
    files.push_back({"self_check.usda", UsdSelfCheck()});
  }
  return files;
}

}  // namespace antigrasp
