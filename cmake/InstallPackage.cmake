# `cmake --install` puts the libraries where find_package(antigrasp) finds them, in components: `quality`, the
# metric and what it stands on, without LibTorch; `train`, the episode loop and its models
# (find_package(antigrasp COMPONENTS train); needs `quality` beside it). `networks` are those that ship.
include(CMakePackageConfigHelpers)
include(GNUInstallDirs)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/antigrasp)

# antigrasp_install(quality antigraspTargets ROOMS core mesh... [TARGETS more...])
function(antigrasp_install component export)
  cmake_parse_arguments(ARG "" "" "ROOMS;TARGETS" ${ARGN})
  list(TRANSFORM ARG_ROOMS PREPEND antigrasp_ OUTPUT_VARIABLE targets)
  install(TARGETS ${targets} ${ARG_TARGETS} EXPORT ${export} COMPONENT ${component})
  install(EXPORT ${export} NAMESPACE antigrasp:: DESTINATION ${package_dir} COMPONENT ${component})
  foreach(room IN LISTS ARG_ROOMS)
    install(DIRECTORY ${room} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/antigrasp COMPONENT ${component}
            FILES_MATCHING PATTERN "*.h" PATTERN "pretrained" EXCLUDE)
  endforeach()
endfunction()

antigrasp_install(quality antigraspTargets ROOMS core mesh contact quality)
if(ANTIGRASP_TORCH)
  antigrasp_install(train antigraspTrainTargets ROOMS sdf datasets render models checkpoints train
                    TARGETS antigrasp_torch antigrasp_gan)
endif()

configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/antigraspConfig.cmake.in
                              ${PROJECT_BINARY_DIR}/antigraspConfig.cmake
                              INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/antigraspConfigVersion.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/antigraspConfig.cmake
              ${PROJECT_BINARY_DIR}/antigraspConfigVersion.cmake
        DESTINATION ${package_dir} COMPONENT quality)
