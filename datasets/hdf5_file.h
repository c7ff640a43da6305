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
// printed. The library underneath is not thread-safe: use files from one thread at a time.
class Hdf5File {
 public:
  // Null when the path is not a readable HDF5 file.
  static std::unique_ptr<Hdf5File> Open(const std::filesystem::path& path);
  // A new file in memory: the library never meets a full disk, which it does not survive.
  static std::unique_ptr<Hdf5File> Create();
  ~Hdf5File();

  std::optional<std::string> StringAttribute(const std::string& name) const;
  std::optional<std::uint64_t> UintAttribute(const std::string& name) const;
  std::optional<double> DoubleAttribute(const std::string& name) const;
  std::optional<std::vector<double>> DoublesAttribute(const std::string& name) const;

  // Extents of a dataset of numbers or strings; empty when there is none.
  std::vector<std::uint64_t> Extents(const std::string& name) const;
  // Whether the dataset holds numbers that ReadFloats can turn to float.
  bool HoldsFloats(const std::string& name) const;
  // Bytes that the dataset takes in the file, compressed.
  std::uint64_t StoredBytes(const std::string& name) const;
  // Item `item` along the first extent; false when it cannot be read.
  bool ReadFloats(const std::string& name, std::uint64_t item, float* values) const;
  std::optional<std::vector<std::string>> ReadStrings(const std::string& name) const;

  // All writing throws RuntimeFailure when the library refuses (out of memory).
  void WriteAttribute(const std::string& name, const std::string& value);
  void WriteAttribute(const std::string& name, std::uint64_t value);
  void WriteAttribute(const std::string& name, const std::vector<double>& values);
  void WriteAttribute(const std::string& name, double value);
  // float32 [items.size(), item_extents...], one chunk an item: shuffled, deflated, with check
  // sums.
  void WriteFloats(const std::string& name, const std::vector<const float*>& items,
                   const std::vector<std::uint64_t>& item_extents);
  void WriteStrings(const std::string& name, const std::vector<std::string>& values);
  std::string Bytes();  // closes the file and gives it whole, to be written to disk

 private:
  struct Impl;
  explicit Hdf5File(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace antigrasp
