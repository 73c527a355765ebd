# The Debian package: `cpack` in the build folder, or `./dev package`, which tries it too.
set(maintainer "The Tidemark authors <maintainers@tidemark.example>")
set(documents ${CMAKE_CURRENT_BINARY_DIR}/documents)
file(MAKE_DIRECTORY ${documents})
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/LICENSE)

debian_changelog(changelog "${maintainer}")
file(WRITE ${documents}/changelog "${changelog}")
execute_process(COMMAND gzip -9nc INPUT_FILE ${documents}/changelog
  OUTPUT_FILE ${documents}/changelog.gz COMMAND_ERROR_IS_FATAL ANY)

# What LICENSE permits, as a field of a file of fields: indented, with a dot for an empty line. Whose it is stands in
# the fields before: others have given theirs in the same words.
file(READ ${PROJECT_SOURCE_DIR}/LICENSE license)
string(REGEX REPLACE "^.*(Permission is hereby)" "\\1" license "${license}")
string(STRIP "${license}" license)
string(REPLACE "\n\n" "\n.\n" license "${license}")
string(REPLACE "\n" "\n " license " ${license}")
configure_file(copyright.in ${documents}/copyright @ONLY)
install(FILES ${documents}/copyright ${documents}/changelog.gz DESTINATION share/doc/tidemark)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT "${maintainer}")
set(CPACK_PACKAGE_DESCRIPTION "Tidemark opens a ShaderToy shader in a window and reloads it on save,
captures the same frames each time without a display, and measures what
other hosts leave open: how wrong a picture is for the time it took, and
where its numbers break.")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
# What program and plug-ins are linked with is found by dpkg-shlibdeps; the rest they load when it is needed.
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_DEPENDS "libasound2, libgl1, libgl1-mesa-dri, liblo7, librtmidi${rtmidi_number}, libsndfile1")
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "ffmpeg")
include(CPack)
