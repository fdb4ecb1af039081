# Target `docs`: the documentation as a site in html/ of the build, by MkDocs, and API pages in html/api/, by Doxygen.
find_program(SLAMOT_MKDOCS mkdocs)
find_program(SLAMOT_DOXYGEN doxygen)
mark_as_advanced(SLAMOT_MKDOCS SLAMOT_DOXYGEN)
list(TRANSFORM slamot_libraries REPLACE "(.+)" "${PROJECT_SOURCE_DIR}/libs/\\1/include" OUTPUT_VARIABLE slamot_headers)
list(JOIN slamot_headers " " slamot_headers)
configure_file(${CMAKE_CURRENT_LIST_DIR}/docs/Doxyfile.in ${PROJECT_BINARY_DIR}/docs/Doxyfile @ONLY)
set(site ${CMAKE_CURRENT_LIST_DIR}/docs/site.sh)
if(SLAMOT_MKDOCS AND SLAMOT_DOXYGEN)
  add_custom_target(docs VERBATIM COMMENT "Making the documentation in html/"
    COMMAND sh ${site} ${PROJECT_SOURCE_DIR} ${PROJECT_BINARY_DIR} ${PROJECT_BINARY_DIR})
else()
  add_custom_target(docs VERBATIM
    COMMAND ${CMAKE_COMMAND} -E echo "mkdocs or doxygen is missing: run ./dev docs" COMMAND ${CMAKE_COMMAND} -E false)
endif()
