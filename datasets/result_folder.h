#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "antigrasp/core/atomic_file.h"
#include "antigrasp/core/staged_folder.h"
#include "antigrasp/datasets/objects.h"

namespace antigrasp {

// What a command leaves in the folder that it fills.
struct ResultFiles {
  // "print.csv", a row an object, there when all the rest is. It says what an earlier call wrote:
  // in a column `file` (no folders), or by `object` and the patterns below.
  std::string table;
  std::vector<std::string> of_call;  // "sheet.png"
  // NAME stands for FileNameOf(object): "NAME.stl", "after/NAME.ply", "NAME/NAME.xml".
  std::vector<std::string> of_object;
};

// One rule for every command that fills a folder. It is used when it holds the command's table or
// anything that the call could write, and then refused, unless it may be overwritten: then these
// files, and those that the table names, give way to the new ones, with the folders that only they
// filled. Other files stay. Nothing changes before Commit(): a call that fails or is killed leaves
// what was there.
class ResultFolder {
 public:
  // Makes the folder where it is missing. InputError for a used one, for one that cannot be written
  // to, and when a file that objects are read from would be written over or removed.
  ResultFolder(const std::filesystem::path& folder, const ResultFiles& files,
               const ObjectSource& objects, bool overwrite);
  // Where the files are to be written, as if it were the folder.
  const std::filesystem::path& path() const { return staged_.path(); }
  // More of the table, which need not fit into memory. RuntimeFailure when the disk is full.
  void AddToTable(std::string_view text);
  // Old files go, new ones appear, the table last. RuntimeFailure when the disk is full.
  void Commit(std::string_view rest_of_table);
  std::filesystem::path table() const { return folder_ / table_; }  // its final place

 private:
  std::filesystem::path folder_;
  std::string table_;
  std::vector<std::filesystem::path> old_;  // the table last
  StagedFolder staged_;
  std::optional<AtomicFile> table_file_;  // in the staged folder; goes before it
};

}  // namespace antigrasp
