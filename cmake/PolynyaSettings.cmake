# Compiler settings that every target of the project shares, and the two functions that declare targets.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/bin)
if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release)
endif()
set(CMAKE_CXX_FLAGS_RELEASE "-O3")

find_program(CCACHE_PROGRAM ccache)
if(CCACHE_PROGRAM)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CCACHE_PROGRAM})
endif()

add_library(polynya_settings INTERFACE)
target_include_directories(polynya_settings INTERFACE ${CMAKE_SOURCE_DIR})
# psabi: a note about packs across translation units, never mixed between compilers here. restrict: gcc 12 sees an overlap
# in "text" + std::to_string(n) that is not there (GCC bug 105651).
target_compile_options(polynya_settings INTERFACE -Wall -Wextra -Wpedantic -Werror -Wno-psabi -Wno-restrict)
if(POLYNYA_NATIVE)
  target_compile_options(polynya_settings INTERFACE -march=native)
endif()
# Contraction to fused multiply-add is kept on; reassociation (-ffast-math) never.
if(POLYNYA_SANITIZE)
  # Instrumented code misleads gcc's search for uninitialised variables (in CGAL's headers, for one) and for operators
  # new and delete that do not match (where a test replaces both).
  target_compile_options(polynya_settings INTERFACE
    -fsanitize=${POLYNYA_SANITIZE} -fno-omit-frame-pointer -Wno-maybe-uninitialized
    -Wno-mismatched-new-delete)
  target_link_options(polynya_settings INTERFACE -fsanitize=${POLYNYA_SANITIZE})
endif()

# polynya_library(NAME SOURCES ... DEPENDS ...): a static library of one room with its direct dependencies.
function(polynya_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;DEPENDS" ${ARGN})
  if(ARG_SOURCES)
    add_library(${name} STATIC ${ARG_SOURCES})
    target_link_libraries(${name} PUBLIC polynya_settings ${ARG_DEPENDS})
  else()
    add_library(${name} INTERFACE)
    target_link_libraries(${name} INTERFACE polynya_settings ${ARG_DEPENDS})
  endif()
endfunction()

# polynya_executable(NAME SOURCES ... DEPENDS ...)
function(polynya_executable name)
  cmake_parse_arguments(ARG "" "" "SOURCES;DEPENDS" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  target_link_libraries(${name} PRIVATE polynya_settings ${ARG_DEPENDS})
endfunction()

# polynya_test(NAME SOURCES ... DEPENDS ... [LABELS fast|long] [TIMEOUT seconds]): one GoogleTest program, one CTest entry.
function(polynya_test name)
  cmake_parse_arguments(ARG "" "TIMEOUT" "SOURCES;DEPENDS;LABELS" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  target_link_libraries(${name} PRIVATE polynya_settings ${ARG_DEPENDS} GTest::gtest GTest::gtest_main)
  target_compile_definitions(${name} PRIVATE
    POLYNYA_SOURCE_DIR="${CMAKE_SOURCE_DIR}" POLYNYA_BINARY_DIR="${CMAKE_BINARY_DIR}")
  add_test(NAME ${name} COMMAND ${name})
  if(NOT ARG_LABELS)
    set(ARG_LABELS fast)
  endif()
  if(NOT ARG_TIMEOUT)
    set(ARG_TIMEOUT 300)
  endif()
  if(POLYNYA_SANITIZE OR CMAKE_BUILD_TYPE STREQUAL "Debug")
    math(EXPR ARG_TIMEOUT "10 * ${ARG_TIMEOUT}")  # these builds are up to ten times as slow
  endif()
  set_tests_properties(${name} PROPERTIES LABELS "${ARG_LABELS}" TIMEOUT ${ARG_TIMEOUT}
    ENVIRONMENT "OMP_WAIT_POLICY=passive")
endfunction()
