# `cmake --install` installs the program, the library with its public headers, a CMake package (find_package(corpuscle)), examples, documents and licences.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

install(TARGETS corpuscle-cli corpuscle-study)
install(TARGETS corpuscle-hdf5 corpuscle-sound RUNTIME DESTINATION ${CMAKE_INSTALL_LIBEXECDIR}/corpuscle)
install(TARGETS corpuscle EXPORT corpuscle-targets)
install(DIRECTORY include/ DESTINATION include)
install(EXPORT corpuscle-targets NAMESPACE corpuscle:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/corpuscle)
configure_package_config_file(cmake/corpuscle-config.cmake.in corpuscle-config.cmake INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/corpuscle)
write_basic_package_version_file(corpuscle-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/corpuscle-config.cmake ${PROJECT_BINARY_DIR}/corpuscle-config-version.cmake DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/corpuscle)

# Process cards and circuits in sibling folders, as netlists expect them; populations; examples, whose sweeps use those circuits.
install(DIRECTORY process circuits skins examples DESTINATION ${CMAKE_INSTALL_DATADIR}/corpuscle)

install(FILES README.md HACKING.md LICENSE NOTICE DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(DIRECTORY doc DESTINATION ${CMAKE_INSTALL_DOCDIR} PATTERN "*.py" EXCLUDE)
install(FILES reproduction/reproduction.md reproduction/recorded.md DESTINATION ${CMAKE_INSTALL_DOCDIR}/reproduction)
