#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace antigrasp {

// Numbers of a dataset or attribute, rows first. No extents: a single one.
struct Hdf5Numbers {
  std::vector<std::uint64_t> extents;
  std::vector<double> values;
};

// Groups, arrays of numbers, texts and attributes by path ("/grasps/transforms"), for files that
// fit into memory. Reading returns nothing for what is missing, of another type or damaged, and
// prints nothing. Any thread may call, one at a time gets in (hdf5_file.h).
class Hdf5Tree {
 public:
  // Null when the path is not a readable HDF5 file.
  static std::unique_ptr<Hdf5Tree> Open(const std::filesystem::path& path);
  // A new one, written to disk as it grows and whole after Close(); the same bytes for the same
  // content, in the layout of hdf5_file.h.
  static std::unique_ptr<Hdf5Tree> Create(const std::filesystem::path& path);
  ~Hdf5Tree();

  // Names in a group, in the order of their bytes; empty when there is no such group.
  std::vector<std::string> Children(const std::string& group) const;
  // At most 16 Mi values, integers as doubles.
  std::optional<Hdf5Numbers> Numbers(const std::string& path) const;
  std::optional<std::string> Text(const std::string& path) const;
  std::optional<Hdf5Numbers> NumbersAttribute(const std::string& object,
                                              const std::string& name) const;
  std::optional<std::string> TextAttribute(const std::string& object,
                                           const std::string& name) const;

  // Groups on the way to a path are made. Texts have no fixed length, which readers take for text
  // and not for bytes. RuntimeFailure when memory runs out or the disk is full.
  void Group(const std::string& path);
  void Write(const std::string& path, const Hdf5Numbers& numbers);
  void WriteWhole(const std::string& path, const Hdf5Numbers& numbers);  // as 64-bit integers
  void WriteText(const std::string& path, const std::string& text);
  // Of a group or dataset that is there.
  void WriteAttribute(const std::string& object, const std::string& name,
                      const Hdf5Numbers& numbers);
  void WriteWholeAttribute(const std::string& object, const std::string& name, std::int64_t value);
  void WriteTextAttribute(const std::string& object, const std::string& name,
                          const std::string& text);
  void Close();  // the last call

 private:
  struct Impl;
  explicit Hdf5Tree(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace antigrasp
