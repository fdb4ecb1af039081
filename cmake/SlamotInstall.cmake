# find_package(slamot): targets slamot::core, slamot::filters, ...
include(CMakePackageConfigHelpers)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/slamot)
install(EXPORT slamot-targets NAMESPACE slamot:: DESTINATION ${package_dir})
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/slamot-config.cmake.in
  ${PROJECT_BINARY_DIR}/slamot-config.cmake INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/slamot-config-version.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/slamot-config.cmake
  ${PROJECT_BINARY_DIR}/slamot-config-version.cmake
  ${CMAKE_CURRENT_LIST_DIR}/SlamotDependencies.cmake DESTINATION ${package_dir})
install(PROGRAMS ${PROJECT_SOURCE_DIR}/share/dds-security/make-keys
  DESTINATION ${CMAKE_INSTALL_DATADIR}/slamot/dds-security)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/config-ini ${PROJECT_SOURCE_DIR}/share/datasets
  DESTINATION ${CMAKE_INSTALL_DATADIR}/slamot PATTERN .gitkeep EXCLUDE)
