# Installs the programs and runs them from another folder: both are there, with the networks that ship.
set(prefix ${BUILD}/install_test)
file(REMOVE_RECURSE ${prefix})
execute_process(COMMAND ${CMAKE_COMMAND} -DCMAKE_INSTALL_PREFIX=${prefix} -P ${BUILD}/app/cmake_install.cmake
                OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
set(program ${prefix}/bin/antigrasp)
execute_process(COMMAND ${program} sample cylinders-prior --count 1 --out a.h5 WORKING_DIRECTORY ${prefix}
                OUTPUT_VARIABLE said ERROR_QUIET COMMAND_ERROR_IS_FATAL ANY)
if(NOT said STREQUAL "a.h5: 1 samples, seed 1, from ${prefix}/share/antigrasp/pretrained/cylinders-prior.pt\n")
  message(FATAL_ERROR "not the installed networks: ${said}")
endif()
file(REMOVE ${prefix}/bin/antigrasp-networks)
execute_process(COMMAND ${program} sample cylinders-prior --count 1 --out b.h5 WORKING_DIRECTORY ${prefix}
                RESULT_VARIABLE code ERROR_VARIABLE said OUTPUT_QUIET)
if(NOT code EQUAL 1 OR NOT said MATCHES "^antigrasp: [^\n]*antigrasp-networks cannot be started[^\n]*\n$")
  message(FATAL_ERROR "one line and exit code 1 were expected without antigrasp-networks: ${code}, ${said}")
endif()
