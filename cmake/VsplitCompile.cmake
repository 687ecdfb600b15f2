# One place for how every target of the project is compiled: `target_link_libraries(x PRIVATE vsplit_compile)`.
add_library(vsplit_compile INTERFACE)
target_compile_features(vsplit_compile INTERFACE cxx_std_20)
target_compile_options(vsplit_compile INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion -Wold-style-cast -Wnon-virtual-dtor -Woverloaded-virtual -Werror
  # A multiply and an add must not fuse on one machine and not on another: results are the same bits everywhere.
  -ffp-contract=off
  # Nobody reads errno or floating-point flags; without this no loop with a square root becomes vectors. Results stay the same.
  -fno-math-errno -fno-trapping-math)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # g++ 12 warns of array bounds and uninitialised values inside Eigen and the standard library that are not there.
  target_compile_options(vsplit_compile INTERFACE -Wno-array-bounds -Wno-maybe-uninitialized -Wno-stringop-overflow -Wno-restrict)
endif()

# For targets whose coroutines Boost.Asio runs, and those that include its headers. clang 14 has coroutines but says so in no way that
# libstdc++ and Boost 1.74 know of, and goes wrong where it checks the types of functions as well.
function(vsplit_coroutines target)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "Clang" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 16)
    target_compile_definitions(${target} PUBLIC __cpp_impl_coroutine=201902L BOOST_ASIO_HAS_CO_AWAIT BOOST_ASIO_HAS_STD_COROUTINE)
    if(VSPLIT_SANITIZE MATCHES "undefined")
      target_compile_options(${target} PUBLIC -fno-sanitize=function)
    endif()
  endif()
endfunction()

# A defect that is left is to end the process rather than to be used. Debian's compilers make position-independent programs by
# themselves; e2e.guard.hardening looks at what came out.
if(NOT VSPLIT_SANITIZE)
  add_link_options(LINKER:-z,relro,-z,now,-z,noexecstack)
  add_compile_options($<$<CONFIG:Release>:-fstack-protector-strong> $<$<CONFIG:Release>:-fstack-clash-protection>)
  add_compile_definitions($<$<CONFIG:Release>:_FORTIFY_SOURCE=2>)
  if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
    add_compile_options($<$<CONFIG:Release>:-fcf-protection=full>)
  endif()
endif()

# Sanitizers hold for the whole build, tests and libraries alike.
if(VSPLIT_SANITIZE)
  add_compile_options(-fsanitize=${VSPLIT_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  add_link_options(-fsanitize=${VSPLIT_SANITIZE})
  if(VSPLIT_SANITIZE MATCHES "thread")
    add_compile_definitions(BOOST_ASIO_DISABLE_FENCED_BLOCK)  # tsan knows nothing of fences; Asio's queues are locked beside them
  endif()
endif()
