# Warnings and sanitizers for the project's own code only: never exported.
add_library(slamot_private INTERFACE)
target_compile_options(slamot_private INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Woverloaded-virtual
  $<$<BOOL:${SLAMOT_WERROR}>:-Werror>)
if(SLAMOT_SANITIZE)
  # Half the time to build; GCC warns of what the checks themselves leave uninitialized.
  add_compile_options(-fsanitize=${SLAMOT_SANITIZE} -fno-omit-frame-pointer -g -O1 -Wno-maybe-uninitialized)
  add_link_options(-fsanitize=${SLAMOT_SANITIZE})
endif()
if(SLAMOT_BUILD_FUZZ)  # coverage for the fuzzer and checks, in all libraries
  add_compile_options(-fsanitize=fuzzer-no-link,address,undefined -fno-omit-frame-pointer -g)
  add_link_options(-fsanitize=fuzzer-no-link,address,undefined)
endif()

# GCC tidies up its memory less often: saves 6 to 13% of the time to build what has many templates.
add_compile_options($<$<CXX_COMPILER_ID:GNU>:--param=ggc-min-expand=200>
                    $<$<CXX_COMPILER_ID:GNU>:--param=ggc-min-heapsize=524288>)

set(seldom $<$<CONFIG:Release>:-O1>)  # options for what runs seldom: two thirds of the time to build
include(SlamotPrecompiled)
set(common <algorithm> <cmath> <filesystem> <fstream> <functional> <map> <memory> <optional> <string>
    <vector> <Eigen/Core> <mrpt/math/TPose2D.h>)
slamot_precompiled(slamot_precompiled_library PIC ${BUILD_SHARED_LIBS} HEADERS ${common}
                   DEPENDS Eigen3::Eigen mrpt::math)
slamot_precompiled(slamot_precompiled_seldom PIC ${BUILD_SHARED_LIBS} HEADERS ${common}
                   DEPENDS Eigen3::Eigen mrpt::math OPTIONS ${seldom})

# Sources compiled four at once: two thirds of the time to build many small ones.
function(slamot_few_at_once target)
  set_target_properties(${target} PROPERTIES UNITY_BUILD ${SLAMOT_UNITY} UNITY_BUILD_BATCH_SIZE 4)
  # What includes them names them by their whole path, which MRPT's exceptions would tell.
  target_compile_options(${target} PRIVATE -fmacro-prefix-map=${PROJECT_SOURCE_DIR}/=)
endfunction()

# slamot_library(NAME [SHARED] [SELDOM] SOURCES a.cpp ... [DEPENDS targets ...] [PRIVATE_DEPENDS targets ...])
# Makes lib slamot-NAME with alias slamot::NAME, headers in include/, installed and exported. SELDOM: what
# it does takes no time worth the optimizer's, such as to read and write files.
function(slamot_library name)
  cmake_parse_arguments(ARG "SHARED;SELDOM" "" "SOURCES;DEPENDS;PRIVATE_DEPENDS" ${ARGN})
  set(target slamot-${name})
  set(kind)  # else as BUILD_SHARED_LIBS says
  if(ARG_SHARED)
    set(kind SHARED)
  endif()
  add_library(${target} ${kind} ${ARG_SOURCES})
  add_library(slamot::${name} ALIAS ${target})
  target_include_directories(${target} PUBLIC
    $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/include>
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  target_compile_features(${target} PUBLIC cxx_std_17)
  target_link_libraries(${target} PUBLIC ${ARG_DEPENDS}
    PRIVATE ${ARG_PRIVATE_DEPENDS} $<BUILD_INTERFACE:slamot_private>)
  if(ARG_SELDOM)
    target_compile_options(${target} PRIVATE ${seldom})
    slamot_use_precompiled(${target} slamot_precompiled_seldom)
    slamot_few_at_once(${target})
  elseif(NOT ARG_SHARED)
    slamot_use_precompiled(${target} slamot_precompiled_library)
  endif()
  # As long as the first number is 0, the second one changes the interface.
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name} VERSION ${PROJECT_VERSION}
    SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
  set(link development)
  if(ARG_SHARED)  # its name without a number is what MRPT's tools load
    set(link plugin)
  endif()
  install(TARGETS ${target} EXPORT slamot-targets
    LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT libraries NAMELINK_COMPONENT ${link}
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development)
  install(DIRECTORY include/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT development
    FILES_MATCHING PATTERN *.h)
endfunction()

# slamot_module(NAME SOURCES a.cpp ... [DEPENDS targets ...]): what the program loads only when it is asked
# for, since its libraries take long to load. Made in build/modules/, headers in include/ are the program's.
function(slamot_module name)
  cmake_parse_arguments(ARG "" "" "SOURCES;DEPENDS" ${ARGN})
  set(target slamot-${name})
  add_library(${target} MODULE ${ARG_SOURCES})
  target_include_directories(${target} PUBLIC ${CMAKE_CURRENT_SOURCE_DIR}/include)
  target_link_libraries(${target} PRIVATE ${ARG_DEPENDS} slamot_private)
  target_compile_options(${target} PRIVATE ${seldom})
  set_target_properties(${target} PROPERTIES PREFIX "" LIBRARY_OUTPUT_DIRECTORY ${slamot_modules}
    INSTALL_RPATH "$ORIGIN/..")
  install(TARGETS ${target} LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/slamot COMPONENT program)
endfunction()
set(slamot_modules ${PROJECT_BINARY_DIR}/modules)

# slamot_test(NAME SOURCES a_test.cpp ... [DEPENDS targets ...]): one test program, run by CTest.
function(slamot_test name)
  cmake_parse_arguments(ARG "" "" "SOURCES;DEPENDS" ${ARGN})
  add_executable(${name}-test ${ARG_SOURCES})
  target_link_libraries(${name}-test PRIVATE ${ARG_DEPENDS} GTest::gtest_main slamot_private)
  target_compile_options(${name}-test PRIVATE ${seldom})  # what they test is in libraries
  slamot_use_precompiled(${name}-test slamot_precompiled_test)
  gtest_discover_tests(${name}-test DISCOVERY_TIMEOUT 60 PROPERTIES TIMEOUT 300)
endfunction()
