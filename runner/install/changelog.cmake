# CHANGELOG.md, the one place where the version and what is new stand, in the forms that others want.
# Versions are `## 1.2.3 (2026-11-22)`, with `* ` items below them; what a line begins with two blanks goes on.
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${CMAKE_CURRENT_LIST_DIR}/../../CHANGELOG.md)

# Sets `variable` to the newest version.
function(newest_version variable)
  file(STRINGS ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/../../CHANGELOG.md heading REGEX "^## " LIMIT_COUNT 1)
  if(NOT heading MATCHES "^## ([0-9]+\\.[0-9]+\\.[0-9]+) \\([0-9]+-[0-9]+-[0-9]+\\)$")
    message(FATAL_ERROR "CHANGELOG.md: '${heading}' is no version; write it as in '## 1.2.3 (2026-11-22)'")
  endif()
  set(${variable} ${CMAKE_MATCH_1} PARENT_SCOPE)
endfunction()

# Sets `variable` to the whole of it in Debian's form, which dpkg's tools read.
function(debian_changelog variable maintainer)
  set(text "")
  set(signature "")
  file(STRINGS ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/../../CHANGELOG.md lines ENCODING UTF-8 REGEX "^(## |[*] |  )")
  foreach(line IN LISTS lines)
    if(line MATCHES "^## (.*) \\((.*)\\)$")
      string(APPEND text "${signature}tidemark (${CMAKE_MATCH_1}) stable; urgency=medium\n\n")
      execute_process(COMMAND date --utc --rfc-email --date ${CMAKE_MATCH_2} OUTPUT_VARIABLE date COMMAND_ERROR_IS_FATAL ANY)
      set(signature "\n -- ${maintainer}  ${date}\n")
    else()
      string(APPEND text "  ${line}\n")
    endif()
  endforeach()
  string(STRIP "${signature}" last)
  set(${variable} "${text}\n ${last}\n" PARENT_SCOPE)
endfunction()
