#include "tests/support/temp_folder.h"

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <system_error>

namespace antigrasp::shapes {

TempFolder::TempFolder() {
  std::string name = (std::filesystem::temp_directory_path() / "antigrasp-test-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) {
    throw std::runtime_error("cannot make a temporary folder like " + name);
  }
  path_ = name;
}

TempFolder::~TempFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

std::filesystem::path TempFolder::Write(const std::string& name, std::string_view bytes) const {
  const std::filesystem::path file = path_ / name;
  std::filesystem::create_directories(file.parent_path());
  std::ofstream out(file, std::ios::binary);
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (!out.flush()) throw std::runtime_error("cannot write " + file.string());
  return file;
}

int CountFiles(const std::filesystem::path& folder) {
  return static_cast<int>(std::distance(std::filesystem::recursive_directory_iterator(folder), {}));
}

std::map<std::string, std::string> FileContents(const std::filesystem::path& folder) {
  std::map<std::string, std::string> contents;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file()) continue;
    std::ifstream in(entry.path(), std::ios::binary);
    contents[std::filesystem::relative(entry.path(), folder).string()] = {
        std::istreambuf_iterator<char>(in), {}};
  }
  return contents;
}

}  // namespace antigrasp::shapes
