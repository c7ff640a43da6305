function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE code OUTPUT_VARIABLE text ERROR_VARIABLE text)
  if(NOT code EQUAL 0)
    message(FATAL_ERROR "${ARGN}: ${code}\n${text}")
  endif()
  set(text "${text}" PARENT_SCOPE)
endfunction()

set(work ${BUILD}/package_test)
file(REMOVE_RECURSE ${work})
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${work}/prefix --component quality)
run(${CMAKE_COMMAND} -S ${SOURCE}/examples/score_mesh -B ${work}/build -G Ninja
    -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_COMPILER=${COMPILER}
    -DCMAKE_PREFIX_PATH=${work}/prefix)
run(${CMAKE_COMMAND} --build ${work}/build)
file(WRITE ${work}/cube.off "OFF
8 6 0
0 0 0
1 0 0
1 1 0
0 1 0
0 0 1
1 0 1
1 1 1
0 1 1
4 3 2 1 0
4 4 5 6 7
4 0 1 5 4
4 1 2 6 5
4 2 3 7 6
4 3 0 4 7
")
run(${work}/build/score_mesh ${work}/cube.off)
if(NOT text MATCHES "graspability 0\\.0[0-9]+ .* from 100 grasps")
  message(FATAL_ERROR "unexpected output: ${text}")
endif()
execute_process(COMMAND ldd ${work}/build/score_mesh OUTPUT_VARIABLE libraries)
if(libraries MATCHES "libtorch|libc10")
  message(FATAL_ERROR "the metric's library pulls in LibTorch:\n${libraries}")
endif()
execute_process(COMMAND ${work}/build/score_mesh ${work}/none.stl RESULT_VARIABLE code
                ERROR_VARIABLE text)
if(NOT code EQUAL 2 OR NOT text MATCHES "none.stl")
  message(FATAL_ERROR "a missing mesh is not refused: ${code} ${text}")
endif()
