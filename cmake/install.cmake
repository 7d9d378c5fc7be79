# `cmake --install` installs the programs, the libraries (install_library.cmake), manual pages and completions (install_texts.cmake), examples, documents and licences.
include(GNUInstallDirs)
include(cmake/install_library.cmake)
include(cmake/install_texts.cmake)

install(TARGETS corpuscle-cli corpuscle-study)
install(TARGETS corpuscle-hdf5 corpuscle-sound RUNTIME DESTINATION ${CMAKE_INSTALL_LIBEXECDIR}/corpuscle)

# Process cards and circuits in sibling folders, as netlists expect them; populations; examples, whose sweeps use those circuits.
install(DIRECTORY process circuits skins examples DESTINATION ${CMAKE_INSTALL_DATADIR}/corpuscle)

# The live page, if `make page` has built it.
install(FILES ${PROJECT_SOURCE_DIR}/build/page/press.html DESTINATION ${CMAKE_INSTALL_DATADIR}/corpuscle OPTIONAL)

install(FILES README.md HACKING.md LICENSE NOTICE DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(DIRECTORY doc DESTINATION ${CMAKE_INSTALL_DOCDIR} PATTERN "*.py" EXCLUDE)
install(FILES reproduction/reproduction.md reproduction/recorded.md DESTINATION ${CMAKE_INSTALL_DOCDIR}/reproduction)
