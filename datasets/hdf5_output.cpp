#include "antigrasp/datasets/hdf5_output.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

#include "antigrasp/core/error.h"

namespace antigrasp {
namespace {

// What HDF5 knows of the file.
struct DriverFile {
  H5FD_t base{};  // first: the library sees no more
  Hdf5Output* output = nullptr;
  haddr_t end_of_space = 0;  // as HDF5 has handed it out
  haddr_t end_of_file = 0;
};

DriverFile& Own(H5FD_t* file) { return *reinterpret_cast<DriverFile*>(file); }
const DriverFile& Own(const H5FD_t* file) { return *reinterpret_cast<const DriverFile*>(file); }

H5FD_t* Open(const char*, unsigned, hid_t file_access, haddr_t) {
  auto* const file = new DriverFile;
  file->output =
      *static_cast<Hdf5Output* const*>(H5Pget_driver_info(file_access));  // of Catch below
  return &file->base;
}

herr_t Close(H5FD_t* file) {
  delete &Own(file);
  return 0;
}

herr_t Write(H5FD_t* file, H5FD_mem_t type, hid_t, haddr_t address, std::size_t size,
             const void* bytes) {
  DriverFile& own = Own(file);
  own.output->Write(type == H5FD_MEM_DRAW, address, size, static_cast<const char*>(bytes));
  own.end_of_file = std::max(own.end_of_file, address + size);
  return 0;
}

herr_t Read(H5FD_t* file, H5FD_mem_t, hid_t, haddr_t address, std::size_t size, void* bytes) {
  Own(file).output->Read(address, size, static_cast<char*>(bytes));
  return 0;
}

herr_t Truncate(H5FD_t* file, hid_t, hbool_t) {
  DriverFile& own = Own(file);
  own.output->Truncate(own.end_of_space);
  own.end_of_file = own.end_of_space;
  return 0;
}

hid_t Driver() {
  static const hid_t driver = [] {
    static H5FD_class_t functions{};
    functions.name = "antigrasp output";
    functions.maxaddr = HADDR_MAX;
    functions.fc_degree = H5F_CLOSE_WEAK;
    functions.fapl_size = sizeof(Hdf5Output*);
    functions.open = Open;
    functions.close = Close;
    functions.query = [](const H5FD_t*, unsigned long* flags) -> herr_t {
      *flags =
          0;  // nothing gathered, no room set aside: the end of what is used is that of the file
      return 0;
    };
    functions.get_eoa = [](const H5FD_t* file, H5FD_mem_t) { return Own(file).end_of_space; };
    functions.set_eoa = [](H5FD_t* file, H5FD_mem_t, haddr_t address) -> herr_t {
      Own(file).end_of_space = address;
      return 0;
    };
    functions.get_eof = [](const H5FD_t* file, H5FD_mem_t) { return Own(file).end_of_file; };
    functions.read = Read;
    functions.write = Write;
    functions.truncate = Truncate;
    const H5FD_mem_t map[] = H5FD_FLMAP_DICHOTOMY;
    std::copy(std::begin(map), std::end(map), functions.fl_map);
    return H5FDregister(&functions);
  }();
  return driver;
}

}  // namespace

Hdf5Output::Hdf5Output(std::filesystem::path path)
    : path_(std::move(path)),
      file_(::open(path_.c_str(), O_RDWR | O_CREAT | O_TRUNC | O_CLOEXEC, 0666)) {
  if (file_ < 0) failure_ = errno;
}

Hdf5Output::~Hdf5Output() {
  if (file_ >= 0) ::close(file_);
}

void Hdf5Output::Catch(hid_t file_access) {
  Hdf5Output* const self = this;
  H5Pset_driver(file_access, Driver(), &self);
}

void Hdf5Output::RequireWritten() const {
  if (failure_ == 0) return;
  throw RuntimeFailure("cannot write " + path_.string() + ": " + std::strerror(failure_));
}

void Hdf5Output::Write(bool values, haddr_t address, std::size_t size, const char* bytes) {
  for (std::size_t done = 0; done < size && !values;) {
    const haddr_t at = address + done;
    const std::size_t count = std::min<std::size_t>(size - done, kPage - at % kPage);
    std::copy_n(bytes + done, count, structure_[at / kPage].data() + at % kPage);
    done += count;
  }
  for (std::size_t done = 0; done < size && failure_ == 0;) {
    const ssize_t count =
        ::pwrite(file_, bytes + done, size - done, static_cast<off_t>(address + done));
    if (count > 0) {
      done += static_cast<std::size_t>(count);
    } else if (count == 0 || errno != EINTR) {
      failure_ = count == 0 ? ENOSPC : errno;
    }
  }
}

void Hdf5Output::Read(haddr_t address, std::size_t size, char* bytes) const {
  for (std::size_t done = 0; done < size;) {
    const haddr_t at = address + done;
    const std::size_t count = std::min<std::size_t>(size - done, kPage - at % kPage);
    const auto page = structure_.find(at / kPage);
    if (page == structure_.end()) {
      std::fill_n(bytes + done, count, '\0');
    } else {
      std::copy_n(page->second.data() + at % kPage, count, bytes + done);
    }
    done += count;
  }
}

void Hdf5Output::Truncate(haddr_t size) {
  if (failure_ == 0 && ::ftruncate(file_, static_cast<off_t>(size)) != 0) failure_ = errno;
}

}  // namespace antigrasp
