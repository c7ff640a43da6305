#pragma once

#include <hdf5.h>

#include <cstdlib>
#include <cstring>
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

// The library prints a stack of errors by default; ours are one line each.
class QuietHdf5Errors {
 public:
  QuietHdf5Errors() {
    // Whatever a damaged file left open would make the library complain when the program ends.
    [[maybe_unused]] static const herr_t no_exit_handler = H5dont_atexit();
    H5Eget_auto2(H5E_DEFAULT, &function_, &data_);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  }
  ~QuietHdf5Errors() { H5Eset_auto2(H5E_DEFAULT, function_, data_); }
  QuietHdf5Errors(const QuietHdf5Errors&) = delete;
  QuietHdf5Errors& operator=(const QuietHdf5Errors&) = delete;

 private:
  H5E_auto2_t function_ = nullptr;
  void* data_ = nullptr;
};

// Keeps the buffer of a file in memory when the file is closed. (H5Fget_file_image, which needs no
// such thing, spoils the check sum of the file's first block in HDF5 1.10.8.)
class Hdf5Image {
 public:
  Hdf5Image() = default;
  ~Hdf5Image() { std::free(data_); }
  Hdf5Image(const Hdf5Image&) = delete;
  Hdf5Image& operator=(const Hdf5Image&) = delete;

  const void* data() const { return data_; }

  // The next file made with these access properties leaves its buffer here.
  void CatchFrom(hid_t file_access) {
    using Op = H5FD_file_image_op_t;
    H5FD_file_image_callbacks_t callbacks{};
    callbacks.image_malloc = [](size_t size, Op, void*) { return std::malloc(size); };
    callbacks.image_memcpy = [](void* to, const void* from, size_t size, Op, void*) {
      return std::memcpy(to, from, size);
    };
    callbacks.image_realloc = [](void* old, size_t size, Op, void*) {
      return std::realloc(old, size);
    };
    callbacks.image_free = [](void* buffer, Op op, void* self) -> herr_t {
      if (op == H5FD_FILE_IMAGE_OP_FILE_CLOSE) {
        std::swap(static_cast<Hdf5Image*>(self)->data_, buffer);
      }
      std::free(buffer);
      return 0;
    };
    callbacks.udata_copy = [](void* self) { return self; };
    callbacks.udata_free = [](void*) -> herr_t { return 0; };
    callbacks.udata = this;
    H5Pset_file_image_callbacks(file_access, &callbacks);
  }

 private:
  void* data_ = nullptr;
};

}  // namespace antigrasp
