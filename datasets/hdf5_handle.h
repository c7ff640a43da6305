#pragma once

#include <hdf5.h>

#include <utility>

// Only for .cpp files of this folder: nobody else sees HDF5.
namespace antigrasp {

// An HDF5 identifier with the function that releases it.
class Hdf5Handle {
 public:
  using Closer = herr_t (*)(hid_t);
  Hdf5Handle(hid_t id, Closer closer) : id_(id), closer_(closer) {}
  Hdf5Handle(Hdf5Handle&& other) noexcept
      : id_(std::exchange(other.id_, -1)), closer_(other.closer_) {}
  Hdf5Handle& operator=(Hdf5Handle&& other) noexcept {
    std::swap(id_, other.id_);
    std::swap(closer_, other.closer_);
    return *this;
  }
  ~Hdf5Handle() { Release(); }
  bool Release() { return !*this || closer_(std::exchange(id_, -1)) >= 0; }
  explicit operator bool() const { return id_ >= 0; }
  hid_t get() const { return id_; }

 private:
  hid_t id_;
  Closer closer_;
};

// The library prints a stack of errors by default, in every thread anew; ours are one line each.
inline void SilenceHdf5() {
  // Whatever a damaged file left open would make the library complain when the program ends.
  [[maybe_unused]] static const herr_t no_exit_handler = H5dont_atexit();
  [[maybe_unused]] static thread_local const herr_t quiet =
      H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

}  // namespace antigrasp
