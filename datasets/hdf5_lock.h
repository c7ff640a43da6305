#pragma once

#include <mutex>

#include "antigrasp/datasets/hdf5_handle.h"

// Only for .cpp files of this folder: nobody else sees HDF5.
namespace antigrasp {

inline std::recursive_mutex g_hdf5_library;

// The library has one state for all files, and is not thread-safe in every build of it: whoever
// calls it holds this.
class Hdf5Lock {
 public:
  Hdf5Lock() : guard_(g_hdf5_library) { SilenceHdf5(); }

 private:
  std::lock_guard<std::recursive_mutex> guard_;
};

}  // namespace antigrasp
