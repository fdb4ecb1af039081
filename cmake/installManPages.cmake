# Run when slamot is installed: the program tells its manual pages itself, so that they have what it has. They
# name files that are installed with it, whose place is known only now.
set(folder ${CMAKE_INSTALL_PREFIX}/${slamot_mandir}/man1)
set(place $ENV{DESTDIR}${folder})
message(STATUS "Installing: ${place}/slamot*.1.gz")
file(MAKE_DIRECTORY ${place})
execute_process(COMMAND ${slamot_program} __man ${place} ${CMAKE_INSTALL_PREFIX}/${slamot_datadir}/slamot COMMAND_ERROR_IS_FATAL ANY)
file(GLOB pages RELATIVE ${place} ${place}/slamot*.1)
execute_process(COMMAND gzip -9nf ${pages} WORKING_DIRECTORY ${place} COMMAND_ERROR_IS_FATAL ANY)
foreach(page ${pages})
  list(APPEND CMAKE_INSTALL_MANIFEST_FILES ${folder}/${page}.gz)
endforeach()
