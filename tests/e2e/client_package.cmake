# Installs core and client library to a prefix of their own, builds the examples against nothing but that, and runs them against a
# server.
include(${CMAKE_CURRENT_LIST_DIR}/run.cmake)
file(REMOVE_RECURSE ${WORK_DIR})
foreach(part core proto wire client)
  run(${CMAKE_COMMAND} --install ${BUILD_DIR}/${part} --prefix ${WORK_DIR}/prefix)
endforeach()
set(flags "")
if(SANITIZE)
  set(flags -fsanitize=${SANITIZE})
endif()
run(${CMAKE_COMMAND} -S ${SOURCE_DIR} -B ${WORK_DIR}/build -G ${GENERATOR} -D CMAKE_CXX_COMPILER=${CXX_COMPILER}
  -D CMAKE_PREFIX_PATH=${WORK_DIR}/prefix -D CMAKE_CXX_FLAGS=${flags})
run(${CMAKE_COMMAND} --build ${WORK_DIR}/build)
run(${PYTHON} ${CMAKE_CURRENT_LIST_DIR}/run_examples ${SERVER} ${WORK_DIR}/build ${MESH})
