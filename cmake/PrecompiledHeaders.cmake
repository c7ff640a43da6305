# Headers of other people's libraries, compiled once and read by many targets: LibTorch's take 10 s a file otherwise.
# None of ours is among them: a target would see rooms that it does not link. Every file still names all it includes
# and compiles without (-DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON).

# antigrasp_precompiled_headers(torch HEADERS <torch/types.h> ... LIBS targets...)
# Compiles the headers, with what LIBS say of folders and macros. All is -fPIC: the compiler wants one value for all;
# of -O it does not.
function(antigrasp_precompiled_headers name)
  cmake_parse_arguments(ARG "" "" "HEADERS;LIBS" ${ARGN})
  set(source ${PROJECT_BINARY_DIR}/precompiled/${name}.cpp)
  file(CONFIGURE OUTPUT ${source} CONTENT "")
  add_library(antigrasp_${name}_headers OBJECT EXCLUDE_FROM_ALL ${source})
  target_precompile_headers(antigrasp_${name}_headers PRIVATE ${ARG_HEADERS})
  target_link_libraries(antigrasp_${name}_headers PRIVATE antigrasp_options ${ARG_LIBS})
endfunction()

# antigrasp_read_precompiled(antigrasp_gan torch)
# A source with instruction sets of its own sets SKIP_PRECOMPILE_HEADERS: the compiler refuses them there.
function(antigrasp_read_precompiled target name)
  if(NOT TARGET ${target})
    return()
  endif()
  target_precompile_headers(${target} REUSE_FROM antigrasp_${name}_headers)
  get_target_property(type ${target} TYPE)
  if(type STREQUAL "EXECUTABLE")
    target_compile_options(${target} PRIVATE -fPIC)
  endif()
  # GCC 12 warns wrongly about std::string, inlined, when it comes from a precompiled header. Builds without them keep
  # these warnings.
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13
     AND NOT CMAKE_DISABLE_PRECOMPILE_HEADERS)
    target_compile_options(${target} PRIVATE -Wno-array-bounds -Wno-stringop-overflow -Wno-stringop-overread)
  endif()
endfunction()

# ccache takes precompiled headers with these settings alone (its manual, "Precompiled headers"). No file of ours
# has the time of its compilation in it.
if(CMAKE_CXX_COMPILER_LAUNCHER MATCHES "ccache$" AND NOT CMAKE_DISABLE_PRECOMPILE_HEADERS)
  set(CMAKE_CXX_COMPILER_LAUNCHER env CCACHE_SLOPPINESS=pch_defines,time_macros ${CMAKE_CXX_COMPILER_LAUNCHER})
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    add_compile_options($<$<COMPILE_LANGUAGE:CXX>:-fpch-preprocess>)
  endif()
endif()
