# What is installed beside the program: manual pages and completions, which the program makes from
# its own list of commands, and the Debian package of all of it.
find_program(GZIP gzip REQUIRED)
set(made ${PROJECT_BINARY_DIR}/share)
add_custom_command(OUTPUT ${PROJECT_BINARY_DIR}/manuals.made
    COMMAND ${CMAKE_COMMAND} -E rm -rf ${made}
    COMMAND ${CMAKE_COMMAND} -E make_directory ${made}/man/man1 ${made}/bash-completion/completions
        ${made}/fish/vendor_completions.d ${made}/zsh
    COMMAND irido manual --output ${made}/man/man1
    COMMAND irido completion bash --output ${made}/bash-completion/completions/irido
    COMMAND irido completion fish --output ${made}/fish/vendor_completions.d/irido.fish
    COMMAND irido completion zsh --output ${made}/zsh/_irido
    COMMAND sh -c "\"${GZIP}\" -9n \"${made}\"/man/man1/*.1"
    COMMAND sh -c "\"${GZIP}\" -9nc \"${PROJECT_SOURCE_DIR}/CHANGELOG.md\" > \"${made}/changelog.gz\""
    COMMAND ${CMAKE_COMMAND} -E touch ${PROJECT_BINARY_DIR}/manuals.made
    DEPENDS irido ${PROJECT_SOURCE_DIR}/CHANGELOG.md
    COMMENT "Manual pages and completions" VERBATIM)
add_custom_target(irido_manuals ALL DEPENDS ${PROJECT_BINARY_DIR}/manuals.made)

set(CMAKE_SKIP_INSTALL_ALL_DEPENDENCY ON)  # no tests are needed for it
install(DIRECTORY ${made}/man ${made}/bash-completion ${made}/fish
    DESTINATION ${CMAKE_INSTALL_DATADIR})
install(CODE "
    set(share \"\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_DATADIR}\")
    set(folder site-functions)
    if(CMAKE_INSTALL_PREFIX STREQUAL \"/usr\")  # a Debian package
        set(folder vendor-completions)
        file(INSTALL \"${PROJECT_SOURCE_DIR}/package/lintian-overrides\"
            DESTINATION \"\${share}/lintian/overrides\" RENAME irido)
    endif()
    file(INSTALL \"${made}/zsh/_irido\" DESTINATION \"\${share}/zsh/\${folder}\")")
install(FILES package/copyright ${made}/changelog.gz DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(FILES tables/shaders/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR}
    RENAME shaders.MIT-0)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME irido)
set(CPACK_PACKAGE_CONTACT "irido maintainers <maintainers@irido.example>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)  # what every dpkg reads
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "spectra, colours and look-up tables of thin films")
set(CPACK_DEBIAN_PACKAGE_DESCRIPTION  # CPack puts the summary before it and blanks at its lines
    "irido computes reflectance, transmittance, absorptance and colour of stacks of
thin films, the landmarks of Bragg mirrors and the fringes of single films,
and bakes them into look-up tables for shaders and renderers.

It sweeps over any values of a stack, reads materials from common file
formats, and comes with a library of them, examples and JSON schemas.")
include(CPack)
