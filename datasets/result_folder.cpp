#include "antigrasp/datasets/result_folder.h"

#include <system_error>

#include "antigrasp/core/csv_reader.h"
#include "antigrasp/core/error.h"
#include "antigrasp/datasets/object_names.h"

namespace antigrasp {
namespace {

namespace fs = std::filesystem;
using Paths = std::vector<fs::path>;

bool IsThere(const fs::path& path) {
  std::error_code ignored;
  return fs::exists(fs::symlink_status(path, ignored));
}

void AddFilesOf(const std::string& object, const ResultFiles& files, Paths* paths) {
  constexpr std::string_view kName = "NAME";
  for (std::string path : files.of_object) {
    const std::string name = FileNameOf(object);
    for (std::size_t at = 0; (at = path.find(kName, at)) != std::string::npos; at += name.size()) {
      path.replace(at, kName.size(), name);
    }
    paths->emplace_back(path);
  }
}

// What an earlier call wrote, by its table. A damaged one says nothing.
Paths NamedIn(const fs::path& table, const ResultFiles& files) {
  Paths paths;
  try {
    CsvReader csv(table);
    const auto file = csv.Column("file");
    const std::size_t object = csv.RequiredColumn("object");
    while (csv.Next()) {
      if (!file) {
        AddFilesOf(csv.Field(object), files, &paths);
      } else if (const fs::path path = csv.Field(*file); path == path.filename()) {
        paths.push_back(path);  // an empty one is none
      }
    }
  } catch (const InputError&) {
  }
  return paths;
}

Paths ThoseThere(const fs::path& folder, const Paths& paths) {
  Paths there;
  for (const fs::path& path : paths) {
    if (!path.empty() && IsThere(folder / path)) there.push_back(folder / path);
  }
  return there;
}

void RequireRemovable(const Paths& paths, const ObjectSource& objects) {
  objects.RequireNotRead(paths);
  for (const fs::path& path : paths) {
    if (fs::is_directory(path)) throw InputError("is a folder", path.string(), "a file or nothing");
  }
}

// A file or a link where a folder of results goes: they would land elsewhere, or nowhere.
void RequireFolders(const fs::path& folder, const Paths& written) {
  for (const fs::path& path : written) {
    const fs::path place = folder / path.parent_path();
    if (!path.has_parent_path() || !IsThere(place)) continue;
    if (fs::symlink_status(place).type() == fs::file_type::directory) continue;
    throw InputError("is in the way of a folder", place.string(), "a folder or nothing");
  }
}

// Every file that must give way to the call's, the table last.
Paths OldFiles(const fs::path& folder, const ResultFiles& files, const ObjectSource& objects,
               bool overwrite) {
  if (!fs::exists(folder)) return {};
  Paths written(files.of_call.begin(), files.of_call.end());
  for (std::int64_t i = 0; i < objects.size(); ++i) AddFilesOf(objects.name(i), files, &written);
  RequireFolders(folder, written);
  Paths old = ThoseThere(folder, written);
  const bool has_table = IsThere(folder / files.table);
  RequireRemovable(old, objects);
  RequireRemovable({folder / files.table}, objects);
  if ((has_table || !old.empty()) && !overwrite) {
    const std::string one =
        has_table ? files.table : old.front().lexically_relative(folder).string();
    throw InputError("holds " + one + " already", folder.string(),
                     "a new folder, or --overwrite to replace what an earlier call wrote");
  }
  if (!has_table) return old;
  const Paths named = ThoseThere(folder, NamedIn(folder / files.table, files));
  RequireRemovable(named, objects);
  old.insert(old.end(), named.begin(), named.end());
  old.push_back(folder / files.table);
  return old;
}

}  // namespace

ResultFolder::ResultFolder(const fs::path& folder, const ResultFiles& files,
                           const ObjectSource& objects, bool overwrite)
    : folder_(folder),
      table_(files.table),
      old_(OldFiles(folder, files, objects, overwrite)),
      staged_(folder) {}

void ResultFolder::AddToTable(std::string_view text) {
  if (!table_file_) table_file_.emplace(path() / table_);
  table_file_->Append(text);
}

void ResultFolder::Commit(std::string_view rest_of_table) {
  AddToTable(rest_of_table);
  table_file_->Commit();  // a full disk is met before anything goes
  for (const fs::path& old : old_) {
    std::error_code error;
    fs::remove(old, error);
    if (error) throw RuntimeFailure("cannot remove " + old.string() + ": " + error.message());
  }
  staged_.Commit(table_);
  for (const fs::path& old : old_) {
    std::error_code full;  // a folder that still holds something stays
    for (fs::path place = old.parent_path(); place != folder_ && fs::remove(place, full);) {
      place = place.parent_path();
    }
  }
}

}  // namespace antigrasp
