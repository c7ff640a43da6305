#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>

namespace antigrasp::shapes {

// A new, empty folder of its own, removed with everything in it when the object goes.
class TempFolder {
 public:
  TempFolder();
  ~TempFolder();
  TempFolder(const TempFolder&) = delete;
  TempFolder& operator=(const TempFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

  // Writes `bytes` to path() / name, making the folders on the way; returns the full path.
  std::filesystem::path Write(const std::string& name, std::string_view bytes) const;

 private:
  std::filesystem::path path_;
};

// Files and folders in it, those of folders too.
int CountFiles(const std::filesystem::path& folder);
// Every file under the folder, by its path from there, with its bytes.
std::map<std::string, std::string> FileContents(const std::filesystem::path& folder);

}  // namespace antigrasp::shapes
