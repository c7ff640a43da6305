# One place for language level, warnings and sanitizers; every antigrasp target links this.
add_library(antigrasp_options INTERFACE)
target_compile_features(antigrasp_options INTERFACE cxx_std_20)
# -ffp-contract=off: the same source gives the same bits with and without FMA hardware.
# -Wno-restrict: GCC 12 warns wrongly about "literal" + std::string (GCC bug 105329).
target_compile_options(antigrasp_options INTERFACE -Wall -Wextra -Wconversion -Wno-sign-conversion
                                                   -Wno-restrict -ffp-contract=off)
# A unity build compiles some eight files of a target as one. GCC then takes the private parts of a class, whose types
# are of one file alone, for those of a header.
if(CMAKE_UNITY_BUILD AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  target_compile_options(antigrasp_options INTERFACE -Wno-subobject-linkage)
endif()
if(ANTIGRASP_WERROR)
  target_compile_options(antigrasp_options INTERFACE -Werror)
endif()
if(ANTIGRASP_SANITIZE)
  # Tests' own code is checked for addresses alone: undefined behaviour is looked for in what it calls, and would double
  # the time that tests take to compile.
  target_compile_options(antigrasp_options INTERFACE -fsanitize=${ANTIGRASP_SANITIZE}
                                                     -fno-omit-frame-pointer -fno-sanitize-recover=all
                                                     $<$<BOOL:$<TARGET_PROPERTY:ANTIGRASP_TEST>>:-fno-sanitize=undefined>)
  target_link_options(antigrasp_options INTERFACE -fsanitize=${ANTIGRASP_SANITIZE})
endif()
if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Build type" FORCE)
endif()
# Release keeps -O3 but drops nothing that CHECK needs (CHECK does not use NDEBUG).
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
