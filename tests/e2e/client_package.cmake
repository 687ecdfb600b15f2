# Installs core and client library to a prefix of their own, builds the examples against nothing but that, and runs them against a
# server.
include(${CMAKE_CURRENT_LIST_DIR}/run.cmake)
file(REMOVE_RECURSE ${WORK_DIR})
foreach(part core proto wire client)
  run(${CMAKE_COMMAND} --install ${BUILD_DIR}/${part} --prefix ${WORK_DIR}/prefix)
endforeach()
build_against_prefix()
run(${PYTHON} ${CMAKE_CURRENT_LIST_DIR}/run_examples ${SERVER} ${WORK_DIR}/build ${MESH})
