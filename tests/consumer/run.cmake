# Installs a build of vesica into a fresh prefix, builds the consumer project against it and runs its programs.
#   cmake -D BUILD_DIR=... -D WORK_DIR=... -D BUILD_TYPE=... -D GENERATOR=... -D CXX_COMPILER=... -D CXX_FLAGS=...
#     -P run.cmake

file(REMOVE_RECURSE "${WORK_DIR}")
execute_process(
  COMMAND "${CMAKE_COMMAND}" --install "${BUILD_DIR}" --prefix "${WORK_DIR}/prefix" COMMAND_ERROR_IS_FATAL ANY
  OUTPUT_QUIET)
execute_process(
  COMMAND
    "${CMAKE_COMMAND}" -S "${CMAKE_CURRENT_LIST_DIR}" -B "${WORK_DIR}/build" -G "${GENERATOR}"
    "-DCMAKE_PREFIX_PATH=${WORK_DIR}/prefix" "-DCMAKE_BUILD_TYPE=${BUILD_TYPE}"
    "-DCMAKE_CXX_COMPILER=${CXX_COMPILER}" "-DCMAKE_CXX_FLAGS=${CXX_FLAGS}" COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND "${CMAKE_COMMAND}" --build "${WORK_DIR}/build" COMMAND_ERROR_IS_FATAL ANY)

file(STRINGS "${WORK_DIR}/build/programs.txt" programs)
foreach(program IN LISTS programs)
  execute_process(COMMAND "${program}" WORKING_DIRECTORY "${WORK_DIR}" COMMAND_ERROR_IS_FATAL ANY)
endforeach()

# The installed programs find the installed library.
foreach(program IN ITEMS vesica-relax vesica-compare vesica-export)
  if(EXISTS "${WORK_DIR}/prefix/bin/${program}")
    execute_process(COMMAND "${WORK_DIR}/prefix/bin/${program}" --help OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
  endif()
endforeach()
