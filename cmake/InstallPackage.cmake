# `cmake --install` puts the metric where find_package(antigrasp) finds it: antigrasp::quality and
# what it stands on, without LibTorch.
include(CMakePackageConfigHelpers)
include(GNUInstallDirs)

set(ANTIGRASP_PACKAGE core mesh quality)
list(TRANSFORM ANTIGRASP_PACKAGE PREPEND antigrasp_ OUTPUT_VARIABLE package_targets)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/antigrasp)
install(TARGETS ${package_targets} EXPORT antigraspTargets COMPONENT quality)
install(EXPORT antigraspTargets NAMESPACE antigrasp:: DESTINATION ${package_dir} COMPONENT quality)
foreach(folder IN LISTS ANTIGRASP_PACKAGE)
  install(DIRECTORY ${folder} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/antigrasp
          COMPONENT quality FILES_MATCHING PATTERN "*.h")
endforeach()
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/antigraspConfig.cmake.in
                              ${PROJECT_BINARY_DIR}/antigraspConfig.cmake
                              INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/antigraspConfigVersion.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/antigraspConfig.cmake
              ${PROJECT_BINARY_DIR}/antigraspConfigVersion.cmake
        DESTINATION ${package_dir} COMPONENT quality)
