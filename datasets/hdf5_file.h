#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace antigrasp {

// The little of HDF5 that shape files need, without its header. Reading returns nothing when the
// item is missing or of another type, and lets the caller say what was expected; nothing is
// printed. The library underneath is not thread-safe: any thread may call, one at a time gets in.
class Hdf5File {
 public:
  // Null when the path is not a readable HDF5 file.
  static std::unique_ptr<Hdf5File> Open(const std::filesystem::path& path);
  // A new file, written to disk as it grows and whole after Close().
  static std::unique_ptr<Hdf5File> Create(const std::filesystem::path& path);
  ~Hdf5File();

  // Attributes are the root group's, those of text and single numbers also another object's.
  std::optional<std::string> StringAttribute(const std::string& name,
                                             const std::string& object = "/") const;
  std::optional<std::uint64_t> UintAttribute(const std::string& name) const;
  std::optional<double> DoubleAttribute(const std::string& name,
                                        const std::string& object = "/") const;
  std::optional<std::vector<double>> DoublesAttribute(const std::string& name,
                                                      const std::string& object = "/") const;

  // Extents of a dataset of numbers or strings; empty when there is none.
  std::vector<std::uint64_t> Extents(const std::string& name) const;
  // Whether the dataset holds numbers that ReadFloats can turn to float.
  bool HoldsFloats(const std::string& name) const;
  // Bytes that the dataset takes in the file, compressed.
  std::uint64_t StoredBytes(const std::string& name) const;
  // Item `item` along the first extent; false when it cannot be read.
  bool ReadFloats(const std::string& name, std::uint64_t item, float* values) const;
  std::optional<std::vector<std::string>> ReadStrings(const std::string& name) const;

  // All writing throws RuntimeFailure when the library refuses (out of memory) or the disk is full.
  // Some readers see none of an object's attributes if it has more than eight.
  void WriteAttribute(const std::string& name, const std::string& value,
                      const std::string& object = "/");
  void WriteAttribute(const std::string& name, std::uint64_t value);
  void WriteAttribute(const std::string& name, const std::vector<double>& values);
  void WriteAttribute(const std::string& name, double value, const std::string& object = "/");
  // float32 [count, item_extents...], one chunk an item: shuffled, deflated, with check sums. Then
  // its items, one after the other.
  void CreateFloats(const std::string& name, std::uint64_t count,
                    const std::vector<std::uint64_t>& item_extents);
  void AppendFloats(const float* values);
  void WriteStrings(const std::string& name, const std::vector<std::string>& values);
  void Close();  // the last call

 private:
  struct Impl;
  explicit Hdf5File(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace antigrasp
