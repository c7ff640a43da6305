#include "antigrasp/datasets/object_names.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>
#include <utility>

#include "antigrasp/core/rng.h"
#include "antigrasp/mesh/mesh_file.h"

namespace antigrasp {
namespace {

namespace fs = std::filesystem;

// "mug", ".stl"; all of it and nothing for what is no mesh file.
std::pair<std::string, std::string> StemAndExtension(const std::string& name) {
  if (!IsMeshFile(name)) return {name, ""};
  const std::string extension = fs::path(name).extension().string();
  return {name.substr(0, name.size() - extension.size()), extension};
}

std::vector<std::string> FoldersOf(const fs::path& folder) {
  std::vector<std::string> parts;
  for (const fs::path& part : fs::absolute(folder).lexically_normal().relative_path()) {
    if (!part.empty()) parts.push_back(part.string());
  }
  return parts;
}

// An object on its way to a name of its own: one folder after the other is added, each time first
// with the extension as it is and then with the extension written out.
class Candidate {
 public:
  explicit Candidate(const ObjectOrigin& origin)
      : origin_(&origin), name_(origin.name.empty() ? "unnamed" : origin.name) {}

  std::string Name() const {
    if (!written_out_) return name_;
    const auto [stem, extension] = StemAndExtension(name_);
    return stem + "_" + extension.substr(1);
  }

  // False when there is nothing more to add.
  bool Longer() {
    if (!written_out_ && !StemAndExtension(name_).second.empty()) {
      written_out_ = true;
      return true;
    }
    if (folders_.empty() && added_ == 0) folders_ = FoldersOf(origin_->folder);
    if (added_ == folders_.size()) return false;
    name_ = folders_[folders_.size() - ++added_] + "/" + name_;
    written_out_ = false;
    return true;
  }

  // The `number`th object of this origin.
  std::string Numbered(int number) const {
    const auto [stem, extension] = StemAndExtension(Candidate(*origin_).name_);
    return number == 1 ? stem + extension : stem + "_" + std::to_string(number) + extension;
  }

 private:
  const ObjectOrigin* origin_;
  std::string name_;
  bool written_out_ = false;
  std::vector<std::string> folders_;  // known once they are needed
  std::size_t added_ = 0;
};

using Places = std::map<std::string, std::vector<std::size_t>>;  // objects by file name

Places PlacesOf(const std::vector<Candidate>& candidates) {
  Places places;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    places[FileNameOf(candidates[i].Name())].push_back(i);
  }
  return places;
}

// Whether the names are good as they are; nearly always, and with little memory.
bool AreApart(const std::vector<ObjectOrigin>& objects) {
  std::vector<std::string> files;
  for (const ObjectOrigin& object : objects) files.push_back(FileNameOf(object.name));
  std::sort(files.begin(), files.end());
  return files.empty() ||
         (!files.front().empty() && std::adjacent_find(files.begin(), files.end()) == files.end());
}

}  // namespace

std::string FileNameOf(const std::string& object_name) {
  std::string name = StemAndExtension(object_name).first;
  std::replace(name.begin(), name.end(), '/', '_');
  return name;
}

std::uint64_t StreamOf(const std::string& object_name) {
  const std::size_t slash = object_name.rfind('/');
  const std::string last = slash == std::string::npos ? object_name : object_name.substr(slash + 1);
  const auto [stem, extension] = StemAndExtension(last);
  if (!extension.empty()) return HashOf(stem);
  const std::size_t bar = stem.rfind('_');  // "mug_stl", as DistinctNames writes it out
  const bool written_out = bar != std::string::npos && bar > 0 &&
                           IsMeshFile(stem.substr(0, bar) + "." + stem.substr(bar + 1));
  return HashOf(written_out ? stem.substr(0, bar) : stem);
}

std::vector<std::string> DistinctNames(const std::vector<ObjectOrigin>& objects) {
  std::vector<std::string> names(objects.size());
  if (AreApart(objects)) {
    std::transform(objects.begin(), objects.end(), names.begin(),
                   [](const ObjectOrigin& object) { return object.name; });
    return names;
  }
  std::vector<Candidate> candidates(objects.begin(), objects.end());
  Places places;
  for (bool longer = true; longer;) {
    longer = false;
    places = PlacesOf(candidates);
    for (const auto& [file, sharers] : places) {
      if (sharers.size() == 1) continue;
      for (const std::size_t i : sharers) longer |= candidates[i].Longer();
    }
  }
  std::set<std::string> taken;
  std::vector<std::size_t> same;  // as another one to the last folder
  for (const auto& [file, sharers] : places) {
    if (sharers.size() == 1) {
      names[sharers.front()] = candidates[sharers.front()].Name();
      taken.insert(file);
    } else {
      same.insert(same.end(), sharers.begin(), sharers.end());
    }
  }
  std::sort(same.begin(), same.end());
  std::map<std::string, int> used;  // numbers by name
  for (const std::size_t i : same) {
    do {
      names[i] = candidates[i].Numbered(++used[objects[i].name]);
    } while (!taken.insert(FileNameOf(names[i])).second);
  }
  return names;
}

}  // namespace antigrasp
