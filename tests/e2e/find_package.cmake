# Installs core to a prefix of its own, and builds and runs a project that knows nothing but that prefix.
include(${CMAKE_CURRENT_LIST_DIR}/run.cmake)
file(REMOVE_RECURSE ${WORK_DIR})
run(${CMAKE_COMMAND} --install ${CORE_BUILD_DIR} --prefix ${WORK_DIR}/prefix)

build_against_prefix()

run(${WORK_DIR}/build/consumer ${WORK_DIR}/improved.obj)
message("${run_output}")
file(STRINGS ${WORK_DIR}/improved.obj faces REGEX "^f ")
list(LENGTH faces count)
if(NOT run_output MATCHES " ${count} faces")
  message(FATAL_ERROR "the consumer said '${run_output}' but wrote ${count} faces")
endif()
