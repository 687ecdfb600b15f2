# Core configures without gRPC and protobuf: with both hidden from find_package, a build without the server goes through.
include(${CMAKE_CURRENT_LIST_DIR}/run.cmake)
file(REMOVE_RECURSE ${WORK_DIR})
run(${CMAKE_COMMAND} -S ${SOURCE_DIR} -B ${WORK_DIR} -G ${GENERATOR} -D CMAKE_CXX_COMPILER=${CXX_COMPILER}
  -D VSPLIT_BUILD_SERVER=OFF -D VSPLIT_BUILD_TOOLS=OFF -D VSPLIT_BUILD_TESTS=OFF -D VSPLIT_BUILD_BENCH=OFF
  -D CMAKE_DISABLE_FIND_PACKAGE_gRPC=ON -D CMAKE_DISABLE_FIND_PACKAGE_Protobuf=ON)
file(READ ${WORK_DIR}/compile_commands.json commands)
if(commands MATCHES "grpc|protobuf")
  message(FATAL_ERROR "a build without the server still compiles against gRPC or protobuf: ${WORK_DIR}/compile_commands.json")
endif()
