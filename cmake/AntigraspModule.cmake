# antigrasp_module(core SOURCES a.cpp b.cpp PUBLIC targets... PRIVATE targets...)
# Makes the static library antigrasp_<name>, alias antigrasp::<name>. The PUBLIC and PRIVATE lists are the
# dependency rule of docs/architecture.md, and the compiler holds to it: "antigrasp/<room>/x.h" is found
# through a folder of links that has this room alone, so a target sees its own room and those it links.
function(antigrasp_module name)
  cmake_parse_arguments(ARG "" "" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
  add_library(antigrasp_${name} STATIC ${ARG_SOURCES})
  add_library(antigrasp::${name} ALIAS antigrasp_${name})
  antigrasp_see_own_room(antigrasp_${name})
  target_link_libraries(antigrasp_${name} PUBLIC ${ARG_PUBLIC}
                        PRIVATE $<BUILD_INTERFACE:antigrasp_options> ${ARG_PRIVATE})
  set_target_properties(antigrasp_${name} PROPERTIES EXPORT_NAME ${name})
  target_compile_features(antigrasp_${name} PUBLIC cxx_std_20)
endfunction()

# Lets the target, and those that link it, include the headers of the folder that calls this.
function(antigrasp_see_own_room target)
  file(RELATIVE_PATH room ${PROJECT_SOURCE_DIR} ${CMAKE_CURRENT_SOURCE_DIR})
  set(root ${PROJECT_BINARY_DIR}/include/${target})
  cmake_path(GET room PARENT_PATH parent)
  file(MAKE_DIRECTORY ${root}/antigrasp/${parent})
  file(CREATE_LINK ${CMAKE_CURRENT_SOURCE_DIR} ${root}/antigrasp/${room} SYMBOLIC)
  target_include_directories(${target} PUBLIC $<BUILD_INTERFACE:${root}> $<INSTALL_INTERFACE:include>)
endfunction()

# antigrasp_test(core SOURCES a_test.cpp LIBS antigrasp::core [LABELS slow] [PROCESSES 4])
# One executable per folder; every TEST becomes a CTest named <folder>/<Suite.Name>, a process each. With `ctest -C rooms`,
# which the test presets rooms and asan say, the same tests also run in PROCESSES processes, <folder>/1_of_4 and so on:
# starting one takes half a second with LibTorch and more on a busy machine, .06 s of processor time under the sanitizers.
function(antigrasp_test name)
  cmake_parse_arguments(ARG "" "PROCESSES" "SOURCES;LIBS;LABELS" ${ARGN})
  add_executable(${name}_test ${ARG_SOURCES})
  target_link_libraries(${name}_test PRIVATE antigrasp_options ${ARG_LIBS} antigrasp_test_support
                                             GTest::gtest GTest::gtest_main)
  target_compile_options(${name}_test PRIVATE -O1)  # a quarter faster to compile than -O3
  set_target_properties(${name}_test PROPERTIES ANTIGRASP_TEST ON)  # CompilerOptions.cmake
  if(ARG_LIBS MATCHES "antigrasp::(models|checkpoints|gan|train|ranks|report)(;|$)")
    antigrasp_read_precompiled(${name}_test torch_tests)
  else()
    antigrasp_read_precompiled(${name}_test tests)
  endif()
  gtest_discover_tests(${name}_test TEST_PREFIX ${name}/ DISCOVERY_TIMEOUT 60
                       PROPERTIES TIMEOUT 600 LABELS "${name};${ARG_LABELS}")
  antigrasp_test_in_few_processes(${name} "${ARG_PROCESSES}" "${name};${ARG_LABELS}")
endfunction()

function(antigrasp_test_in_few_processes name processes labels)
  if(NOT processes)
    set(processes 1)
  endif()
  foreach(number RANGE 1 ${processes})
    set(test ${name}/${number}_of_${processes})
    math(EXPR index "${number} - 1")
    add_test(NAME ${test} COMMAND ${name}_test CONFIGURATIONS rooms)
    # COST: what takes long begins first, so that no process is left alone at the end.
    set_tests_properties(${test} PROPERTIES TIMEOUT 1200 LABELS "${labels}" COST ${processes}
                         ENVIRONMENT "GTEST_TOTAL_SHARDS=${processes};GTEST_SHARD_INDEX=${index}")
  endforeach()
endfunction()
