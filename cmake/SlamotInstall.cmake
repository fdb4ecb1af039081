# What is installed besides the targets, in the parts that become packages (SlamotPackage.cmake).
# find_package(slamot): targets slamot::core, slamot::filters, ...
include(CMakePackageConfigHelpers)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/slamot)
install(EXPORT slamot-targets NAMESPACE slamot:: DESTINATION ${package_dir} COMPONENT development)
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/slamot-config.cmake.in
  ${PROJECT_BINARY_DIR}/slamot-config.cmake INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/slamot-config-version.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/slamot-config.cmake
  ${PROJECT_BINARY_DIR}/slamot-config-version.cmake
  ${CMAKE_CURRENT_LIST_DIR}/SlamotDependencies.cmake DESTINATION ${package_dir} COMPONENT development)

set(share ${PROJECT_SOURCE_DIR}/share)
install(PROGRAMS ${share}/dds-security/make-keys
  DESTINATION ${CMAKE_INSTALL_DATADIR}/slamot/dds-security COMPONENT program)
install(PROGRAMS ${share}/slurm/reproduce.sbatch
  DESTINATION ${CMAKE_INSTALL_DATADIR}/slamot/slurm COMPONENT program)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/config-ini ${share}/datasets
  DESTINATION ${CMAKE_INSTALL_DATADIR}/slamot COMPONENT program PATTERN .gitkeep EXCLUDE)

install(CODE "set(slamot_program $<TARGET_FILE:slamot>)
  set(slamot_mandir ${CMAKE_INSTALL_MANDIR})
  set(slamot_datadir ${CMAKE_INSTALL_DATADIR})" COMPONENT program)
install(SCRIPT ${CMAKE_CURRENT_LIST_DIR}/installManPages.cmake COMPONENT program)
# Completions ask the program, so that they know what it knows.
set(zsh site-functions)
if(CMAKE_INSTALL_PREFIX STREQUAL /usr)  # Debian keeps that folder for the administrator
  set(zsh vendor-completions)
endif()
install(FILES ${share}/completions/slamot.bash RENAME slamot
  DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions COMPONENT program)
install(FILES ${share}/completions/_slamot DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/${zsh} COMPONENT program)
install(FILES ${share}/completions/slamot.fish
  DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d COMPONENT program)

install(FILES ${share}/desktop/slamot-rawlogviewer.desktop ${share}/desktop/slamot-sceneviewer3d.desktop
  DESTINATION ${CMAKE_INSTALL_DATADIR}/applications COMPONENT plugin)
install(FILES ${share}/desktop/slamot.svg
  DESTINATION ${CMAKE_INSTALL_DATADIR}/icons/hicolor/scalable/apps COMPONENT plugin)

# And as a site, if it was made in html/ of the build.
set(documents ${CMAKE_INSTALL_DATADIR}/doc/slamot-doc)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/doc DESTINATION ${documents} COMPONENT documentation)
install(FILES ${PROJECT_SOURCE_DIR}/README.md DESTINATION ${documents} COMPONENT documentation)
install(DIRECTORY ${PROJECT_BINARY_DIR}/html DESTINATION ${documents} COMPONENT documentation OPTIONAL)
