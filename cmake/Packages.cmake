# Manual pages and completion are installed with the program; `cpack` in the build folder makes Debian packages:
# antigrasp (programs, networks, pages), libantigrasp-dev (libraries and headers) and, where it is built,
# python3-antigrasp.
find_program(ANTIGRASP_PYTHON python3 PATHS /usr/bin NO_DEFAULT_PATH)
if(ANTIGRASP_TORCH AND ANTIGRASP_PYTHON)
  # Of what `antigrasp help` says; the program is there by then.
  install(CODE "execute_process(COMMAND ${ANTIGRASP_PYTHON} -B ${PROJECT_SOURCE_DIR}/scripts/shell_files.py
    ${PROJECT_BINARY_DIR}/bin/antigrasp ${PROJECT_BINARY_DIR}/shell_files COMMAND_ERROR_IS_FATAL ANY)")
  install(DIRECTORY ${PROJECT_BINARY_DIR}/shell_files/share/ DESTINATION ${CMAKE_INSTALL_DATADIR})
endif()
install(FILES README.md LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(DIRECTORY docs examples DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(DIRECTORY configs DESTINATION ${CMAKE_INSTALL_DATADIR}/antigrasp)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT "The antigrasp authors <maintainers@example.org>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "objects that look ordinary and that a gripper drops")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING ONE_PER_GROUP)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME antigrasp)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS fonts-dejavu-core)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_NAME libantigrasp-dev)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_DEPENDS
    "libeigen3-dev, libcgal-dev, libembree-dev, libtomlplusplus-dev, libzip-dev, libexpat1-dev, libassimp-dev, lib3mf-dev, libfmt-dev, libspdlog-dev, libpng-dev, libcairo2-dev, libhdf5-dev, libmeshoptimizer-dev, libyaml-cpp-dev, libmujoco-dev, libopenblas-dev, libtorch-dev")
set(CPACK_DEBIAN_LIBRARY_PACKAGE_RECOMMENDS antigrasp)
set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-antigrasp)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "${ANTIGRASP_PYTHON_NEEDS}")
set(CPACK_DEBIAN_PYTHON_PACKAGE_RECOMMENDS antigrasp)  # the networks that ship
set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA
    "${CMAKE_CURRENT_LIST_DIR}/python_package/postinst;${CMAKE_CURRENT_LIST_DIR}/python_package/prerm")
include(CPack)
cpack_add_component(Unspecified GROUP program)
cpack_add_component(networks GROUP program)
cpack_add_component(quality GROUP library)
cpack_add_component(train GROUP library)
cpack_add_component_group(program)
cpack_add_component_group(library)
if(ANTIGRASP_PYTHON_MODULE)
  cpack_add_component(python GROUP python)
  cpack_add_component_group(python)
endif()
