# Headers of others that most sources include, parsed once for each kind of target: a quarter to a
# third of a source's time to build. None of the project's own, or each change of one would build everything again. Sources include
# what they use all the same: -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON builds without, as do compilers other
# than GCC, for which this was not tried (clang's hold times of files, which defeats ccache).
if(NOT CMAKE_CXX_COMPILER_ID STREQUAL GNU)
  set(CMAKE_DISABLE_PRECOMPILE_HEADERS ON)
endif()

# slamot_precompiled(NAME [PIC yes-or-no] HEADERS <a> ... [DEPENDS targets ...] [OPTIONS options ...])
function(slamot_precompiled name)
  cmake_parse_arguments(ARG "" "PIC" "HEADERS;DEPENDS;OPTIONS" ${ARGN})
  add_library(${name} OBJECT ${PROJECT_SOURCE_DIR}/cmake/precompiled.cpp)
  target_link_libraries(${name} PRIVATE ${ARG_DEPENDS} slamot_private)
  target_compile_options(${name} PRIVATE ${ARG_OPTIONS})
  target_precompile_headers(${name} PRIVATE ${ARG_HEADERS})
  if(ARG_PIC)
    set_target_properties(${name} PROPERTIES POSITION_INDEPENDENT_CODE ON)
  endif()
endfunction()

# Lets `target` use it. GCC compiles with the options (-O, -ffp-contract ...) that the precompiled header
# was made with, whatever the source's own are, and says nothing. So the target's must be the same, and
# sources with options of their own do without.
function(slamot_use_precompiled target name)
  target_precompile_headers(${target} REUSE_FROM ${name})
  cmake_language(EVAL CODE "cmake_language(DEFER CALL slamot_skip_own_options ${target})")
endfunction()

function(slamot_skip_own_options target)
  get_target_property(sources ${target} SOURCES)
  foreach(source ${sources})
    get_source_file_property(options ${source} COMPILE_OPTIONS)
    if(options)
      set_source_files_properties(${source} PROPERTIES SKIP_PRECOMPILE_HEADERS ON)
    endif()
  endforeach()
endfunction()
