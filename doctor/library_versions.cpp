#include "antigrasp/doctor/library_versions.h"

#include <CGAL/version.h>
#include <embree3/rtcore.h>
#include <hdf5.h>
#include <png.h>

#include <Eigen/Core>
#include <array>
#ifdef ANTIGRASP_HAS_MUJOCO
#include <mujoco/mujoco.h>
#endif
#ifdef ANTIGRASP_HAS_ZIP
#include <expat.h>
#include <zip.h>
#endif
#ifdef ANTIGRASP_HAS_ZLIB
#include <zlib.h>
#endif
#ifdef ANTIGRASP_HAS_ASSIMP
#include <assimp/version.h>
#endif

namespace antigrasp {
namespace {

template <typename Number>
std::string Dotted(const std::array<Number, 3>& numbers) {
  return std::to_string(numbers[0]) + "." + std::to_string(numbers[1]) + "." +
         std::to_string(numbers[2]);
}

LibraryVersion Embree() {
  const RTCDevice device = rtcNewDevice(nullptr);
  const auto linked = rtcGetDeviceProperty(device, RTC_DEVICE_PROPERTY_VERSION);
  rtcReleaseDevice(device);
  return {"Embree", RTC_VERSION_STRING,
          Dotted(std::array{linked / 10000, linked / 100 % 100, linked % 100})};
}

LibraryVersion Hdf5() {
  std::array<unsigned, 3> linked{};
  H5get_libversion(&linked[0], &linked[1], &linked[2]);
  return {"HDF5", Dotted(std::array{H5_VERS_MAJOR, H5_VERS_MINOR, H5_VERS_RELEASE}),
          Dotted(linked)};
}

#ifdef ANTIGRASP_HAS_MUJOCO
LibraryVersion Mujoco() {
  constexpr int kHeader = mjVERSION_HEADER;  // 222 is 2.2.2
  return {"MuJoCo", Dotted(std::array{kHeader / 100, kHeader / 10 % 10, kHeader % 10}),
          mj_versionString()};
}
#endif

}  // namespace

std::vector<LibraryVersion> GeometryLibraries() {
  std::vector<LibraryVersion> libraries = {
      {"Eigen", Dotted(std::array{EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION}),
       ""},
      {"CGAL", CGAL_VERSION_STR, ""},
      Embree(),
      Hdf5(),
      {"libpng", PNG_LIBPNG_VER_STRING, png_get_libpng_ver(nullptr)}};
#ifdef ANTIGRASP_HAS_ZIP
  libraries.push_back({"libzip", LIBZIP_VERSION, zip_libzip_version()});
  const XML_Expat_Version expat = XML_ExpatVersionInfo();
  libraries.push_back({"Expat",
                       Dotted(std::array{XML_MAJOR_VERSION, XML_MINOR_VERSION, XML_MICRO_VERSION}),
                       Dotted(std::array{expat.major, expat.minor, expat.micro})});
#endif
#ifdef ANTIGRASP_HAS_ZLIB
  libraries.push_back({"zlib", ZLIB_VERSION, zlibVersion()});
#endif
#ifdef ANTIGRASP_HAS_ASSIMP
  libraries.push_back(
      {"assimp", "",
       Dotted(std::array{aiGetVersionMajor(), aiGetVersionMinor(), aiGetVersionPatch()})});
#endif
#ifdef ANTIGRASP_HAS_MUJOCO
  libraries.push_back(Mujoco());
#endif
  return libraries;
}

std::string LibrariesText(const std::vector<LibraryVersion>& libraries) {
  std::string text;
  for (const LibraryVersion& library : libraries) {
    text += (text.empty() ? "" : ", ") + library.name + " " +
            (library.linked.empty() ? library.compiled : library.linked);
    const bool other =
        !library.linked.empty() && !library.compiled.empty() && library.linked != library.compiled;
    if (other) text += " (compiled against " + library.compiled + ")";
  }
  return text;
}

}  // namespace antigrasp
